// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Training runs that do not belong to the others (kriging/outliers.hpp): named, and left where they are.

#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/tables.h>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// One sentence per run and response: what it gave, what the others put there, and what to do. Costs a fit
/// per suspect.
std::vector<std::string> suspects(const Models& fitted, const Tables& tables);

}  // namespace drawpoint::studies
