// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/contact_law_scalar.h>
#include <drawpoint/engine/world/pair_memory.h>

#include <algorithm>
#include <bit>
#include <drawpoint/engine/base/byte_stream.hpp>
#include <drawpoint/engine/base/constants.hpp>
#include <utility>

namespace drawpoint::engine::detail {

using Eigen::Vector3d;

namespace {

// Share of a pair's normal load that the next step starts from, and so of its moment, which that load bounds.
double kept_share(const ContactProblem& problem, const ContactPair& pair) {
  double load = 0, impacts = 0;
  for (int k = pair.first; k < pair.first + pair.count; ++k) {
    const ContactPoint& p = problem.points[static_cast<std::size_t>(k)];
    const double normal = p.normal.dot(p.start);
    load += normal;
    impacts += (1 - p.warm_start_fraction) * normal;
  }
  return 1 + law::moment_change(impacts, load);
}

}  // namespace

Vector3d PairMemory::Start::point(std::uint32_t feature, const Vector3d& position) {
  if (!pair_) return Vector3d::Zero();
  // Mostly the points come as they did last time: the first that is left has the feature.
  const int next = std::countr_one(used_);
  if (next < pair_->count && pair_->points[static_cast<std::size_t>(next)].feature == feature)
    return take(next);
  int best = -1;
  double best_distance = constants::match_distance * constants::match_distance;
  for (int k = 0; k < pair_->count; ++k) {
    if (used_ >> k & 1u) continue;
    const PairMemoryPoint& old = pair_->points[static_cast<std::size_t>(k)];
    const double distance = old.feature == feature ? -1.0 : (old.position - position).squaredNorm();
    if (distance < best_distance) {
      best = k;
      best_distance = distance;
    }
  }
  return best < 0 ? Vector3d::Zero().eval() : take(best);
}

Vector3d PairMemory::Start::take(int point) {
  used_ |= 1u << point;
  return pair_->points[static_cast<std::size_t>(point)].impulse;
}

PairMemory::Start PairMemory::start(int slot, int a, int b) const {
  if (slot < 0 || slot >= static_cast<int>(pairs_.size())) return Start(nullptr);
  const RememberedPair& pair = this->pair(slot);
  return Start(pair.solved == step_ && pair.a == a && pair.b == b ? &pair : nullptr);
}

void PairMemory::begin_step(const std::vector<int>& slots, int most) {
  ++step_;
  slots_ = slots;
  const std::size_t size = std::max(static_cast<std::size_t>(most), pairs_.size());
  if (size > pairs_.capacity()) pairs_.reserve(size + size / 8);  // of which there are many
  pairs_.resize(size);
}

void PairMemory::store(const ContactProblem& problem, int k) {
  const ContactPair& solved = problem.pairs[static_cast<std::size_t>(k)];
  RememberedPair& pair = pairs_[static_cast<std::size_t>(slot(k))];
  pair.a = solved.collider_a;
  pair.b = solved.collider_b;
  pair.solved = step_;
  pair.rolling = kept_share(problem, solved) * solved.start;
  pair.count = solved.count;
  for (int i = 0; i < solved.count; ++i) {
    const ContactPoint& p = problem.points[static_cast<std::size_t>(solved.first + i)];
    pair.points[static_cast<std::size_t>(i)] = {p.feature, p.position, p.warm_start_fraction * p.start};
  }
}

std::vector<int> PairMemory::in_order(const std::vector<int>& slots) const {
  std::vector<int> sorted = slots;
  std::sort(sorted.begin(), sorted.end(), [this](int x, int y) {
    return std::pair(pair(x).a, pair(x).b) < std::pair(pair(y).a, pair(y).b);
  });
  return sorted;
}

std::vector<std::byte> PairMemory::save(const ContactFinder& finder) const {
  ByteWriter out;
  std::vector<int> slots;
  for (int slot = 0; slot < static_cast<int>(pairs_.size()); ++slot) {
    const RememberedPair& pair = this->pair(slot);
    if (pair.solved == step_ && pair.a >= 0 && finder.slot_of(pair.a, pair.b) == slot) slots.push_back(slot);
  }
  out.put_count(slots.size());
  for (const int slot : in_order(slots)) {
    const RememberedPair& pair = this->pair(slot);
    out.put(pair.a);
    out.put(pair.b);
    out.put(pair.rolling);
    out.put(pair.count);
    for (int k = 0; k < pair.count; ++k) {
      const PairMemoryPoint& point = pair.points[static_cast<std::size_t>(k)];
      out.put(point.feature);
      out.put(point.position);
      out.put(point.impulse);
    }
  }
  return out.take();
}

PairMemory PairMemory::read(const ContactFinder& finder, std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  constexpr std::size_t least_size = 3 * sizeof(int) + 3 * sizeof(double);
  PairMemory memory;
  memory.begin_step({}, finder.slots());
  std::pair<int, int> last{-1, -1};
  for (std::size_t left = in.get_count(least_size); left > 0; --left) {
    RememberedPair pair;
    in.get(pair.a);
    in.get(pair.b);
    if (std::pair(pair.a, pair.b) <= std::exchange(last, {pair.a, pair.b}))
      in.fail("holds pairs of contacts that are not in order");
    const int slot = finder.slot_of(pair.a, pair.b);
    if (slot < 0) in.fail("holds impulses of a pair that the contact finder does not know");
    pair.solved = memory.step_;
    in.get(pair.rolling);
    pair.count = in.get_int("the number of points of a pair", 0, static_cast<int>(pair.points.size()));
    for (int k = 0; k < pair.count; ++k) {
      PairMemoryPoint& point = pair.points[static_cast<std::size_t>(k)];
      in.get(point.feature);
      in.get(point.position);
      in.get(point.impulse);
    }
    memory.pairs_[static_cast<std::size_t>(slot)] = pair;
  }
  in.expect_end();
  return memory;
}

}  // namespace drawpoint::engine::detail
