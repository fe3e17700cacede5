// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a run stands for when leave-one-out is asked how a model predicts at a new point: the share of the
/// box that lies nearer to it than to other runs, as geostatistics declusters its data. Runs that are crowded,
/// or lie at corners from which most of the box is far, then count for little.
///
/// By 50 random points per run, always the same: a share of 1/n is known to 1/√50 = 14 % of itself, and that
/// of a run crowded in may be 0. Cost: 50 n² d.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/detail/levels.hpp>
#include <drawpoint/kriging/detail/nearest_rows.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

/// Share of [-1, 1]^d, with the levels of categories, that is nearest to each row of X; runs that are as near
/// share alike.
inline Eigen::VectorXd shares_of_box(const Eigen::MatrixXd& X, const std::vector<int>& levels) {
  doe::RandomStream random(1);
  const Eigen::Index points = 50 * X.rows();
  Eigen::VectorXd share = Eigen::VectorXd::Zero(X.rows()), x(X.cols());
  for (Eigen::Index i = 0; i < points; ++i) {
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const double u = random.uniform();
      x[k] = is_category(levels, k) ? std::floor(u * levels[static_cast<std::size_t>(k)]) : 2.0 * u - 1.0;
    }
    const std::vector<Eigen::Index> nearest = nearest_rows(X, x, levels);
    for (const Eigen::Index row : nearest)
      share[row] += 1.0 / static_cast<double>(points * static_cast<Eigen::Index>(nearest.size()));
  }
  return share;
}

/// The mean of values by shares, Σ = 1. What stands for nothing does not count, whatever its value.
inline double mean_by_share(const Eigen::VectorXd& share, const Eigen::VectorXd& values) {
  double sum = 0;
  for (Eigen::Index i = 0; i < share.size(); ++i)
    if (share[i] > 0) sum += share[i] * values[i];
  return sum;
}

inline Eigen::VectorXd equal_shares(Eigen::Index runs) {
  return Eigen::VectorXd::Constant(runs, 1.0 / static_cast<double>(runs));
}

}  // namespace drawpoint::kriging::detail
