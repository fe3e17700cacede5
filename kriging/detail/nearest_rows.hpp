// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The runs that are nearest to a point, with categories among the inputs.

#include <Eigen/Core>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/levels.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

/// Rows of X: n x d at the least distance from x: d numbers; more than one where runs repeat. `levels` of the
/// correlation.
inline std::vector<Eigen::Index> nearest_rows(const Eigen::MatrixXd& X, const Eigen::VectorXd& x,
                                              const std::vector<int>& levels) {
  Eigen::VectorXd distance = Eigen::VectorXd::Zero(X.rows());
  for (Eigen::Index k = 0; k < X.cols(); ++k)
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
      const double step = distance_between(levels, k, X(i, k), x[k]);
      distance[i] += step * step;
    }
  const double least = smallest_entry(distance);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    if (distance[i] == least) rows.push_back(i);
  return rows;
}

}  // namespace drawpoint::kriging::detail
