// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/collision/finder_items.h>
#include <drawpoint/engine/geometry/convex_contact.h>
#include <drawpoint/engine/collision/first_touch.hpp>
#include <drawpoint/engine/collision/rigid_motion.hpp>

/// Whether two polyhedra that are apart touch while each goes on with its motion, and where.
///
/// Conservative advancement (Mirtich 1996) by chords: along an axis that separates the shapes now, their
/// separation at the end of the step is computed too. In between it lies below the straight line by no more
/// than what turning and acceleration bend, so it is above zero up to a time at which the axis is sought
/// anew, or for good. Two or three searches do. Touching is a separation below constants::touching.
/// Shapes that go less than a tenth of their inner radii against each other and are apart at the end pass.
namespace drawpoint::engine::detail {

/// A body's collider: where it stands and how it moves.
struct MovingHull {
  const Placement& placement;
  const RigidMotion& motion;
  const Cylinder* cylinder = nullptr;  ///< for which the hull stands
};

class SweptContact {
 public:
  /// The first touch within a time h > 0 [s], starting from the axis of these features; false when there is none. Of
  /// `touch` the colliders and the radius stay.
  bool find(const MovingHull& a, const MovingHull& b, double h, const Feature& hint, FirstTouch& touch);

 private:
  bool apart(const Placement& a, const Placement& b, const Feature& hint);
  Axis next_axis(const HullPair& pair, const Feature& hint);

  AxisSearch axes_;
  ConvexContactSearch contacts_;
  ConvexContact contact_;
};

/// Whether a point of the pair's contact meets the face that gave the normal, when b goes against a by
/// `shift` [m] there in a step of h, however they turn with their bodies: then the contact is where it will be.
bool meets_face(const Manifold& m, const MovingHull& a, const MovingHull& b, double h,
                const ConvexContact& contact, int point, const Eigen::Vector3d& shift);

}  // namespace drawpoint::engine::detail
