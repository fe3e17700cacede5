// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>
#include <vector>

/// Which contacts act on each other within a step: those that bodies which can move join.
namespace drawpoint::engine::detail {

/// A body of infinite mass takes no impulse and passes none on.
bool can_move(const SolverBody& body);

struct Islands {
  std::vector<int> of_pair;  ///< 0 to count − 1, in the order in which the pairs come to them
  int count = 0;
};

/// The islands that `pairs` form through the problem's moving bodies and its machine, which counts as one body.
Islands find_islands(const ContactProblem& problem, const std::vector<ContactPair>& pairs);

}  // namespace drawpoint::engine::detail
