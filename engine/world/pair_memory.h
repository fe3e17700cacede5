// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/prefetch.h>
#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <cstdint>
#include <drawpoint/engine/collision/contact_finder.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <span>
#include <vector>

/// What a world remembers of each pair of colliders: the impulses of the step that solved it last.
///
/// A pair's slot is the one that the contact finder gave it (Manifold::slot), so nothing is looked up and nothing
/// merged. A pair that was solved in the last step starts the next one from its impulses, so that a resting pile starts
/// from its own load; the slot of any other is free for the next pair that the finder puts there. A point of the next
/// step takes the impulse of the point with its feature, else of the nearest one left within constants::match_distance.
namespace drawpoint::engine::detail {

struct PairMemoryPoint {
  std::uint32_t feature = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
};

struct RememberedPair {
  int a = -1, b = -1;       ///< colliders
  std::int64_t solved = 0;  ///< number of the step that solved it last
  Eigen::Vector3d rolling = Eigen::Vector3d::Zero();
  int count = 0;  ///< of its points
  std::array<PairMemoryPoint, 4> points;
};

class PairMemory {
 public:
  /// What a pair starts from, point by point; of a pair that the last step did not solve, nothing.
  class Start {
   public:
    explicit Start(const RememberedPair* pair) : pair_(pair) {}
    Eigen::Vector3d point(std::uint32_t feature, const Eigen::Vector3d& position);
    Eigen::Vector3d rolling() const { return pair_ ? pair_->rolling : Eigen::Vector3d::Zero().eval(); }

   private:
    Eigen::Vector3d take(int point);

    const RememberedPair* pair_;
    unsigned used_ = 0;  // a bit for each point
  };
  Start start(int slot, int a, int b) const;
  /// Brings near what start() will look at.
  [[gnu::always_inline]] void prefetch(int slot) const {
    if (slot >= 0 && slot < static_cast<int>(pairs_.size()))
      detail::prefetch(&pairs_[static_cast<std::size_t>(slot)], sizeof(RememberedPair));
  }

  /// Stores a solved problem, whose pair k has slot slots[k]: begin_step(), then store() of every k, in any order and
  /// by several threads. `most` is the number of slots.
  void begin_step(const std::vector<int>& slots, int most);
  void store(const ContactProblem& problem, int k);

  /// The slot of pair k of the problem stored last.
  int slot(int k) const { return slots_[static_cast<std::size_t>(k)]; }
  const RememberedPair& pair(int slot) const { return pairs_[static_cast<std::size_t>(slot)]; }

  /// What the next steps start from, of the pairs that the finder remembers. Reading throws std::runtime_error for what
  /// cannot be; the finder must have been restored before.
  std::vector<std::byte> save(const ContactFinder& finder) const;
  static PairMemory read(const ContactFinder& finder, std::span<const std::byte> bytes);

 private:
  std::vector<int> in_order(const std::vector<int>& slots) const;

  std::vector<RememberedPair> pairs_;  // by slot
  std::vector<int> slots_;             // by pair of the last problem
  std::int64_t step_ = 0;
};

}  // namespace drawpoint::engine::detail
