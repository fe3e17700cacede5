// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <drawpoint/engine/contact/broad_phase.hpp>
#include <drawpoint/engine/contact/convex_contact.hpp>
#include <limits>
#include <vector>

/// The pairs that may touch, in order, each with what is remembered of it: its contact, where the shapes
/// stood against each other when that was computed, and how far they had travelled by then. Memory is reused,
/// not returned.
namespace drawpoint::engine::contact::detail {

struct PairState {
  bool known = false;
  ConvexContact contact;
  double travelled = 0;                              ///< odometers of both [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the smaller shape, in the frame of the larger
  Eigen::Matrix3d orientation =
      Eigen::Matrix3d::Zero();  ///< of the smaller shape, in the frame of the larger
};

class PairCache {
 public:
  struct Entry {
    int a, b;  ///< a < b
    int slot;
  };

  const std::vector<Entry>& entries() const { return entries_; }
  PairState& state(const Entry& entry) { return states_[static_cast<std::size_t>(entry.slot)]; }

  /// Takes over the changes; `allowed(a, b)` says which pairs count.
  template <class Allowed>
  void update(const BroadPhase& boxes, const BroadPhase::Changes& changes, const Allowed& allowed) {
    merged_.clear();
    auto found = changes.pairs.begin();
    const auto add_until = [&](BroadPhase::Pair end) {
      for (; found != changes.pairs.end() && *found < end; ++found)
        if (allowed(found->first, found->second))
          merged_.push_back({found->first, found->second, new_slot()});
    };
    for (const Entry& entry : entries_) {
      add_until({entry.a, entry.b});
      const bool again = found != changes.pairs.end() && *found == BroadPhase::Pair{entry.a, entry.b};
      if (again) ++found;
      if (again || !(changes.everything || boxes.changed(entry.a) || boxes.changed(entry.b)))
        merged_.push_back(entry);
      else
        free_.push_back(entry.slot);
    }
    add_until({std::numeric_limits<int>::max(), 0});
    entries_.swap(merged_);
  }

  void forget() {
    for (const Entry& entry : entries_) state(entry) = PairState{};
  }

 private:
  int new_slot() {
    if (free_.empty()) {
      states_.emplace_back();
      return static_cast<int>(states_.size()) - 1;
    }
    const int slot = free_.back();
    free_.pop_back();
    states_[static_cast<std::size_t>(slot)] = PairState{};
    return slot;
  }

  std::vector<Entry> entries_, merged_;
  std::vector<PairState> states_;
  std::vector<int> free_;
};

}  // namespace drawpoint::engine::contact::detail
