// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The nearest site of each of many points, by comparing all pairs: O(points · sites · d), without a table of
/// pairs. Distances are Euclidean; scale the coordinates to a common box first. Of equally near sites the
/// first counts, so that the answer does not depend on how the work is cut.

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

namespace drawpoint::doe::detail {

/// For each point the index of its nearest site (-1 without sites) and the squared distance to it.
struct Nearest {
  std::vector<int> site;
  Eigen::VectorXd squared_distance;

  explicit Nearest(Eigen::Index points = 0)
      : site(static_cast<std::size_t>(points), -1),
        squared_distance(Eigen::VectorXd::Constant(points, std::numeric_limits<double>::infinity())) {}
};

/// Takes one more site into account for the points [first, first + count) of P (n x d, one point per row).
inline void meet(Nearest& nearest, const Eigen::MatrixXd& P, const Eigen::RowVectorXd& site, int index,
                 Eigen::Index first, Eigen::Index count) {
  constexpr Eigen::Index block = 512;  // squared distances of a block stay in the first-level cache
  double squared[block];
  for (Eigen::Index from = first; from < first + count; from += block) {
    const Eigen::Index size = std::min(block, first + count - from);
    std::fill_n(squared, size, 0.0);
    for (Eigen::Index j = 0; j < P.cols(); ++j) {
      const double* x = P.data() + j * P.rows() + from;
      for (Eigen::Index i = 0; i < size; ++i) squared[i] += (x[i] - site[j]) * (x[i] - site[j]);
    }
    double* best = nearest.squared_distance.data() + from;
    int* which = nearest.site.data() + from;
    for (Eigen::Index i = 0; i < size; ++i) {
      const bool closer = squared[i] < best[i];
      which[i] = closer ? index : which[i];
      best[i] = closer ? squared[i] : best[i];
    }
  }
}

/// P: n x d, sites: m x d. The points are cut into blocks that stay in the cache while all sites pass by.
inline Nearest nearest_sites(const Eigen::MatrixXd& P, const Eigen::MatrixXd& sites) {
  constexpr Eigen::Index block = 512;
  Nearest nearest(P.rows());
  for (Eigen::Index from = 0; from < P.rows(); from += block)
    for (Eigen::Index s = 0; s < sites.rows(); ++s)
      meet(nearest, P, sites.row(s), static_cast<int>(s), from, std::min(block, P.rows() - from));
  return nearest;
}

}  // namespace drawpoint::doe::detail
