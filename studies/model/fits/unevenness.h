// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Responses that jump, or are rougher or noisier in one part of the box (kriging/nonstationarity.hpp): said,
/// because no error bar of theirs is right.

#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/tables.h>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// One sentence per such response: where, by how much, and what to do.
std::vector<std::string> unevenness(const Models& fitted, const Tables& tables);

}  // namespace drawpoint::studies
