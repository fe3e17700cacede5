// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>

namespace drawpoint::engine {

/// How a body moves from the start of a step on, as long as no contact acts on it.
struct RigidMotion {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();            ///< of the body, about which it turns [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          ///< of the origin, at the start [m/s]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< constant [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();      ///< of the origin [m/s²]

  /// Velocity at the start of the body's point at `position` [m/s].
  Eigen::Vector3d at(const Eigen::Vector3d& position) const {
    return velocity + angular_velocity.cross(position - origin);
  }
  /// The way of the origin in a time t [m].
  Eigen::Vector3d shift(double t) const { return t * (velocity + 0.5 * t * acceleration); }
};

}  // namespace drawpoint::engine
