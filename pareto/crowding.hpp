// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Crowding distance: how much room a point has among its neighbours on a front.
///
/// For each objective the points are sorted and point i gets (y_(i+1) - y_(i-1)) / (y_max - y_min); the
/// distance is the sum over the objectives (Deb, Pratap, Agarwal, Meyarivan 2002, NSGA-II). The extremes of
/// each objective are infinite. Equal points count once (Fortin, Parizeau 2013): the first has the distance,
/// the others have 0, so that a front is thinned of copies before anything else. Scaling an objective changes
/// nothing. Cost O(m n log n).

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <drawpoint/pareto/dominance.hpp>

namespace drawpoint::pareto {

namespace detail {

/// The first row of every set of equal rows, in lexicographic order.
inline std::vector<int> distinct_rows(const SortedPoints& points) {
  std::vector<int> rows;
  for (const int i : points.order)
    if (rows.empty() || !points.equal(rows.back(), i)) rows.push_back(i);
  return rows;
}

/// Adds objective j's share to the distances of the distinct rows; ties go by the lexicographic order.
inline void add_gaps(const SortedPoints& points, const std::vector<int>& distinct, Eigen::Index j,
                     Eigen::VectorXd& distance) {
  std::vector<std::pair<double, int>> line;  // value and place in the lexicographic order
  line.reserve(distinct.size());
  for (std::size_t k = 0; k < distinct.size(); ++k)
    line.emplace_back(points.Y(distinct[k], j), static_cast<int>(k));
  // On a front of two objectives the one rises where the other falls.
  if (std::is_sorted(line.rbegin(), line.rend()))
    std::reverse(line.begin(), line.end());
  else if (!std::is_sorted(line.begin(), line.end()))
    std::sort(line.begin(), line.end());
  const double range = line.back().first - line.front().first;
  if (range <= 0.0) return;
  const auto at = [&](std::size_t k) -> double& { return distance[distinct[line[k].second]]; };
  at(0) = at(line.size() - 1) = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k + 1 < line.size(); ++k) at(k) += (line[k + 1].first - line[k - 1].first) / range;
}

}  // namespace detail

/// Y: n x m, the points of one front. Returns n distances, each in [0, inf]; permuting the rows of distinct
/// points permutes the result. Throws std::invalid_argument when Y holds NaN.
inline Eigen::VectorXd crowding_distance(const Eigen::MatrixXd& Y) {
  Eigen::VectorXd distance = Eigen::VectorXd::Zero(Y.rows());
  const detail::SortedPoints points = detail::sorted_points(Y);
  const std::vector<int> distinct = detail::distinct_rows(points);
  if (distinct.size() <= 2) {
    for (const int i : distinct) distance[i] = std::numeric_limits<double>::infinity();
    return distance;
  }
  for (Eigen::Index j = 0; j < Y.cols(); ++j) detail::add_gaps(points, distinct, j, distance);
  return distance;
}

/// The same in natural signs (minimised.hpp). A turned sign mirrors an objective and leaves its gaps, so the
/// two forms can differ only in which of equal points has the distance.
inline Eigen::VectorXd crowding_distance(const doe::Problem& problem, const Eigen::MatrixXd& Y) {
  return crowding_distance(minimised(problem, Y));
}

}  // namespace drawpoint::pareto
