// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What each of n boxes [0, x]×[0, y]×[0, z] alone adds to the union of all, in one sweep down z.
///
/// At a height z the boxes reaching it make a staircase in the plane. Each step owns what no other box
/// covers: the rectangle between its neighbours, less the boxes inside it that it hides. Adding a box takes
/// away the steps that it covers (they become what the new step hides) and changes the rectangles of the new
/// step and its two neighbours only; a contribution is the area owned, integrated over z (Emmerich, Fonseca
/// 2011, "Computing hypervolume contributions in low dimensions"). Dominated and repeated boxes are allowed
/// and add 0. Cost O(log n) a box plus the lengths of what three steps hide and of the shift of the
/// staircase: close to O(n log n), O(n²) at worst.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace drawpoint::pareto::detail {

class VolumeContributions {
 public:
  explicit VolumeContributions(std::size_t n) {
    boxes_.reserve(n);
    corners_.reserve(n);
    steps_.reserve(n);
  }

  /// Sides above 0; z must not rise from call to call.
  void add(double x, double y, double z) {
    const int box = static_cast<int>(boxes_.size());
    boxes_.push_back({x, y, z});
    const std::size_t above = first_as_high(y);
    if (above < steps_.size() && step(above).x >= x) {
      settle(above, z);
      hide(step(above), x, y);
      measure(above);
      return;
    }
    std::size_t last = above + (above < steps_.size() && step(above).y == y), first = above;
    while (first > 0 && step(first - 1).x <= x) --first;
    for (std::size_t k = last; k-- > first;) {
      settle(k, z);
      boxes_.back().hidden = corner(step(k).x, step(k).y, boxes_.back().hidden);
    }
    replace(first, last, box);
    for (std::size_t k = first > 0 ? first - 1 : 0; k < std::min(first + 2, steps_.size()); ++k) {
      settle(k, z);
      measure(k);
    }
  }

  /// In the order of the calls. To be called once, after all are added.
  std::vector<double> volumes() {
    for (std::size_t k = 0; k < steps_.size(); ++k) settle(k, 0.0);
    std::vector<double> result;
    for (const Box& b : boxes_) result.push_back(b.volume);
    return result;
  }

 private:
  static constexpr int none = -1;

  /// A corner of what one box hides, a staircase too: y rises and x falls from corner to corner.
  struct Corner {
    double x, y;
    int next;
  };
  struct Box {
    double x, y;
    double level;  // down to which `volume` is counted
    double area = 0.0, volume = 0.0;
    int hidden = none;  // the first corner
  };

  Box& step(std::size_t k) { return boxes_[static_cast<std::size_t>(steps_[k])]; }

  std::size_t first_as_high(double y) const {
    return static_cast<std::size_t>(
        std::partition_point(steps_.begin(), steps_.end(),
                             [&](int b) { return boxes_[static_cast<std::size_t>(b)].y < y; }) -
        steps_.begin());
  }

  void settle(std::size_t k, double z) {
    Box& b = step(k);
    b.volume += b.area * (b.level - z);
    b.level = z;
  }

  void replace(std::size_t first, std::size_t last, int box) {
    const auto at = [&](std::size_t k) { return steps_.begin() + static_cast<std::ptrdiff_t>(k); };
    if (first == last) {
      steps_.insert(at(first), box);
    } else {
      steps_[first] = box;
      steps_.erase(at(first + 1), at(last));
    }
  }

  /// A new corner before `next`: all stand in one array, so that none costs an allocation.
  int corner(double x, double y, int next) {
    corners_.push_back({x, y, next});
    return static_cast<int>(corners_.size()) - 1;
  }

  Corner& at(int corner) { return corners_[static_cast<std::size_t>(corner)]; }

  void hide(Box& box, double x, double y) {
    const int added = corner(x, y, none);
    int* place = &box.hidden;
    while (*place != none && at(*place).y < y && at(*place).x > x) place = &at(*place).next;
    int next = *place;
    while (next != none && at(next).y <= y && at(next).x <= x) next = at(next).next;
    if (next != none && at(next).x >= x) return;
    at(added).next = next;
    *place = added;
  }

  /// The area that step k owns. What it hides outside its rectangle stays outside, for rectangles only
  /// shrink: it is forgotten.
  void measure(std::size_t k) {
    Box& b = step(k);
    const double left = k + 1 < steps_.size() ? step(k + 1).x : 0.0, low = k > 0 ? step(k - 1).y : 0.0;
    double bottom = low;
    b.area = (b.x - left) * (b.y - low);
    while (b.hidden != none && at(b.hidden).y <= low) b.hidden = at(b.hidden).next;
    int* place = &b.hidden;
    for (; *place != none && at(*place).x > left; place = &at(*place).next) {
      b.area -= (at(*place).x - left) * (at(*place).y - bottom);
      bottom = at(*place).y;
    }
    *place = none;
  }

  std::vector<Box> boxes_;
  std::vector<Corner> corners_;
  std::vector<int> steps_;  // y rising, x falling
};

}  // namespace drawpoint::pareto::detail
