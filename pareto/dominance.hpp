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
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/ordered_points.hpp>
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

/// All fronts so far, from the best; `FrontType` is one of them.
template <class FrontType>
class Fronts {
 public:
  explicit Fronts(Eigen::Index m) : m_(m) {}

  /// Number of the front that the point joins.
  template <class T>
  std::size_t place(const T* p) {
    const auto lets_pass = [&](const FrontType& f) { return f.dominates(p); };
    const auto front = static_cast<std::size_t>(
        std::partition_point(fronts_.begin(), fronts_.end(), lets_pass) - fronts_.begin());
    if (front == fronts_.size()) fronts_.emplace_back(m_);
    fronts_[front].add(p);
    return front;
  }

 private:
  Eigen::Index m_;
  std::vector<FrontType> fronts_;
};

/// m <= 2: a row of numbers, the best second objective of each front, rising; with one objective every point
/// that is not equal to the one before begins a front.
template <>
class Fronts<SweepFront> {
 public:
  explicit Fronts(Eigen::Index m) : two_(m == 2) {}

  std::size_t place(Point p) {
    const double y = two_ ? p[1] : static_cast<double>(best_.size());
    const std::size_t front = first_above(y);
    if (front == best_.size()) best_.push_back(y);
    best_[front] = y;
    return front;
  }

 private:
  /// Halves without a branch, which could not be foreseen.
  std::size_t first_above(double y) const {
    const double* from = best_.data();
    for (std::size_t left = best_.size(); left > 0;) {
      const std::size_t half = (left + 1) / 2;
      from += from[half - 1] <= y ? half : 0;
      left -= half;
    }
    return static_cast<std::size_t>(from - best_.data());
  }

  bool two_;
  std::vector<double> best_;
};

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
  Fronts<FrontType> fronts(points.Y.cols());
  std::vector<int> place(points.order.size()), sizes;
  std::size_t front = 0;
  for (std::size_t i = 0; i < points.order.size(); ++i) {
    const int index = points.order[i];
    const bool repeated = i > 0 && points.equal(index, points.order[i - 1]);
    if (!repeated) front = fronts.place(points.at(index));  // an equal point would look like a dominator
    if (front == sizes.size()) sizes.push_back(0);
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
