// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// All rows but one.

#include <Eigen/Core>

namespace drawpoint::kriging::reference {

inline Eigen::MatrixXd without(const Eigen::MatrixXd& X, Eigen::Index row) {
  Eigen::MatrixXd rest(X.rows() - 1, X.cols());
  rest << X.topRows(row), X.bottomRows(X.rows() - 1 - row);
  return rest;
}

}  // namespace drawpoint::kriging::reference
