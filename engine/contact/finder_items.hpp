// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <drawpoint/engine/contact/collision_hull.hpp>
#include <drawpoint/engine/contact/contact_finder.hpp>
#include <drawpoint/engine/contact/plane_contact.hpp>
#include <map>
#include <memory>

/// A collider as the finder keeps it: its shape ready for collision, its pose, and an odometer.
namespace drawpoint::engine::contact::detail {

struct Item {
  Collider collider;
  std::shared_ptr<const CollisionHull> hull;  ///< none for a half-space
  const Cylinder* cylinder = nullptr;         ///< set for cylinders, beside the hull
  const HalfSpace* plane = nullptr;           ///< set for half-spaces
  double equivalent_radius = 0;               ///< of the sphere of the same volume [m]

  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the hull, in the world
  double travelled = 0;  ///< bound on the way of every point so far: Σ |Δcentre| + ‖ΔR‖ radius [m]
  double boxed_at = 0;   ///< odometer when the box of the broad phase was made

  bool alive() const { return collider.shape != nullptr; }
  void place(const Eigen::Isometry3d& X_WB);
  Eigen::AlignedBox3d box() const;  ///< tight, in the world
  Plane plane_in_world() const;
};

/// Makes items; colliders with one shape share one hull.
class HullLibrary {
 public:
  /// Throws std::invalid_argument for a missing shape or impossible sizes.
  Item make_item(const Collider& collider);

 private:
  std::shared_ptr<const CollisionHull> hull_of(const Shape& shape);

  std::map<const Shape*, std::weak_ptr<const CollisionHull>> hulls_;
};

}  // namespace drawpoint::engine::contact::detail
