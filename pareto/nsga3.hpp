// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// NSGA-III: an even front in three and more objectives by niches around reference directions.
///
/// Deb, Jain 2014, "An evolutionary many-objective optimization algorithm using reference-point-based
/// nondominated sorting approach, part I"; constraints after part II: feasible points by fronts, then
/// infeasible ones by violation. Fronts survive whole until one does not fit. The objectives are scaled by
/// the ideal point z* (best values met) and the intercepts a of the plane through the m extreme points, the
/// minimisers of max_j (f_j - z*_j)/w_j with w the axes; where the points give no plane, by the worst values
/// of the first front. Each survivor belongs to the direction that it lies nearest to. The last front fills
/// the emptiest niches: the nearest point for an empty niche, any of its points for others.

#include <Eigen/Core>
#include <optional>

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/pareto/ask_and_tell.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto {

/// Variation, where nothing is said, is the authors': every pair crosses (probability 1), and nearer to its
/// parents (index 30), for in many objectives far parents make useless children.
struct Nsga3Options {
  SearchOptions search{};
  /// k x m, each row >= 0 with a positive sum; none: reference_directions(m, population). Fewer rows look at
  /// a part of the front ("preference").
  std::optional<Eigen::MatrixXd> directions{};
};

/// Driven from outside (ask_and_tell.hpp). Throws as Nsga2 does.
class Nsga3 : public Search {
 public:
  explicit Nsga3(const doe::Problem& problem, const Nsga3Options& options = {});
};

/// As nsga2: same problems, same errors, same result; at most `population` points, from the last generation.
template <class F>
Front nsga3(const F& black_box, const doe::Problem& problem, const Nsga3Options& options = {}) {
  Nsga3 search(problem, options);
  return finish(search, black_box);
}

}  // namespace drawpoint::pareto

#ifndef DRAWPOINT_PARETO_COMPILED
#include <drawpoint/pareto/detail/nsga3_definition.hpp>
#endif
