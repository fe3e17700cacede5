// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/collision/broad_phase.h>
#include <drawpoint/engine/geometry/convex_contact.h>
#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <vector>

/// The pairs that may touch, in order, each with what is remembered of it. A short entry says until when
/// nothing has to be asked and whether there is a contact; only pairs that touch or have moved look at their
/// state: the contact, and where the shapes stood against each other when it was computed. Memory is reused,
/// not returned.
namespace drawpoint::engine::detail {

struct alignas(64) PairState {
  ConvexContact contact;
  double margin = 0;                                 ///< that the contact was searched with [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the smaller shape, in the frame of the larger
  Eigen::Matrix3d orientation =
      Eigen::Matrix3d::Zero();  ///< of the smaller shape, in the frame of the larger
};

struct PairEntry {
  static constexpr double at_once = -std::numeric_limits<double>::infinity();

  int a, b;                ///< a < b
  int slot;                ///< of its state; the pair's own as long as it is remembered
  int count = 0;           ///< points of the contact
  double limit = at_once;  ///< sum of both motion bounds up to which what is remembered holds [m]
};

class PairCache {
 public:
  std::vector<PairEntry>& entries() { return entries_; }
  const std::vector<PairEntry>& entries() const { return entries_; }
  PairState& state(const PairEntry& entry) { return states_[static_cast<std::size_t>(entry.slot)]; }
  const PairState& state(const PairEntry& entry) const { return state(entry.slot); }
  const PairState& state(int slot) const { return states_[static_cast<std::size_t>(slot)]; }

  int slots() const { return static_cast<int>(states_.size()); }
  /// -1 for a pair that is not remembered.
  int slot_of(const BroadPhase::Pair& pair) const {
    const auto entry = std::lower_bound(entries_.begin(), entries_.end(), pair,
                                        [](const PairEntry& e, const BroadPhase::Pair& p) {
                                          return BroadPhase::Pair{e.a, e.b} < p;
                                        });
    return entry != entries_.end() && BroadPhase::Pair{entry->a, entry->b} == pair ? entry->slot : -1;
  }

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
    merged_.reserve(entries_.size() + changes.pairs.size());
    const std::vector<char>& changed = boxes.changed();
    for (const PairEntry& entry : entries_) {
      const BroadPhase::Pair pair{entry.a, entry.b};
      const bool in_question = changes.everything || changed[static_cast<std::size_t>(entry.a)] ||
                               changed[static_cast<std::size_t>(entry.b)];
      if (!in_question && (found == changes.pairs.end() || pair < *found)) {  // most
        merged_.push_back(entry);
        continue;
      }
      add_until(pair);
      const bool again = found != changes.pairs.end() && *found == pair;
      if (again) ++found;
      if (again || !in_question)
        merged_.push_back(entry);
      else
        free_.push_back(entry.slot);
    }
    add_until({std::numeric_limits<int>::max(), 0});
    entries_.swap(merged_);
  }

  void forget() {
    for (PairEntry& entry : entries_) forget(entry);
  }
  /// The pairs of one collider only.
  void forget(int id) {
    for (PairEntry& entry : entries_)
      if (entry.a == id || entry.b == id) forget(entry);
  }
  /// Replaces all pairs by these, with their states. Slots are given anew.
  void assign(const std::vector<PairEntry>& entries, const std::vector<PairState>& states) {
    entries_ = entries;
    states_ = states;
    free_.clear();
    int slot = 0;
    for (PairEntry& entry : entries_) entry.slot = slot++;
  }

 private:
  void forget(PairEntry& entry) {
    state(entry) = PairState{};
    entry.count = 0;
    entry.limit = PairEntry::at_once;
  }

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

  std::vector<PairEntry> entries_, merged_;
  std::vector<PairState> states_;
  std::vector<int> free_;
};

}  // namespace drawpoint::engine::detail
