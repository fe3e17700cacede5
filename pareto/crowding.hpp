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
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <drawpoint/pareto/detail/ordered_points.hpp>
#include <drawpoint/pareto/minimised.hpp>

namespace drawpoint::pareto {

namespace detail {

/// The points of a front in the order of each objective, kept while points leave the front.
class CrowdingLines {
 public:
  /// Y: n x m without NaN.
  explicit CrowdingLines(const Eigen::MatrixXd& Y) : points_(sorted_points(Y)) {
    std::vector<KeyedRow> rows(points_.order.size());
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].row = points_.order[k];
    lines_.push_back(points_.order);
    for (Eigen::Index j = 1; j < Y.cols(); ++j) {
      std::vector<KeyedRow> line = rows;  // ties go by the lexicographic order
      sort_by_objective(points_.Y, j, line);
      lines_.emplace_back();
      for (const KeyedRow& r : line) lines_.back().push_back(r.row);
    }
  }

  /// The crowding distance of each of the n rows; 0 for copies and for those that have left.
  Eigen::VectorXd distances() const {
    Eigen::VectorXd distance = Eigen::VectorXd::Zero(points_.Y.rows());
    const std::vector<int> distinct = distinct_rows();
    if (distinct.size() <= 2) {
      for (const int i : distinct) distance[i] = std::numeric_limits<double>::infinity();
      return distance;
    }
    std::vector<char> counts(static_cast<std::size_t>(points_.Y.rows()), 0);
    for (const int i : distinct) counts[static_cast<std::size_t>(i)] = 1;
    for (Eigen::Index j = 0; j < points_.Y.cols(); ++j) add_gaps(j, counts, distance);
    return distance;
  }

  /// rows: of those that are left.
  void keep(const std::vector<int>& rows) {
    std::vector<char> stays(static_cast<std::size_t>(points_.Y.rows()), 0);
    for (const int i : rows) stays[static_cast<std::size_t>(i)] = 1;
    for (std::vector<int>& line : lines_)
      std::erase_if(line, [&](int i) { return !stays[static_cast<std::size_t>(i)]; });
  }

 private:
  /// The first row of every set of equal rows, in lexicographic order.
  std::vector<int> distinct_rows() const {
    std::vector<int> rows;
    for (const int i : lines_.front())
      if (rows.empty() || !points_.equal(rows.back(), i)) rows.push_back(i);
    return rows;
  }

  /// Adds objective j's share to the distances of the rows that count, three or more.
  void add_gaps(Eigen::Index j, const std::vector<char>& counts, Eigen::VectorXd& distance) const {
    std::vector<int> line;
    line.reserve(lines_[static_cast<std::size_t>(j)].size());
    for (const int i : lines_[static_cast<std::size_t>(j)])
      if (counts[static_cast<std::size_t>(i)]) line.push_back(i);
    const auto value = [&](std::size_t k) { return points_.Y(line[k], j); };
    const double range = 0.5 * value(line.size() - 1) - 0.5 * value(0);  // halves do not overflow
    if (!(range > 0.0)) return;
    distance[line.front()] = distance[line.back()] = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k + 1 < line.size(); ++k)
      distance[line[k]] += share_of(0.5 * value(k + 1) - 0.5 * value(k - 1), range);
  }

  static double share_of(double gap, double range) {
    if (std::isinf(range)) return std::isinf(gap) ? 1.0 : 0.0;
    return gap / range;
  }

  SortedPoints points_;
  std::vector<std::vector<int>> lines_;
};

}  // namespace detail

/// Y: n x m, the points of one front. Returns n distances, each in [0, inf]; permuting the rows of distinct
/// points permutes the result. Throws std::invalid_argument when Y holds NaN.
inline Eigen::VectorXd crowding_distance(const Eigen::MatrixXd& Y) {
  return detail::CrowdingLines(Y).distances();
}

/// The same in natural signs (minimised.hpp). A turned sign mirrors an objective and leaves its gaps, so the
/// two forms can differ only in which of equal points has the distance.
inline Eigen::VectorXd crowding_distance(const doe::Problem& problem, const Eigen::MatrixXd& Y) {
  return crowding_distance(minimised(problem, Y));
}

}  // namespace drawpoint::pareto
