// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/articulated_body.hpp>

/// A plate that moves at a given velocity whatever pushes it, and feels what does: a gate, a trap door, a
/// blade.
///
/// A machine of one part and one freedom whose velocity map is 1e-6: an effective mass of 1e12 kg, so that
/// 1 MN over a second changes its speed by 1e-6 m/s; the velocity is set anew at every step. World frame, SI
/// units.
namespace drawpoint::validation {

class DrivenPlate final : public engine::ArticulatedBody {
 public:
  explicit DrivenPlate(const Eigen::Vector3d& position) : pose_(Eigen::Translation3d(position)) {}

  void drive(const Eigen::Vector3d& velocity) { velocity_ = velocity; }
  const Eigen::Vector3d& force() const { return force_; }  ///< of the contacts, mean over the last step [N]
  double work() const { return work_; }                    ///< done on what it touches so far [J]

  int parts() const override { return 1; }
  Eigen::Isometry3d part_pose(int) const override { return pose_; }

  const engine::SuperBody& linearise(double h, const Eigen::Vector3d&) override {
    step_ = h;
    const double speed = velocity_.norm();
    super_.velocity_before = super_.velocity = Eigen::VectorXd::Constant(1, speed / map);
    super_.part_maps.assign(1, engine::SpatialMap::Zero(6, 1));
    if (speed > 0) super_.part_maps[0].col(0).tail<3>() = map * velocity_ / speed;
    super_.origins.assign(1, pose_.translation());
    return super_;
  }

  void advance(const engine::SuperBodySolution& solution) override {
    force_ = solution.part_impulses[0].tail<3>() / step_;
    work_ -= force_.dot(velocity_) * step_;
    pose_.translation() += step_ * velocity_;
  }

 private:
  static constexpr double map = 1e-6;
  Eigen::Isometry3d pose_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero(), force_ = Eigen::Vector3d::Zero();
  engine::SuperBody super_;
  double step_ = 0, work_ = 0;
};

}  // namespace drawpoint::validation
