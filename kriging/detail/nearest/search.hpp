// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The search for the parameters of many runs.
///
/// The climbs of search.hpp on 250 of the runs start climbs of Vecchia's likelihood, first of 2000 runs, then
/// of all: runs in random order are a sample of themselves. After a climb that moves a parameter by more than
/// 0.1, blocks and neighbours are chosen anew and climbed with once more; a third time moves the maximum as
/// much as it moves by chance. Cost: some 25 gradients of 2000 runs, or twice that, and 15 of all.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/nearest/vecchia.hpp>
#include <drawpoint/kriging/detail/search.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

inline constexpr Index sampled_runs = 2000;
inline constexpr double least_climb = 0.05;  ///< log likelihood

/// The first `count` runs.
inline LikelihoodProblem first_of(const LikelihoodProblem& all, Index count) {
  return problem_of_some(
      all, [count](const Eigen::MatrixXd& rows) { return Eigen::MatrixXd(rows.topRows(count)); });
}

/// Climbs from p, with the neighbours of where it stands. The likelihood stands at the result.
inline Maximum climb_nearest(VecchiaLikelihood& likelihood, const Box& box, const Eigen::VectorXd& p,
                             int max_iterations) {
  constexpr double moved = 0.1;
  Maximum best{p};
  for (int round = 0; round < 2; ++round) {
    if (round > 0) likelihood.choose_neighbours(best.p);
    BoxClimb<VecchiaLikelihood> climb(likelihood, box, best.p);
    climb.advance(max_iterations, least_climb);
    const Eigen::VectorXd step = difference(climb.p(), best.p);
    best = {climb.p(), climb.value(), climb.done()};
    if (std::max(largest_entry(step), -smallest_entry(step)) < moved) break;
  }
  likelihood.value(best.p);
  return best;
}

/// The highest that the starts lead to.
inline Maximum highest_of(VecchiaLikelihood& likelihood, const Box& box,
                          const std::vector<SearchStart>& starts, int max_iterations) {
  Maximum best{starts.front().p};
  for (const SearchStart& start : starts) {
    likelihood.choose_neighbours(start.p);
    const Maximum found = climb_nearest(likelihood, box, start.p, max_iterations);
    if (found.value > best.value) best = found;
  }
  return best;
}

/// Where climbs on many runs start, as the climbs on few of them say; `found` gets what is reported of these.
inline std::vector<SearchStart> starts_of_few(Likelihood& few, const Box& box, const FitOptions& options,
                                              Search& found) {
  const std::vector<Climb> ranked = climbs(few, box, options);
  const bool by_error = options.estimation == Estimation::penalized_likelihood;
  const Choice choice = by_error && std::isfinite(ranked.front().value()) ? chosen(few, ranked) : Choice{};
  found.tried = static_cast<int>(ranked.size());
  found.agreed = agreeing(ranked, ranked[choice.place].value());
  return starts_on_all(ranked, choice.place, 1.0);
}

/// Searches the box; problem: runs in random order. `few`: of some of them.
inline Search search_nearest(const LikelihoodProblem& problem, Likelihood& few, const Box& box,
                             const FitOptions& options, Index neighbours) {
  Search found;
  if (box.lower == box.upper) return {{box.lower, 0.0, true}, 1, 1};
  const std::vector<SearchStart> starts = starts_of_few(few, box, options, found);
  const Index n = problem.X.rows();
  VecchiaLikelihood some(first_of(problem, std::min(n, sampled_runs)), neighbours, starts.front().p);
  found.best = highest_of(some, box, starts, options.max_iterations);
  if (n <= sampled_runs) return found;
  VecchiaLikelihood all(problem, neighbours, found.best.p);
  found.best = climb_nearest(all, box, found.best.p, options.max_iterations);
  return found;
}

}  // namespace drawpoint::kriging::detail
