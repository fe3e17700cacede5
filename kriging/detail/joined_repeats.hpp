// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Runs that repeat others, in a model of these: its parameters stay. Of exact runs its variances stay too; noisy ones
/// that agree by chance, as counts do, would look like no noise at all.

#include <Eigen/Core>
#include <algorithm>
#include <drawpoint/kriging/detail/cholesky.hpp>
#include <drawpoint/kriging/detail/model_state.hpp>
#include <drawpoint/kriging/model.hpp>
#include <string>
#include <utility>

namespace drawpoint::kriging::detail {

/// `model` is of the distinct rows of X alone; the result has all rows as runs, and its message says so. X: n x d,
/// natural units; y: n.
inline Model with_repeats(const Model& model, const Eigen::MatrixXd& X, const Eigen::VectorXd& y,
                          const std::string& said) {
  ModelState s = model.state();
  const double process_variance = s.process_variance, log_likelihood = s.log_likelihood;
  s.X = s.input.apply(X);
  s.F = trend_matrix(s.trend, X, s.X, s.input);
  s.observed = y;
  s.y = affine(affine(y, 1.0, -s.y_centre), 1.0 / s.y_scale);
  Eigen::MatrixXd R;
  fill_correlation(s.X, s.correlation, R);
  for (double raised = 0;; raised = std::max(10.0 * raised, 1e-12)) {
    s.L = R;
    add_to_diagonal(s.L, s.nugget + raised);
    if (factor(block_of(s.L), 1)) break;
  }
  clear_upper(s.L);
  estimate(s);
  s.process_variance = process_variance;
  s.log_likelihood = log_likelihood;
  s.report.message += "; runs at equal points agree, " + said;
  return Model(std::move(s));
}

}  // namespace drawpoint::kriging::detail
