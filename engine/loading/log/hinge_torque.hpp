// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/loading/arm_linkage.hpp>
#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/strategy/kinematics.hpp>
#include <optional>

/// The whole torque in the bucket's hinge G, as a hinge with a motor in it bears it, from a log.
///
/// The wrench that is logged has the two components that twist the bucket. About the pin it has the motor's torque
/// where motors in the hinges move the arm, and nothing where cylinders do: the tilt drive then puts its moment on the
/// bucket beside the pin, through bell-crank and link. That moment, the cylinder's force times its lever
/// (arm_linkage.hpp), is added here, so that both drives give one quantity. A log without poses of bucket and axle is
/// taken as it is.
namespace drawpoint::engine::loading {

class HingeTorque {
 public:
  /// Throws std::invalid_argument if the log has no torque of hinge G.
  explicit HingeTorque(const LoadingLog& log);
  /// On the bucket, in its axes (y about the pin, left) [N m].
  Eigen::Vector3d at(std::size_t row) const;

 private:
  double tilt_moment(std::size_t row) const;

  struct Poses {
    std::size_t tip_x, tip_z, bucket_angle, axle_x, axle_z, tilt_force;
  };
  const record::Table& signals_;
  std::array<std::size_t, 3> torque_;
  std::optional<Poses> by_cylinders_;
  ArmLinkage linkage_;
  ArmGeometry arm_;
};

}  // namespace drawpoint::engine::loading
