// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/collision/broad_phase.h>
#include <drawpoint/engine/collision/held_states.h>
#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

/// The pairs that may touch, in order, each with what is remembered of it. A short entry says until when nothing
/// has to be asked and whether there is a contact; pairs that have moved look at what separated them, pairs that
/// touch at their contact and at where the shapes stood against each other when it was computed (held_states.h).
/// Most pairs are only near, and have no contact. Memory is reused, not returned.
namespace drawpoint::engine::detail {

/// The plane n·x = support on A, in A's frame, that B was clear of when last apart, and the last axis's features.
struct NearState {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double support = 0;
  Feature feature;
  int held = -1;  ///< slot of the contact, if the shapes touch
};

struct PairEntry {
  static constexpr double at_once = -std::numeric_limits<double>::infinity();

  int a, b;                ///< a < b
  int slot;                ///< of its NearState; the pair's own as long as it is remembered
  int count = 0;           ///< points of the contact
  double limit = at_once;  ///< sum of both motion bounds up to which what is remembered holds [m]
};

class PairCache {
 public:
  std::vector<PairEntry>& entries() { return entries_; }
  const std::vector<PairEntry>& entries() const { return entries_; }
  NearState& near(const PairEntry& entry) { return near_[static_cast<std::size_t>(entry.slot)]; }
  const NearState& near(const PairEntry& entry) const { return near_[static_cast<std::size_t>(entry.slot)]; }
  PairState& held(int slot) { return held_[slot]; }
  const PairState& held(int slot) const { return held_[slot]; }

  /// The contact's place, given on demand. By several threads, each with pairs of its own, between two update()s.
  PairState& hold(NearState& near) {
    if (near.held < 0) near.held = held_.take();
    return held_[near.held];
  }
  void let_go(NearState& near) {
    if (near.held >= 0) held_.give_back(near.held);
    near.held = -1;
  }

  /// Slots of contacts.
  int slots() const { return held_.slots(); }
  /// -1 for a pair without a contact.
  int slot_of(const BroadPhase::Pair& pair) const {
    const auto entry = std::lower_bound(entries_.begin(), entries_.end(), pair,
                                        [](const PairEntry& e, const BroadPhase::Pair& p) {
                                          return BroadPhase::Pair{e.a, e.b} < p;
                                        });
    return entry != entries_.end() && BroadPhase::Pair{entry->a, entry->b} == pair ? near(*entry).held : -1;
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
        drop(entry);
    }
    add_until({std::numeric_limits<int>::max(), 0});
    entries_.swap(merged_);
    held_.expect(entries_.size());
  }

  void forget() {
    for (PairEntry& entry : entries_) forget(entry);
  }
  /// The pairs of one collider only.
  void forget(int id) {
    for (PairEntry& entry : entries_)
      if (entry.a == id || entry.b == id) forget(entry);
  }
  /// Replaces all pairs by these, with what is remembered of them. Slots are given anew.
  void assign(const std::vector<PairEntry>& entries, const std::vector<NearState>& near,
              const std::vector<PairState>& states) {
    entries_ = entries;
    near_ = near;
    free_.clear();
    held_.clear();
    held_.expect(entries.size());
    for (std::size_t k = 0; k < entries.size(); ++k) {
      entries_[k].slot = static_cast<int>(k);
      if (const int state = std::exchange(near_[k].held, -1); state >= 0) hold(near_[k]) = states[state];
    }
  }

 private:
  void forget(PairEntry& entry) {
    let_go(near(entry));
    near(entry) = NearState{};
    entry.count = 0;
    entry.limit = PairEntry::at_once;
  }

  void drop(const PairEntry& entry) {
    let_go(near(entry));
    free_.push_back(entry.slot);
  }

  int new_slot() {
    if (free_.empty()) {
      near_.emplace_back();
      return static_cast<int>(near_.size()) - 1;
    }
    const int slot = free_.back();
    free_.pop_back();
    near_[static_cast<std::size_t>(slot)] = NearState{};
    return slot;
  }

  std::vector<PairEntry> entries_, merged_;
  std::vector<NearState> near_;  // by slot of an entry
  std::vector<int> free_;
  HeldStates held_;
};

}  // namespace drawpoint::engine::detail
