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
  explicit VolumeContributions(std::size_t n) { boxes_.reserve(n); }

  /// Sides above 0; z must not rise from call to call.
  void add(double x, double y, double z) {
    const int box = static_cast<int>(boxes_.size());
    boxes_.push_back({x, y, z});
    const std::size_t above = first_as_high(y);
    if (above < steps_.size() && step(above).x >= x) {
      settle(above, z);
      hide(step(above).hidden, {x, y});
      measure(above);
      return;
    }
    std::size_t last = above + (above < steps_.size() && step(above).y == y), first = above;
    while (first > 0 && step(first - 1).x <= x) --first;
    for (std::size_t k = first; k < last; ++k) {
      settle(k, z);
      boxes_.back().hidden.push_back({step(k).x, step(k).y});
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
  struct Corner {
    double x, y;
  };
  struct Box {
    double x, y;
    double level;  // down to which `volume` is counted
    double area = 0.0, volume = 0.0;
    std::vector<Corner> hidden{};  // a staircase too: y rising, x falling
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

  static void hide(std::vector<Corner>& hidden, Corner corner) {
    const auto place =
        std::partition_point(hidden.begin(), hidden.end(), [&](const Corner& c) { return c.y < corner.y; });
    if (place != hidden.end() && place->x >= corner.x) return;
    const auto end = place + (place != hidden.end() && place->y == corner.y);
    auto begin = place;
    while (begin != hidden.begin() && std::prev(begin)->x <= corner.x) --begin;
    hidden.insert(hidden.erase(begin, end), corner);
  }

  /// The area that step k owns. What it hides outside its rectangle stays outside, for rectangles only
  /// shrink: it is forgotten.
  void measure(std::size_t k) {
    Box& b = step(k);
    const double left = k + 1 < steps_.size() ? step(k + 1).x : 0.0, low = k > 0 ? step(k - 1).y : 0.0;
    auto& hidden = b.hidden;
    while (!hidden.empty() && hidden.back().x <= left) hidden.pop_back();
    hidden.erase(hidden.begin(), std::partition_point(hidden.begin(), hidden.end(),
                                                      [&](const Corner& c) { return c.y <= low; }));
    double bottom = low;
    b.area = (b.x - left) * (b.y - low);
    for (const Corner& c : hidden) {
      b.area -= (c.x - left) * (c.y - bottom);
      bottom = c.y;
    }
  }

  std::vector<Box> boxes_;
  std::vector<int> steps_;  // y rising, x falling
};

}  // namespace drawpoint::pareto::detail
