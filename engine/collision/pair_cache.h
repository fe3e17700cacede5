// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/collision/broad_phase.h>
#include <drawpoint/engine/geometry/convex_contact.h>
#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <map>
#include <vector>

/// The pairs that may touch, in order, each with what is remembered of it. A short entry says until when
/// nothing has to be asked and whether there is a contact; only pairs that touch or have moved look at their
/// state: the contact, and where the shapes stood against each other when it was computed. Memory is reused,
/// not returned.
///
/// Pairs of two colliders that have stopped moving are inactive: no step touches them, and they come back as
/// they were once one of the two moves. A contact computed anew has other points and gaps, within the
/// tolerance of its reuse, and a pile that stands on the old ones would be kicked.
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
  using Inactive = std::map<BroadPhase::Pair, PairEntry>;

  std::vector<PairEntry>& entries() { return entries_; }
  const std::vector<PairEntry>& entries() const { return entries_; }
  PairState& state(const PairEntry& entry) { return states_[static_cast<std::size_t>(entry.slot)]; }
  const PairState& state(const PairEntry& entry) const { return state(entry.slot); }
  const PairState& state(int slot) const { return states_[static_cast<std::size_t>(slot)]; }

  const Inactive& inactive() const { return inactive_; }
  int slots() const { return static_cast<int>(states_.size()); }
  /// -1 for a pair that is not remembered.
  int slot_of(const BroadPhase::Pair& pair) const {
    const auto entry = std::lower_bound(entries_.begin(), entries_.end(), pair,
                                        [](const PairEntry& e, const BroadPhase::Pair& p) {
                                          return BroadPhase::Pair{e.a, e.b} < p;
                                        });
    if (entry != entries_.end() && BroadPhase::Pair{entry->a, entry->b} == pair) return entry->slot;
    const auto known = inactive_.find(pair);
    return known == inactive_.end() ? -1 : known->second.slot;
  }

  /// Takes over the changes; `allowed(a, b)` says which pairs count, `stands(a, b)` which of the others are
  /// inactive.
  template <class Allowed, class Stands>
  void update(const BroadPhase& boxes, const BroadPhase::Changes& changes, const Allowed& allowed,
              const Stands& stands) {
    merged_.clear();
    auto found = changes.pairs.begin();
    const auto add_until = [&](BroadPhase::Pair end) {
      for (; found != changes.pairs.end() && *found < end; ++found)
        if (allowed(found->first, found->second)) merged_.push_back(entry_of(*found));
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
      else if (stands(entry.a, entry.b))
        inactive_.emplace(BroadPhase::Pair{entry.a, entry.b}, entry);
      else
        free_.push_back(entry.slot);
    }
    add_until({std::numeric_limits<int>::max(), 0});
    entries_.swap(merged_);
  }

  void forget() {
    for (PairEntry& entry : entries_) forget(entry);
    for (auto& [pair, entry] : inactive_) forget(entry);
  }
  /// The pairs of one collider only.
  void forget(int id) {
    for (PairEntry& entry : entries_)
      if (entry.a == id || entry.b == id) forget(entry);
  }
  /// Drops the inactive pairs of a collider that is taken away.
  void remove(int id) {
    for (auto place = inactive_.begin(); place != inactive_.end();) {
      const bool mine = place->first.first == id || place->first.second == id;
      if (mine) free_.push_back(place->second.slot);
      place = mine ? inactive_.erase(place) : std::next(place);
    }
  }

  /// Replaces all pairs by these; states are those of the entries, then of the inactive ones. Slots are given
  /// anew.
  void assign(const std::vector<PairEntry>& entries, const std::vector<PairEntry>& inactive,
              const std::vector<PairState>& states) {
    entries_ = entries;
    states_ = states;
    free_.clear();
    inactive_.clear();
    int slot = 0;
    for (PairEntry& entry : entries_) entry.slot = slot++;
    for (const PairEntry& entry : inactive)
      inactive_.emplace(BroadPhase::Pair{entry.a, entry.b}, entry).first->second.slot = slot++;
  }

 private:
  void forget(PairEntry& entry) {
    state(entry) = PairState{};
    entry.count = 0;
    entry.limit = PairEntry::at_once;
  }

  PairEntry entry_of(const BroadPhase::Pair& pair) {
    const auto known = inactive_.find(pair);
    if (known == inactive_.end()) return {pair.first, pair.second, new_slot()};
    const PairEntry entry = known->second;
    inactive_.erase(known);
    return entry;
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
  Inactive inactive_;
  std::vector<PairState> states_;
  std::vector<int> free_;
};

}  // namespace drawpoint::engine::detail
