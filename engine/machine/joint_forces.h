// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

/// Newton-Euler from the leaves of the tree to its root: what each joint transmits.
///
/// For body b with children c:  R_b = ṗ_b − F_b + Σ_c R_c,  all moments taken about the point where the force
/// acts and shifted by the lever arm; ṗ_b = (I ω̇ + ω × I ω; m a). R_b is the wrench that the parent puts on b
/// at b's joint point. World axes, SI units. Cost O(bodies).
namespace drawpoint::engine::machine {

struct BodyMotion {
  int parent = -1;
  double mass = 0;
  Eigen::Matrix3d inertia;              ///< about the centre of mass, world axes [kg m²]
  Eigen::Vector3d centre, joint_point;  ///< world [m]
  Eigen::Vector3d angular_velocity, angular_acceleration, acceleration;
  Eigen::Vector3d moment,
      force;  ///< all applied loads but the tree joints', at the centre of mass [N m], [N]
};

struct JointForce {
  Eigen::Vector3d moment, force;  ///< by the parent on the body at the joint point, world axes
};

/// Parents must stand before their children.
std::vector<JointForce> joint_forces(const std::vector<BodyMotion>& bodies);

}  // namespace drawpoint::engine::machine
