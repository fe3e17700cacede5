// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The union of boxes [0, p_1]×...×[0, p_M] as boxes are added one by one, and what each adds.
///
/// What a new box p adds is ∫_0^{p_M} A(z) dz, A(z) = the part of its first M-1 sides that no box with
/// p_M >= z covers. Going down in z, A falls at each box by what that box, cut to p, adds to a union of one
/// dimension less; the integral ends at the first box that covers all of p's first M-1 sides. A box that
/// covers p in all directions but one is a wall: boxes behind it are passed over. That leaves few: in the
/// sets of benchmarks/toolkit/pareto_table, 300 points in five objectives, one cut box in five.
///
/// * M = 2: a staircase of corners; O(log k) a box plus the shift of an array of k corners.
/// * M >= 3: an array of k boxes; O(k) comparisons a box and O(k) boxes of the dimension below at worst.
///
/// Boxes inside another are dropped on the way. Adding n boxes in falling order of a further coordinate and
/// summing (what each adds)·(that coordinate) is the hypervolume in M+1 dimensions: the dimension sweep
/// (Fonseca, Paquete, López-Ibáñez 2006; Guerreiro, Fonseca 2018, "Computing and updating hypervolume
/// contributions in up to four dimensions"), here with flat arrays in the place of linked lists.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace drawpoint::pareto::detail {

/// Every side of a box is positive. add() returns the growth of the union, 0 for a box inside it.
template <int M>
class BoxUnion;

template <>
class BoxUnion<1> {
 public:
  void clear() { length_ = 0.0; }
  double add(const double* p) {
    const double growth = std::max(p[0] - length_, 0.0);
    length_ = std::max(length_, p[0]);
    return growth;
  }

 private:
  double length_ = 0.0;
};

/// Along the steps x falls and y rises, with a sentinel at each end.
template <>
class BoxUnion<2> {
 public:
  BoxUnion() { clear(); }

  void clear() { steps_.assign({{HUGE_VAL, 0.0}, {0.0, HUGE_VAL}}); }
  double add(const double* p) { return add(p[0], p[1]); }

  double add(double x, double y) {
    const std::size_t above = first_as_high(y);
    if (steps_[above].x >= x) return 0.0;
    double growth = 0.0, top = y;
    std::size_t step = above;
    do {  // one band between two heights after the other, down to the step that reaches further than x
      const double width = steps_[step].x;
      --step;
      growth += (top - steps_[step].y) * (x - width);
      top = steps_[step].y;
    } while (steps_[step].x <= x);
    replace(step + 1, above + (steps_[above].y == y), {x, y});
    return growth;
  }

 private:
  struct Step {
    double x, y;
  };

  /// Short staircases, the common ones inside a recursion, are climbed faster than halved.
  std::size_t first_as_high(double y) const {
    std::size_t i = 0;
    if (steps_.size() > 24)
      i = static_cast<std::size_t>(
          std::lower_bound(steps_.begin(), steps_.end(), y, [](const Step& s, double v) { return s.y < v; }) -
          steps_.begin());
    while (steps_[i].y < y) ++i;
    return i;
  }

  /// Puts the new step in the place of those that it covers, first..last-1.
  void replace(std::size_t first, std::size_t last, Step step) {
    const auto at = [&](std::size_t i) { return steps_.begin() + static_cast<std::ptrdiff_t>(i); };
    if (first == last) {
      steps_.insert(at(first), step);
    } else {
      steps_[first] = step;
      if (first + 1 < last) steps_.erase(at(first + 1), at(last));
    }
  }

  std::vector<Step> steps_;
};

/// Boxes with the last side falling; none inside another, where all came by add().
template <int M>
class BoxUnion {
 public:
  void clear() { boxes_.clear(); }

  double add(const double* p) {
    const Iterator level = below(p[M - 1]);
    const double growth = gain(level, p);
    if (growth > 0.0) insert(level, p);
    return growth;
  }

  double growth(const double* p) { return gain(below(p[M - 1]), p); }

  void append(const double* p) { boxes_.push_back(box(p)); }

 private:
  using Box = std::array<double, M>;
  using Sides = std::array<double, M - 1>;
  using Iterator = typename std::vector<Box>::iterator;

  static Box box(const double* p) {
    Box copy;
    std::copy_n(p, M, copy.begin());
    return copy;
  }

  Iterator below(double last) {
    return std::partition_point(boxes_.begin(), boxes_.end(), [&](const Box& b) { return b[M - 1] >= last; });
  }

  /// In the first M-1 sides.
  static bool covers(const double* a, const double* b) {
    for (int j = 0; j < M - 1; ++j)
      if (a[j] < b[j]) return false;
    return true;
  }

  double gain(Iterator level, const double* p) {
    if constexpr (M == 3) return gain_over_rectangles(level, p);
    Sides wall{};
    for (auto b = boxes_.begin(); b != level; ++b)
      if (raise(wall, b->data(), p) == 0) return 0.0;
    const Sides origin = wall;
    double free = 1.0, volume = 0.0, above = p[M - 1];
    for (int j = 0; j < M - 1; ++j) free *= p[j] - origin[j];
    covered_.clear();
    for (auto b = boxes_.begin(); b != boxes_.end(); ++b) {
      if (behind(wall, b->data())) continue;
      if (b >= level) {
        volume += free * (above - (*b)[M - 1]);
        above = (*b)[M - 1];
        if (raise(wall, b->data(), p) == 0) return volume;
      }
      Sides cut;
      for (int j = 0; j < M - 1; ++j) cut[j] = std::min((*b)[j], p[j]) - origin[j];
      free -= covered_.add(cut.data());
    }
    return volume + free * above;
  }

  /// A box that is as long as p in every direction but j leaves nothing free below its own side j: there the
  /// wall goes. Returns the number of directions (of the first M-1) in which b is shorter than p.
  static int raise(Sides& wall, const double* b, const double* p) {
    int shorter = 0;
    for (int j = 0; j < M - 1; ++j) shorter += b[j] < p[j];
    if (shorter == 1)
      for (int j = 0; j < M - 1; ++j)
        if (b[j] < p[j]) wall[j] = std::max(wall[j], b[j]);
    return shorter;
  }

  static bool behind(const Sides& wall, const double* b) {
    bool any = false;
    for (int j = 0; j < M - 1; ++j) any |= b[j] <= wall[j];
    return any;
  }

  /// What the boxes before `level` leave free of the rectangle p_1×p_2 lies in [left, p_1]×[front, p_2].
  double gain_over_rectangles(Iterator level, const double* p) {
    double left = 0.0, front = 0.0;
    for (auto b = boxes_.begin(); b != level; ++b) {
      front = std::max(front, (*b)[0] >= p[0] ? (*b)[1] : 0.0);
      left = std::max(left, (*b)[1] >= p[1] ? (*b)[0] : 0.0);
    }
    const double width = p[0] - left, depth = p[1] - front;
    if (width <= 0.0 || depth <= 0.0) return 0.0;
    covered_.clear();
    double free = width * depth, volume = 0.0, above = p[2];
    for (auto b = boxes_.begin(); b != boxes_.end(); ++b) {
      const double x = (*b)[0] - left, y = (*b)[1] - front;
      if (x <= 0.0 || y <= 0.0) continue;
      if (b >= level) {
        volume += free * (above - (*b)[2]);
        above = (*b)[2];
        if (x >= width && y >= depth) return volume;
      }
      free -= covered_.add(std::min(x, width), std::min(y, depth));
    }
    return volume + free * above;
  }

  void insert(Iterator level, const double* p) {
    Iterator place = level;
    while (place != boxes_.begin() && (*std::prev(place))[M - 1] == p[M - 1]) --place;
    boxes_.erase(std::remove_if(place, boxes_.end(), [&](const Box& b) { return covers(p, b.data()); }),
                 boxes_.end());
    boxes_.insert(place, box(p));
  }

  std::vector<Box> boxes_;
  BoxUnion<M - 1> covered_;
};

}  // namespace drawpoint::pareto::detail
