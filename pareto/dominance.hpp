// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Pareto dominance and non-dominated sorting.
///
/// The forms with a problem take natural signs, the others minimise every column (minimised.hpp). a dominates
/// b iff a_j <= b_j for all j and a_j < b_j for some j. Front 1 holds the points that nothing dominates,
/// front k+1 those that only fronts 1..k dominate. Equal points share a front. Points are taken in
/// lexicographic order, so that nothing later dominates anything earlier, and each is put into the first
/// front that does not dominate it, found by bisection (Zhang, Tian, Cheng, Jin 2015, "An efficient approach
/// to non-dominated sorting", ENS-BS). A front is kept as what decides dominance: nothing for one objective,
/// the best second objective for two, the staircase of the second and third for three, all its points beyond
/// (ranked_points.hpp).
/// Cost with F fronts: O(n log n) for m <= 2, O(n log n log F) for m = 3, at worst O(m n²) beyond.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/ranked_points.hpp>
#include <drawpoint/pareto/minimised.hpp>

namespace drawpoint::pareto {

/// a and b: one point each, of equal length, minimised.
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

/// Front by front the rows in rising order; place: the front of each row.
inline std::vector<std::vector<int>> rows_by_front(const std::vector<int>& place,
                                                   const std::vector<int>& sizes) {
  std::vector<std::vector<int>> rows(sizes.size());
  for (std::size_t k = 0; k < sizes.size(); ++k) rows[k].reserve(static_cast<std::size_t>(sizes[k]));
  for (std::size_t i = 0; i < place.size(); ++i)
    rows[static_cast<std::size_t>(place[i])].push_back(static_cast<int>(i));
  return rows;
}

template <class FrontType, class T>
std::vector<std::vector<int>> sorted_into_fronts(const OrderedPoints<T>& points) {
  std::vector<FrontType> fronts;
  std::vector<int> place(points.order.size()), sizes;
  std::size_t front = 0;
  for (std::size_t i = 0; i < points.order.size(); ++i) {
    const int index = points.order[i];
    const bool repeated = i > 0 && points.equal(index, points.order[i - 1]);
    if (!repeated) {  // an equal point joins its equal, which may look like a dominator
      const T* p = points.at(index);
      const auto lets_pass = [&](const FrontType& f) { return f.dominates(p); };
      front = static_cast<std::size_t>(std::partition_point(fronts.begin(), fronts.end(), lets_pass) -
                                       fronts.begin());
      if (front == fronts.size()) {
        fronts.emplace_back(points.Y.cols());
        sizes.push_back(0);
      }
      fronts[front].add(p);
    }
    ++sizes[front];
    place[static_cast<std::size_t>(index)] = static_cast<int>(front);
  }
  return rows_by_front(place, sizes);
}

template <class FrontType, class T>
std::vector<int> first_front(const OrderedPoints<T>& points) {
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

/// Calls body with the type of front that suits the points, and the points as it wants them.
template <class Body>
auto with_fronts_for(const Eigen::MatrixXd& Y, const Body& body) {
  SortedPoints points = sorted_points(Y);
  if (Y.cols() <= 2) return body(std::type_identity<SweepFront>(), points);
  if (Y.cols() == 3) return body(std::type_identity<StaircaseFront>(), points);
  if (Y.rows() <= std::numeric_limits<std::int16_t>::max())
    return body(std::type_identity<BlockFront<std::int16_t>>(),
                OrderedPoints<std::int16_t>{ranks_of<std::int16_t>(Y), std::move(points.order)});
  return body(std::type_identity<BlockFront<std::int32_t>>(),
              OrderedPoints<std::int32_t>{ranks_of<std::int32_t>(Y), std::move(points.order)});
}

}  // namespace detail

/// Y: n x m, one point per row, minimised. Returns the fronts from the best, each the row numbers in rising
/// order; together they hold every row once. Throws std::invalid_argument when Y holds NaN.
inline std::vector<std::vector<int>> non_dominated_sort(const Eigen::MatrixXd& Y) {
  return detail::with_fronts_for(Y, [](auto front, const auto& points) {
    return detail::sorted_into_fronts<typename decltype(front)::type>(points);
  });
}

/// The first front only: the rows of Y that no other row dominates, in rising order.
inline std::vector<int> non_dominated(const Eigen::MatrixXd& Y) {
  return detail::with_fronts_for(Y, [](auto front, const auto& points) {
    return detail::first_front<typename decltype(front)::type>(points);
  });
}

/// The same in natural signs; a, b: m each.
inline bool dominates(const doe::Problem& problem, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return dominates(minimised(problem, a.transpose()), minimised(problem, b.transpose()));
}

inline std::vector<std::vector<int>> non_dominated_sort(const doe::Problem& problem,
                                                        const Eigen::MatrixXd& Y) {
  return non_dominated_sort(minimised(problem, Y));
}

inline std::vector<int> non_dominated(const doe::Problem& problem, const Eigen::MatrixXd& Y) {
  return non_dominated(minimised(problem, Y));
}

}  // namespace drawpoint::pareto
