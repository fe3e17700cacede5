// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/collision/rigid_motion.hpp>
#include <drawpoint/engine/solver/super_body.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

/// What a world asks of an articulated machine: where its parts are, its super-body for a step, and to take
/// the solved velocities. Frames: world. SI units.
namespace drawpoint::engine {

/// How a body moves that nothing stops.
struct PrescribedMotion {
  RigidMotion rigid;
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();  ///< [rad/s²]
  /// Acceleration of the body's point at `position`, at the start of the step [m/s²].
  Eigen::Vector3d acceleration_at(const Eigen::Vector3d& position) const {
    const Eigen::Vector3d arm = position - rigid.origin, &w = rigid.angular_velocity;
    return rigid.acceleration + angular_acceleration.cross(arm) + w.cross(w.cross(arm));
  }
};

/// A machine that takes part in the contact solve.
class ArticulatedBody {
 public:
  virtual ~ArticulatedBody() = default;

  virtual int parts() const = 0;
  virtual Eigen::Isometry3d part_pose(int part) const = 0;  ///< X_WP

  /// How the body moves of a machine that contacts do not move, in the coming step; nullopt for one that they
  /// do. The first then has a single part and no super-body.
  virtual std::optional<PrescribedMotion> prescribed() const { return std::nullopt; }

  /// The super-body at the present position for a step of h [s] under the gravity vector [m/s²]. Valid until
  /// advance().
  virtual const SuperBody& linearise(double h, const Eigen::Vector3d& gravity) = 0;

  /// Takes the solved velocities, moves the machine by one step and recovers its joint forces. One that
  /// throws must have changed nothing, as World::step() promises.
  virtual void advance(const SuperBodySolution& solution) = 0;

  /// All numbers that later steps depend on, and taking them back. set_state() throws std::runtime_error for
  /// numbers that cannot be its own. A body that does not implement both cannot be saved, and says so.
  virtual std::vector<double> state() const {
    throw std::logic_error(
        "engine::ArticulatedBody: this machine cannot be saved; implement state() and set_state()");
  }
  virtual void set_state(const std::vector<double>&) {
    throw std::logic_error(
        "engine::ArticulatedBody: this machine cannot be restored; implement state() and set_state()");
  }
};

}  // namespace drawpoint::engine
