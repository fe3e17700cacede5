// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a search for the optimum has found, from its runs alone: the best runs, or the front, each response with
/// an interval, and where the models expect the best.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <drawpoint/doe/evaluations.hpp>
#include <drawpoint/kriging/detail/next_run.hpp>
#include <drawpoint/kriging/detail/optimum_search.hpp>
#include <optional>
#include <string>
#include <vector>

namespace drawpoint::kriging {

namespace detail {

/// The responses at x by the models, with 95 % intervals; those without a model as `observed` has them.
inline OptimalPoint point_by_models(const SearchedModels& s, const Eigen::VectorXd& x,
                                    const Eigen::VectorXd& observed) {
  constexpr double normal_quantile_975 = 1.959963984540054;
  OptimalPoint point{-1, x, observed, observed, observed};
  for (const SearchedResponse& r : s.responses) {
    const Prediction p = r.model.predict(x.transpose());
    const double half = normal_quantile_975 * std::sqrt(p.variance[0]);
    const auto j = static_cast<Eigen::Index>(r.place);
    point.y[j] = r.natural(p.mean[0]);
    point.lower[j] = r.natural(p.mean[0] - half);
    point.upper[j] = r.natural(p.mean[0] + half);
  }
  return point;
}

/// The rows that succeeded, in the order of SearchedModels::X.
inline std::vector<const doe::Evaluation*> successful(const doe::Evaluations& runs) {
  std::vector<const doe::Evaluation*> rows;
  for (const doe::Evaluation& row : runs.rows)
    if (!row.outcome.failed()) rows.push_back(&row);
  return rows;
}

DRAWPOINT_KRIGING_INLINE OptimumFound optimum_found(const doe::Evaluations& runs, const NextRun& by) {
  OptimumFound found;
  const std::vector<const doe::Evaluation*> rows = successful(runs);
  if (rows.empty()) return found;
  const SearchedModels models =
      searched_models(runs, Eigen::MatrixXd(0, static_cast<Eigen::Index>(runs.problem.variables.size())));
  const Incumbents best = incumbents_of(models);
  found.feasible = best.feasible;
  found.exact = models.exact;
  for (const Eigen::Index i : best.runs) {
    const doe::Evaluation& row = *rows[static_cast<std::size_t>(i)];
    const Eigen::VectorXd& y = row.outcome.values();
    found.best.push_back(models.exact ? OptimalPoint{-1, row.x, y, y, y} : point_by_models(models, row.x, y));
    found.best.back().run = row.run;
  }
  if (best.objectives.size() != 1 || !best.feasible) return found;
  doe::ProposeOptions options{.seed = by.seed, .candidates = 2000};
  options.allowed = by.allowed;
  options.beside = neighbours(models, best.runs, 1000, doe::run_seed(by.seed, runs.rows.size(), 11));
  const Eigen::VectorXd unknown =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(runs.problem.responses.size()), std::nan(""));
  if (const auto x = point_of(runs, expected_best(models, best), options))
    found.expected = point_by_models(models, *x, unknown);
  return found;
}

}  // namespace detail
}  // namespace drawpoint::kriging
