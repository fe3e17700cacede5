// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/contact/warm_start.hpp>
#include <utility>

namespace drawpoint::engine::contact {

void WarmStart::begin_step() {
  pairs_.swap(old_pairs_);
  points_.swap(old_points_);
  pairs_.clear();
  points_.clear();
  cursor_ = 0;
  match_ = nullptr;
}

void WarmStart::begin_pair(int a, int b) {
  const auto key = std::make_pair(a, b);
  while (cursor_ < old_pairs_.size() && std::make_pair(old_pairs_[cursor_].a, old_pairs_[cursor_].b) < key)
    ++cursor_;
  const bool found =
      cursor_ < old_pairs_.size() && std::make_pair(old_pairs_[cursor_].a, old_pairs_[cursor_].b) == key;
  match_ = found ? &old_pairs_[cursor_] : nullptr;
}

Eigen::Vector3d WarmStart::point(std::uint32_t feature, const Eigen::Vector3d& position) {
  if (!match_) return Eigen::Vector3d::Zero();
  Point* best = nullptr;
  double best_distance = reach * reach;
  for (std::size_t k = match_->first; k < match_->first + match_->count; ++k) {
    Point& old = old_points_[k];
    if (old.used) continue;
    const double distance = old.feature == feature ? -1.0 : (old.position - position).squaredNorm();
    if (distance < best_distance) {
      best = &old;
      best_distance = distance;
    }
  }
  if (!best) return Eigen::Vector3d::Zero();
  best->used = true;
  return best->impulse;
}

void WarmStart::store_pair(int a, int b, const Eigen::Vector3d& rolling) {
  pairs_.push_back({a, b, rolling, points_.size(), 0});
}

void WarmStart::store_point(std::uint32_t feature, const Eigen::Vector3d& position,
                            const Eigen::Vector3d& impulse) {
  points_.push_back({feature, position, impulse, false});
  ++pairs_.back().count;
}

}  // namespace drawpoint::engine::contact
