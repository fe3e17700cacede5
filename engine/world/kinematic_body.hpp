// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/wrench.hpp>
#include <drawpoint/engine/world/articulated_body.hpp>

/// A body that moves as it is told whatever pushes it, and feels what does: a blade, a gate, a shaken floor.
///
/// To the solver each of its contacts is a body of its own that no impulse moves: the point of the body that
/// is there, with its velocity and, within the step, its acceleration, that towards the axis of its turning
/// included. Its position follows velocity and acceleration, turns by the exponential map: exact for a steady
/// motion. World frame, SI units.
namespace drawpoint::engine {

class KinematicBody final : public ArticulatedBody {
 public:
  /// At rest. Give it its shapes by World::attach() and World::add_part_shape(0, ...).
  explicit KinematicBody(const Eigen::Isometry3d& X_WB) : pose_(X_WB) {}

  /// From the next step on, of the body's origin, world axes [m/s], [rad/s]. Throws std::invalid_argument for
  /// more than 1000 m/s or 10 000 rad/s and for what is not finite.
  void set_velocity(const Eigen::Vector3d& velocity,
                    const Eigen::Vector3d& angular_velocity = Eigen::Vector3d::Zero());
  /// From the next step on, until it is set again [m/s²], [rad/s²]: velocities grow by so much within the
  /// steps. What is carried along then feels a steady push, where a velocity that is set anew in each step
  /// strikes in each. Throws std::invalid_argument for more than 1e6 and for what is not finite.
  void set_acceleration(const Eigen::Vector3d& acceleration,
                        const Eigen::Vector3d& angular_acceleration = Eigen::Vector3d::Zero());

  const Eigen::Isometry3d& pose() const { return pose_; }  ///< X_WB
  const Eigen::Vector3d& velocity() const { return velocity_; }
  const Eigen::Vector3d& angular_velocity() const { return angular_velocity_; }
  /// Force and moment of all contacts on the body, about its origin, mean over the last step.
  const Wrench& contact_wrench() const { return wrench_; }
  double work() const { return work_; }  ///< that it has done on what it touches [J]

  int parts() const override { return 1; }
  Eigen::Isometry3d part_pose(int) const override { return pose_; }
  std::optional<PrescribedMotion> prescribed() const override;
  const SuperBody& linearise(double h, const Eigen::Vector3d& gravity) override;
  void advance(const SuperBodySolution& solution) override;
  std::vector<double> state() const override;
  void set_state(const std::vector<double>& state) override;

 private:
  Eigen::Isometry3d pose_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero(), angular_velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero(), angular_acceleration_ = Eigen::Vector3d::Zero();
  double step_ = 0, work_ = 0;
  Wrench wrench_;
  SuperBody super_;
};

}  // namespace drawpoint::engine
