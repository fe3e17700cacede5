// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>
#include <string>

/// What keeps a contact problem from being solved. Private to engine/record.
namespace drawpoint::engine::record::detail {

/// Empty, or the first fault: field, row, value, what is allowed.
std::string problem_fault(const engine::ContactProblem& problem);

}  // namespace drawpoint::engine::record::detail
