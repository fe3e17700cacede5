// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// From natural units to the unit box [0, 1]^d, where distances between points are taken: u = (x - lower) /
/// (upper - lower), variable by variable.

#include <Eigen/Core>
#include <utility>

#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe::detail {

/// X: n x d.
inline Eigen::MatrixXd to_unit_box(Eigen::MatrixXd X, const Problem& problem) {
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    const Variable& v = problem.variables[j];
    X.col(j).array() = (X.col(j).array() - v.lower) / (v.upper - v.lower);
  }
  return X;
}

}  // namespace drawpoint::doe::detail
