// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/contact/contact_problem.hpp>
#include <vector>

/// Sets of pairs that share no moving body: the pairs of one colour may be solved at the same time.
///
/// Greedy, in the order of the pairs: each takes the first colour that neither body has yet. Pairs with the
/// fixed world come after all others, so that the ground has the last word. Fixed bodies (zero inverse mass
/// and inertia) never conflict. A pair that finds no colour among 64 gets one of its own. Linear in the
/// pairs; a function of the problem alone. Pairs that touch the machine are not coloured.
namespace drawpoint::engine::contact::detail {

struct Colouring {
  std::vector<int> pairs;   ///< indices, colour after colour; within a colour by falling number of points
  std::vector<int> starts;  ///< of each colour in `pairs`, and the end
};

bool is_fixed(const SolverBody& body);

Colouring colour(const ContactProblem& problem);

}  // namespace drawpoint::engine::contact::detail
