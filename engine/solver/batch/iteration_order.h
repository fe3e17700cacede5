// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <vector>

/// The order in which an iteration visits the pairs: what is solved side by side, and what on several
/// threads.
///
/// Lanes: the pairs of a batch share no moving body. Greedy: each pair goes to the first of up to 64 open
/// batches that has neither body yet, or to a new one. In each task, below, pairs with the fixed world come
/// after all others, so that an iteration ends with the ground, which does not give way, and leaves the least overlap
/// there; before that, those with more points come first.
/// Fixed bodies (zero inverse mass and inertia) never conflict.
///
/// Threads: the scene is cut across its longest side into 1, 2, 4, ... subdomains, 900 pairs or more for
/// each. A task holds the pairs within a subdomain, or those across the border of two neighbours, in batches
/// of its own; these are solved one after another by one thread. The tasks of a stage share no moving body:
/// first the pairs that reach beyond a neighbour (none unless subdomains are as thin as rocks), then every
/// other border, then the other borders, then the subdomains. An iteration thus waits for all threads at most
/// four times.
///
/// Linear in the pairs; a function of the problem alone. Pairs that touch the machine, or without points, are
/// left out.
namespace drawpoint::engine::detail {

struct IterationOrder {
  std::vector<char> fixed;   ///< by body: nothing moves it
  std::vector<int> bodies;   ///< the body of each row, in order of place: those of a subdomain side by side
  std::vector<int> pairs;    ///< indices, batch after batch, within one by falling number of points
  std::vector<int> batches;  ///< where each begins in `pairs`, and the end
  std::vector<int> tasks;    ///< where each begins in `batches`, and the end
  std::vector<int> stages;   ///< where each begins in `tasks`, and the end
};

/// `most` ≥ 1: pairs a batch. The threads change nothing but the time.
IterationOrder iteration_order(const ContactProblem& problem, int most,
                               int least_per_subdomain = constants::pairs_per_subdomain,
                               const ThreadPool& pool = ThreadPool(1));

}  // namespace drawpoint::engine::detail
