// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/contact/contact_problem.hpp>
#include <vector>

/// Sets of pairs that share no moving body, cut into batches: what may be solved at the same time.
///
/// Greedy, in the order of the pairs: each takes the first colour that neither body has yet. Pairs with the
/// fixed world come after all others, so that the ground has the last word. Fixed bodies (zero inverse mass
/// and inertia) never conflict. A pair that finds no colour among 64 gets one of its own. Pairs that touch
/// the machine are not coloured.
/// A batch holds pairs of one colour with about as many points each, from about the same place; the batches
/// of a colour go from one end of the scene to the other, so that threads which begin at different batches
/// meet different bodies. Linear in the pairs; a function of the problem alone.
namespace drawpoint::engine::contact::detail {

struct Colouring {
  std::vector<int> pairs;    ///< indices, batch after batch; within one by falling number of points
  std::vector<int> batches;  ///< where each begins in `pairs`, and the end
  std::vector<int> colours;  ///< where each begins in `batches`, and the end
};

bool is_fixed(const SolverBody& body);

/// `most` ≥ 1: pairs a batch.
Colouring colour(const ContactProblem& problem, int most);

}  // namespace drawpoint::engine::contact::detail
