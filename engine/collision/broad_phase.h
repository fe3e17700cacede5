// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/plane_contact.h>
#include <Eigen/Dense>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <memory>
#include <utility>
#include <vector>

/// Pairs of boxes that overlap, and of boxes with half-spaces, kept up to date: FCL's dynamic box trees, one
/// a thread for what moves and one for what does not.
///
/// Only what changed is looked up again; when much has, the trees are swept as wholes, with the same result.
/// A pair has at least one member that moves. Which pairs there are is a function of the present boxes alone,
/// and they are sorted: the shape of the trees, which depends on history, never shows. Cost: nothing where
/// nothing changes, some µs a changed box.
namespace drawpoint::engine::detail {

class BroadPhase {
 public:
  using Pair = std::pair<int, int>;  ///< first < second

  /// `threads`: how many trees, at most eight, are brought up to date side by side.
  explicit BroadPhase(int threads);
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  void add(int id, const Eigen::AlignedBox3d& box, bool moves);
  void add(int id, const Plane& plane, bool moves);
  void remove(int id);
  void set_box(int id, const Eigen::AlignedBox3d& box);
  void set_plane(int id, const Plane& plane);

  struct Changes {
    bool any = false;                ///< whether anything was added, changed or removed
    bool everything = false;         ///< `pairs` are all pairs; otherwise those of what changed
    const std::vector<Pair>& pairs;  ///< sorted, without repeats
  };
  /// The pairs of all that was added or changed since the last call.
  /// `parallel` may have any number of threads.
  Changes update(const ThreadPool& pool);
  /// By number, whether it was added, changed or removed before the last update().
  const std::vector<char>& changed() const;

  const Eigen::AlignedBox3d& box(int id) const;
  /// What the next update() will look up again; for snapshots.
  const std::vector<int>& pending() const;
  void set_pending(const std::vector<int>& ids);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace drawpoint::engine::detail
