// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <utility>
#include <vector>

/// Pairs of boxes that overlap, kept up to date: FCL's dynamic box trees, one for what moves and one for what
/// does not.
///
/// Only boxes that changed are looked up again; when many have, the trees are swept as a whole, with the same
/// result. A pair has at least one member that moves. Cost: some µs a changed box. Results are sorted, so
/// that the shape of the trees, which depends on history, never shows.
namespace drawpoint::engine::contact::detail {

class BroadPhase {
 public:
  using Pair = std::pair<int, int>;  ///< first < second

  BroadPhase();
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  void add(int id, const Eigen::AlignedBox3d& box, bool moves);
  void remove(int id);
  void set_box(int id, const Eigen::AlignedBox3d& box);
  void set_moves(int id, bool moves);

  struct Changes {
    bool any = false;                ///< whether a box was added, changed or removed
    bool everything = false;         ///< `pairs` are all pairs; otherwise those of the changed boxes
    const std::vector<Pair>& pairs;  ///< sorted, without repeats
    int look_ups;
  };
  /// The pairs of all boxes added or changed since the last call.
  Changes update();
  /// Whether a box was added, changed or removed before the last update().
  bool changed(int id) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace drawpoint::engine::contact::detail
