// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>

/// What can be asked about the surfaces of a world: whose they are, what they press on each other, where a ray meets
/// them. World frame, SI units.
namespace drawpoint::engine {

enum class Owner { fixed, rock, part };

/// Whose a surface is: rock `index`, machine part `index`, or the fixed surface that add_static() numbered `index`.
struct SurfaceOwner {
  Owner owner = Owner::fixed;
  int index = -1;

  friend bool operator==(const SurfaceOwner& x, const SurfaceOwner& y) {
    return x.owner == y.owner && x.index == y.index;
  }
};

/// What two bodies put on each other through the surfaces of one pair, mean over the last step.
struct PairForce {
  SurfaceOwner a, b;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mean of the points, by the size of their forces
  Eigen::Vector3d force = Eigen::Vector3d::Zero();     ///< on B; on A its opposite [N]
  /// On B about `position`, rolling and spinning resistance included; on A its opposite [N m].
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

/// The first surface on a ray.
struct RayHit {
  SurfaceOwner surface;
  double distance = 0;                                 ///< from the ray's origin [m]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the surface
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, outward
};

}  // namespace drawpoint::engine
