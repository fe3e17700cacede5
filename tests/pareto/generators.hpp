// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Random point sets for laws of dominance and hypervolume: small whole numbers, so that ties, copies and
/// dominated points are common and every result can be counted exactly.

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <Eigen/Core>

namespace drawpoint::support {

/// n x m, entries 0..below-1.
inline Eigen::MatrixXd whole_points(int n, int m, int below) {
  Eigen::MatrixXd Y(n, m);
  for (auto row : Y.rowwise())
    for (double& y : row) y = *rc::gen::resize(100, rc::gen::inRange(0, below));
  return Y;
}

/// Row numbers 0..n-1 in random order.
inline std::vector<int> shuffled_rows(Eigen::Index n) {
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(n); ++i)
    rows.insert(rows.begin() + *rc::gen::resize(100, rc::gen::inRange(0, i + 1)), i);
  return rows;
}

}  // namespace drawpoint::support
