// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Pareto dominance and non-dominated sorting, every objective minimised.
///
/// a dominates b iff a_j <= b_j for all j and a_j < b_j for some j. Front 1 holds the points that nothing
/// dominates, front k+1 those that only fronts 1..k dominate. Equal points share a front. Points are taken in
/// lexicographic order, so that nothing later dominates anything earlier, and each is put into the first
/// front that does not dominate it, found by bisection (Zhang, Tian, Cheng, Jin 2015, "An efficient approach
/// to non-dominated sorting", ENS-BS). A front is kept as what decides dominance: nothing for one objective,
/// the best second objective for two, the staircase of the second and third for three, all its points beyond.
/// Cost with F fronts: O(n log n) for m <= 2, O(n log n log F) for m = 3, at worst O(m n²) beyond.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::pareto {

/// a and b: one point each, of equal length.
template <class A, class B>
bool dominates(const Eigen::DenseBase<A>& a, const Eigen::DenseBase<B>& b) {
  bool better = false;
  for (Eigen::Index j = 0; j < a.size(); ++j) {
    if (a.derived().coeff(j) > b.derived().coeff(j)) return false;
    better |= a.derived().coeff(j) < b.derived().coeff(j);
  }
  return better;
}

namespace detail {

/// A point is a pointer to its m objectives. Every front below is asked only about points lexicographically
/// after its own.
using Point = const double*;

/// m <= 2: the second objective of the last point is the best so far.
class SweepFront {
 public:
  explicit SweepFront(Eigen::Index m) : two_(m == 2) {}
  bool dominates(Point p) const { return two_ ? best_ <= p[1] : filled_; }
  void add(Point p) {
    filled_ = true;
    if (two_) best_ = std::min(best_, p[1]);
  }

 private:
  bool two_, filled_ = false;
  double best_ = std::numeric_limits<double>::infinity();
};

/// m = 3: the minimal (second, third) pairs, the second rising and the third falling.
class StaircaseFront {
 public:
  explicit StaircaseFront(Eigen::Index) {}

  bool dominates(Point p) const {
    const auto after = std::upper_bound(steps_.begin(), steps_.end(), p[1], is_left);
    return after != steps_.begin() && std::prev(after)->second <= p[2];
  }

  void add(Point p) {
    const auto first = std::lower_bound(steps_.begin(), steps_.end(), p[1],
                                        [](const Step& s, double x) { return s.first < x; });
    const auto last = std::find_if(first, steps_.end(), [&](const Step& s) { return s.second < p[2]; });
    if (first == last) {
      steps_.insert(first, {p[1], p[2]});
    } else {
      *first = {p[1], p[2]};
      steps_.erase(std::next(first), last);
    }
  }

 private:
  using Step = std::pair<double, double>;
  static bool is_left(double x, const Step& s) { return x < s.first; }
  std::vector<Step> steps_;
};

/// Any m: all points, the latest first, for it is the likeliest to dominate.
class ListFront {
 public:
  explicit ListFront(Eigen::Index m) : m_(m) {}

  bool dominates(Point p) const {
    return std::any_of(points_.rbegin(), points_.rend(), [&](Point q) {
      for (Eigen::Index j = 1; j < m_; ++j)
        if (q[j] > p[j]) return false;
      return true;
    });
  }
  void add(Point p) { points_.push_back(p); }

 private:
  Eigen::Index m_;
  std::vector<Point> points_;
};

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The points, each contiguous, and their lexicographic order (equal points by index).
struct SortedPoints {
  RowMajor Y;
  std::vector<int> order;

  Point at(int i) const { return Y.data() + i * Y.cols(); }
  bool equal(int a, int b) const { return std::equal(at(a), at(a) + Y.cols(), at(b)); }
};

/// Row numbers by the first objective alone, which settles nearly every comparison.
inline std::vector<std::pair<double, int>> by_first_objective(const RowMajor& Y) {
  std::vector<std::pair<double, int>> keys(static_cast<std::size_t>(Y.rows()));
  for (int i = 0; i < static_cast<int>(keys.size()); ++i)
    keys[static_cast<std::size_t>(i)] = {Y.cols() ? Y(i, 0) : 0.0, i};
  std::sort(keys.begin(), keys.end());
  return keys;
}

inline SortedPoints sorted_points(const Eigen::MatrixXd& Y) {
  if (Y.hasNaN()) throw std::invalid_argument("pareto: the objectives Y hold NaN; leave out failed runs");
  SortedPoints points{Y, {}};
  const auto keys = by_first_objective(points.Y);
  points.order.reserve(keys.size());
  for (const auto& key : keys) points.order.push_back(key.second);
  const auto before = [&, m = Y.cols()](int a, int b) {
    const Point p = points.at(a), q = points.at(b);
    for (Eigen::Index j = 1; j < m; ++j)
      if (p[j] != q[j]) return p[j] < q[j];
    return a < b;
  };
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t end = i + 1;
    while (end < keys.size() && keys[end].first == keys[i].first) ++end;
    const auto at = [&](std::size_t k) { return points.order.begin() + static_cast<std::ptrdiff_t>(k); };
    if (end - i > 1) std::sort(at(i), at(end), before);
    i = end;
  }
  return points;
}

template <class FrontType>
std::vector<std::vector<int>> sorted_into_fronts(const SortedPoints& points) {
  std::vector<std::vector<int>> members;
  std::vector<FrontType> fronts;
  std::size_t front = 0;
  for (std::size_t i = 0; i < points.order.size(); ++i) {
    const int index = points.order[i];
    if (i > 0 &&
        points.equal(index, points.order[i - 1])) {  // joins its equal, which may look like a dominator
      members[front].push_back(index);
      continue;
    }
    const Point p = points.at(index);
    front =
        static_cast<std::size_t>(std::partition_point(fronts.begin(), fronts.end(),
                                                      [&](const FrontType& f) { return f.dominates(p); }) -
                                 fronts.begin());
    if (front == fronts.size()) {
      fronts.emplace_back(points.Y.cols());
      members.emplace_back();
    }
    fronts[front].add(p);
    members[front].push_back(index);
  }
  for (auto& indices : members) std::sort(indices.begin(), indices.end());
  return members;
}

template <class FrontType>
std::vector<int> first_front(const SortedPoints& points) {
  std::vector<int> members;
  FrontType front(points.Y.cols());
  for (const int index : points.order) {
    const bool equals_last = !members.empty() && points.equal(index, members.back());
    if (!equals_last && front.dominates(points.at(index))) continue;
    if (!equals_last) front.add(points.at(index));
    members.push_back(index);
  }
  std::sort(members.begin(), members.end());
  return members;
}

}  // namespace detail

/// Y: n x m, one point a row, minimised. Returns the fronts from the best, each the row numbers in rising
/// order; together they hold every row once. Throws std::invalid_argument when Y holds NaN.
inline std::vector<std::vector<int>> non_dominated_sort(const Eigen::MatrixXd& Y) {
  const detail::SortedPoints points = detail::sorted_points(Y);
  if (Y.cols() <= 2) return detail::sorted_into_fronts<detail::SweepFront>(points);
  if (Y.cols() == 3) return detail::sorted_into_fronts<detail::StaircaseFront>(points);
  return detail::sorted_into_fronts<detail::ListFront>(points);
}

/// The first front only: the rows of Y that no other row dominates, in rising order.
inline std::vector<int> non_dominated(const Eigen::MatrixXd& Y) {
  const detail::SortedPoints points = detail::sorted_points(Y);
  if (Y.cols() <= 2) return detail::first_front<detail::SweepFront>(points);
  if (Y.cols() == 3) return detail::first_front<detail::StaircaseFront>(points);
  return detail::first_front<detail::ListFront>(points);
}

}  // namespace drawpoint::pareto
