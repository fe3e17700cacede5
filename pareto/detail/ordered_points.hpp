// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Points in lexicographic order, equal ones by index.
///
/// The first objective alone settles nearly every comparison, so the rows are sorted by it and those that tie
/// by the others. Where an eighth of the rows or more tie, all are sorted by each objective from the last to
/// the first instead, which keeps the order of what ties (rising_order.hpp). Cost O(n log n), with many ties
/// O(m n).

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <drawpoint/pareto/detail/rising_order.hpp>

namespace drawpoint::pareto::detail {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The points, each contiguous, and their lexicographic order (equal points by index). T: double, or ranks.
template <class T>
struct OrderedPoints {
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> Y;
  std::vector<int> order;

  const T* at(int i) const { return Y.data() + i * Y.cols(); }
  bool equal(int a, int b) const { return std::equal(at(a), at(a) + Y.cols(), at(b)); }
};

using SortedPoints = OrderedPoints<double>;

inline std::vector<KeyedRow> numbered_rows(Eigen::Index n) {
  std::vector<KeyedRow> rows(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = {0, static_cast<int>(i)};
  return rows;
}

/// Sorts by objective j what stands in some order already.
inline void sort_by_objective(const RowMajor& Y, Eigen::Index j, std::vector<KeyedRow>& rows) {
  for (KeyedRow& r : rows) r.key = rising_bits(Y(r.row, j));
  sort_by_key(rows);
}

/// Sorts each run of equal keys, those of the first objective, by the others.
inline void sort_ties(const SortedPoints& points, std::vector<KeyedRow>& rows) {
  const auto before = [&points, m = points.Y.cols()](const KeyedRow& a, const KeyedRow& b) {
    const double *p = points.at(a.row), *q = points.at(b.row);
    for (Eigen::Index j = 1; j < m; ++j)
      if (p[j] != q[j]) return p[j] < q[j];
    return a.row < b.row;
  };
  for (auto first = rows.begin(); first != rows.end();) {
    auto last = std::next(first);
    while (last != rows.end() && last->key == first->key) ++last;
    if (last - first > 1) std::sort(first, last, before);
    first = last;
  }
}

inline SortedPoints sorted_points(const Eigen::MatrixXd& Y) {
  if (Y.hasNaN()) throw std::invalid_argument("pareto: the objectives Y hold NaN; leave out failed runs");
  SortedPoints points{Y, {}};
  std::vector<KeyedRow> rows = numbered_rows(Y.rows());
  if (Y.cols() > 0) sort_by_objective(points.Y, 0, rows);
  std::size_t ties = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) ties += rows[i].key == rows[i - 1].key;
  if (8 * ties >= rows.size()) {
    rows = numbered_rows(Y.rows());
    for (Eigen::Index j = Y.cols() - 1; j >= 0; --j) sort_by_objective(points.Y, j, rows);
  } else if (ties > 0) {
    sort_ties(points, rows);
  }
  points.order.reserve(rows.size());
  for (const KeyedRow& r : rows) points.order.push_back(r.row);
  return points;
}

}  // namespace drawpoint::pareto::detail
