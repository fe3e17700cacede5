// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/collision/broad_phase.h>
#include <drawpoint/engine/collision/finder_items.h>

/// The boxes of the broad phase: larger than the colliders by a slack, so that few of them are changed in a
/// step.
///
/// A box must hold its collider, grown by half of how near shapes must come to be searched and by its speculative
/// margin. The motion bound rules out that a collider has left its box; it counts turns and detours in full, so those
/// that it lets through are measured, and go on from the room that they have. A box that has been left gets twice the
/// slack on the sides that were crossed: there the collider will go on. Larger boxes give more pairs to look at and
/// lose no contact; a pair that is remembered for longer may keep another axis within the finder's hysteresis. Metres,
/// world frame.
namespace drawpoint::engine::detail {

class FatBoxes {
 public:
  FatBoxes(double growth, double slack) : growth_(growth), slack_(slack) {}

  /// Whether a collider needs another box than `last`; half-spaces always do. May move its motion bound's
  /// mark.
  bool has_left(Items& items, int id, const Eigen::AlignedBox3d& last) const;

  /// A box around a hull where it is now; marks its motion bound.
  Eigen::AlignedBox3d first(Items& items, int id) const;
  Eigen::AlignedBox3d next(Items& items, int id, const Eigen::AlignedBox3d& last) const;

  Plane plane(const Items& items, int id) const;  ///< of a half-space

 private:
  Eigen::AlignedBox3d needed(const Items& items, int id) const;

  double growth_, slack_;
};

}  // namespace drawpoint::engine::detail
