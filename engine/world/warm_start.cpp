// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/world/warm_start.h>
#include <algorithm>
#include <utility>

namespace drawpoint::engine {

void WarmStart::rewind() {
  for (Point& point : points_) point.used = false;
}

void WarmStart::insert(const std::vector<Entry>& entries) {
  const auto before = [](const Pair& x, const Pair& y) {
    return std::make_pair(x.a, x.b) < std::make_pair(y.a, y.b);
  };
  const auto known = static_cast<std::ptrdiff_t>(pairs_.size());
  for (const Entry& entry : entries) {
    const Pair pair{entry.a, entry.b, entry.rolling, points_.size(), entry.points.size()};
    if (std::binary_search(pairs_.begin(), pairs_.begin() + known, pair, before)) continue;
    pairs_.push_back(pair);
    points_.insert(points_.end(), entry.points.begin(), entry.points.end());
  }
  std::inplace_merge(pairs_.begin(), pairs_.begin() + known, pairs_.end(), before);
}

void WarmStart::begin_store(std::size_t pairs, std::size_t points) {
  new_pairs_.resize(pairs);
  new_points_.resize(points);
}

void WarmStart::end_store() {
  pairs_.swap(new_pairs_);
  points_.swap(new_points_);
}

void WarmStart::Reader::begin_pair(int a, int b) {
  const std::vector<Pair>& pairs = store_.pairs_;
  const auto key = std::make_pair(a, b);
  const auto before = [](const Pair& pair, const std::pair<int, int>& k) {
    return std::make_pair(pair.a, pair.b) < k;
  };
  if (!placed_)
    cursor_ =
        static_cast<std::size_t>(std::lower_bound(pairs.begin(), pairs.end(), key, before) - pairs.begin());
  placed_ = true;
  while (cursor_ < pairs.size() && before(pairs[cursor_], key)) ++cursor_;
  found_ = cursor_ < pairs.size() && std::make_pair(pairs[cursor_].a, pairs[cursor_].b) == key;
}

Eigen::Vector3d WarmStart::Reader::point(std::uint32_t feature, const Eigen::Vector3d& position) {
  if (!found_) return Eigen::Vector3d::Zero();
  const Pair& pair = store_.pairs_[cursor_];
  Point* best = nullptr;
  double best_distance = match_distance * match_distance;
  for (std::size_t k = pair.first; k < pair.first + pair.count; ++k) {
    Point& old = store_.points_[k];
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

Eigen::Vector3d WarmStart::Reader::rolling() const {
  return found_ ? store_.pairs_[cursor_].rolling : Eigen::Vector3d::Zero().eval();
}

void WarmStart::save(ByteWriter& out) const {
  out.put_count(pairs_.size());
  for (const Pair& pair : pairs_) {
    out.put(pair.a);
    out.put(pair.b);
    out.put(pair.rolling);
    out.put_count(pair.count);
    for (std::size_t k = pair.first; k < pair.first + pair.count; ++k) {
      out.put(points_[k].feature);
      out.put(points_[k].position);
      out.put(points_[k].impulse);
    }
  }
}

void WarmStart::restore(ByteReader& in) {
  WarmStart read;
  const std::size_t pairs = in.get_count(40);
  for (std::size_t k = 0; k < pairs; ++k) {
    Pair pair{in.get<int>(), in.get<int>(), Eigen::Vector3d::Zero(), read.points_.size(), 0};
    in.get(pair.rolling);
    pair.count = in.get_count(52);
    if (!read.pairs_.empty() &&
        std::pair(read.pairs_.back().a, read.pairs_.back().b) >= std::pair(pair.a, pair.b))
      in.fail("holds pairs of contacts that are not in order");
    read.pairs_.push_back(pair);
    for (std::size_t p = 0; p < pair.count; ++p) {
      Point point{};
      in.get(point.feature);
      in.get(point.position);
      in.get(point.impulse);
      read.points_.push_back(point);
    }
  }
  *this = std::move(read);
}

}  // namespace drawpoint::engine
