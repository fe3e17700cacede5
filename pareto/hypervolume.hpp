// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Exact hypervolume: the volume that a set of points dominates, bounded by a reference point, every
/// objective minimised.
///
/// H(P, r) = volume of ∪_p [p_1, r_1] x ... x [p_m, r_m]. Points that are not better than r in every
/// objective add nothing; dominated and repeated points are allowed. m = 2: one sweep, O(n log n). m = 3:
/// sweep over the third objective with the staircase of the other two, O(n log n) plus the shifts of a sorted
/// array. m >= 4: WFG (While, Bradstreet, Barone 2012, "A fast way of calculating exact hypervolumes"): H =
/// Σ_i [box(p_i) - H(limit set of p_i)], points sorted so that the last objective improves; the limit set
/// then has it in common, which takes one objective off, down to the sweep at m = 3. Exponential in m at
/// worst; meant for m <= 6. Relative rounding error below about n·1e-16.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::pareto {

namespace detail {

/// The union of boxes [0, x] x [0, y] as boxes are added: along the steps x falls and y rises, with a
/// sentinel at each end.
class Staircase {
 public:
  Staircase() { clear(); }

  void clear() { steps_.assign({{HUGE_VAL, 0.0}, {0.0, HUGE_VAL}}); }

  /// Adds the box of x, y > 0 and returns the area by which the union grows.
  double add(double x, double y) {
    const auto above =
        std::lower_bound(steps_.begin(), steps_.end(), y, [](const Step& s, double v) { return s.y < v; });
    if (above->x >= x) return 0.0;
    double gain = 0.0, top = y;
    auto step = above;
    do {  // one band between two heights after the other, down to the step that reaches further than x
      const double width = step->x;
      --step;
      gain += (top - step->y) * (x - width);
      top = step->y;
    } while (step->x <= x);
    replace(std::next(step), above->y == y ? std::next(above) : above, {x, y});
    return gain;
  }

 private:
  struct Step {
    double x, y;
  };
  using Iterator = std::vector<Step>::iterator;

  /// Puts the new step in the place of those that it covers.
  void replace(Iterator first, Iterator last, Step step) {
    if (first == last) {
      steps_.insert(first, step);
    } else {
      *first = step;
      steps_.erase(std::next(first), last);
    }
  }

  std::vector<Step> steps_;
};

/// Points as depths below the reference, all positive: the deeper the better, the reference is the origin.
/// Point i begins at i·m.
struct Depths {
  std::vector<double> values;
  std::size_t n = 0, m = 0;

  double* point(std::size_t i) { return values.data() + i * m; }
  const double* point(std::size_t i) const { return values.data() + i * m; }
  void reset(std::size_t dimension) {
    n = 0;
    m = dimension;
    values.clear();
  }
  void add(const double* p) {
    values.insert(values.end(), p, p + m);
    ++n;
  }
};

/// Volume of a union of boxes from the origin to each of a set of points.
class BoxUnion {
 public:
  double volume(const Depths& points) {
    levels_.resize(
        std::max(levels_.size(), points.m));  // all levels at once, so that the recursion's references hold
    return volume_of(points);
  }

 private:
  struct Level {
    std::vector<std::size_t> order;
    Depths limited, kept;
  };

  double volume_of(const Depths& points) {
    if (points.n == 0) return 0.0;
    if (points.m == 1) return *std::max_element(points.values.begin(), points.values.end());
    if (points.m == 2) return area(points);
    if (points.m == 3) return sweep(points);
    return slices(points);
  }

  /// Point numbers by the last coordinate.
  template <class Compare>
  const std::vector<std::size_t>& by_last(const Depths& points, Compare compare) {
    std::vector<std::size_t>& order = levels_[points.m - 1].order;
    order.resize(points.n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::size_t last = points.m - 1;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const double u = points.point(a)[last], v = points.point(b)[last];
      return u != v ? compare(u, v) : a < b;
    });
    return order;
  }

  double area(const Depths& points) {
    double total = 0.0, width = 0.0;
    for (const std::size_t i : by_last(points, std::greater<>())) {
      const double* p = points.point(i);
      if (p[0] <= width) continue;
      total += (p[0] - width) * p[1];
      width = p[0];
    }
    return total;
  }

  /// From the deepest point up: the area of the first two coordinates times the step in the third.
  double sweep(const Depths& points) {
    double total = 0.0;
    staircase_.clear();
    for (const std::size_t i : by_last(points, std::greater<>())) {
      const double* p = points.point(i);
      total += staircase_.add(p[0], p[1]) * p[2];
    }
    return total;
  }

  /// Σ box(p) - (box(p) ∩ what the points deeper in the last coordinate cover), which has p's last coordinate
  /// as a factor.
  double slices(const Depths& points) {
    const std::size_t last = points.m - 1;
    const auto& order = by_last(points, std::less<>());
    Level& level = levels_[last];
    double total = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const double* p = points.point(order[i]);
      limit(points, i, level.limited);
      const Depths& overlap = last > 3 ? without_dominated(level) : level.limited;
      double box = 1.0;
      for (std::size_t j = 0; j < last; ++j) box *= p[j];
      total += p[last] * (box - volume_of(overlap));
    }
    return total;
  }

  /// The points after place i in the order, cut to the box of that point, without the last coordinate.
  void limit(const Depths& points, std::size_t i, Depths& limited) {
    const std::vector<std::size_t>& order = levels_[points.m - 1].order;
    const double* p = points.point(order[i]);
    const std::size_t m = points.m - 1;
    limited.m = m;
    limited.n = order.size() - i - 1;
    limited.values.resize(limited.n * m);
    for (std::size_t k = 0; k < limited.n; ++k) {
      const double* q = points.point(order[i + 1 + k]);
      double* out = limited.point(k);
      for (std::size_t j = 0; j < m; ++j) out[j] = std::min(p[j], q[j]);
    }
  }

  /// The limit set without points that lie in another's box: few are left, which is what makes the method
  /// fast.
  static const Depths& without_dominated(Level& level) {
    level.kept.reset(level.limited.m);
    for (std::size_t i = 0; i < level.limited.n; ++i) keep(level.limited.point(i), level.kept);
    return level.kept;
  }

  static bool covers(const double* a, const double* b, std::size_t m) {
    for (std::size_t j = 0; j < m; ++j)
      if (a[j] < b[j]) return false;
    return true;
  }

  static void keep(const double* p, Depths& kept) {
    const std::size_t m = kept.m;
    std::size_t left = 0;
    for (std::size_t k = 0; k < kept.n; ++k) {
      if (covers(kept.point(k), p, m)) return;  // then p covers none before: those would lie in kept k's box
      if (covers(p, kept.point(k), m)) continue;
      if (left != k) std::copy_n(kept.point(k), m, kept.point(left));
      ++left;
    }
    kept.n = left;
    kept.values.resize(left * m);
    kept.add(p);
  }

  Staircase staircase_;
  std::vector<Level> levels_;
};

inline Depths depths(const Eigen::MatrixXd& points, const Eigen::VectorXd& reference) {
  Depths result;
  result.reset(static_cast<std::size_t>(points.cols()));
  Eigen::VectorXd depth(points.cols());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    depth = reference - points.row(i).transpose();
    if ((depth.array() > 0.0).all()) result.add(depth.data());
  }
  return result;
}

}  // namespace detail

/// points: n x m, minimised; reference: m. Returns the volume in the product of the objectives' units. Throws
/// std::invalid_argument when the sizes differ or a number is not finite.
inline double hypervolume(const Eigen::MatrixXd& points, const Eigen::VectorXd& reference) {
  const std::string place = "pareto::hypervolume: ";
  if (points.cols() != reference.size() || reference.size() == 0)
    throw std::invalid_argument(place + "points has " + std::to_string(points.cols()) +
                                " columns, reference has " + std::to_string(reference.size()) +
                                " entries; both need one an objective");
  if (!points.allFinite())
    throw std::invalid_argument(place + "points holds NaN or infinity; leave out failed runs");
  if (!reference.allFinite())
    throw std::invalid_argument(place + "reference holds NaN or infinity; give finite numbers");
  return detail::BoxUnion().volume(detail::depths(points, reference));
}

}  // namespace drawpoint::pareto
