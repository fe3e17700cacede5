// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is varied in a study and what comes out, for --help.

#include <drawpoint/doe/problem.hpp>

#include <string>

namespace drawpoint::studies {

/// A line per variable and response: name, range or goal, description.
std::string problem_text(const doe::Problem& problem);

}  // namespace drawpoint::studies
