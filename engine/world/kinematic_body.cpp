// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/engine/world/kinematic_body.hpp>

#include <drawpoint/engine/world/checks.h>
#include <algorithm>
#include <drawpoint/engine/base/constants.hpp>
#include <stdexcept>

namespace drawpoint::engine {

void KinematicBody::set_velocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity) {
  detail::check_velocity("KinematicBody::set_velocity", velocity, angular_velocity);
  velocity_ = velocity;
  angular_velocity_ = angular_velocity;
}

const SuperBody& KinematicBody::linearise(double h, const Eigen::Vector3d&) {
  step_ = h;
  SpatialVector twist;
  twist << angular_velocity_, velocity_;
  const double size = twist.norm();
  if (size > 0) direction_ = twist / size;
  super_.velocity_before = super_.velocity =
      Eigen::VectorXd::Constant(1, constants::kinematic_root_mass * size);
  super_.part_maps.assign(1, direction_ / constants::kinematic_root_mass);
  super_.origins.assign(1, pose_.translation());
  return super_;
}

void KinematicBody::advance(const SuperBodySolution& solution) {
  const SpatialVector& impulse = solution.part_impulses.at(0);
  wrench_ = {impulse.head<3>() / step_, impulse.tail<3>() / step_};
  work_ -= step_ * (wrench_.force.dot(velocity_) + wrench_.moment.dot(angular_velocity_));
  pose_.translation() += step_ * velocity_;
  const double angle = step_ * angular_velocity_.norm();
  if (angle == 0) return;
  const Eigen::AngleAxisd turn(angle, angular_velocity_.normalized());
  pose_.linear() = Eigen::Quaterniond(turn * pose_.linear()).normalized().toRotationMatrix();
}

std::vector<double> KinematicBody::state() const {
  std::vector<double> state;
  const auto put = [&](const auto& numbers) {
    state.insert(state.end(), numbers.data(), numbers.data() + numbers.size());
  };
  put(pose_.matrix());
  put(velocity_);
  put(angular_velocity_);
  put(direction_);
  put(wrench_.moment);
  put(wrench_.force);
  state.push_back(work_);
  return state;
}

void KinematicBody::set_state(const std::vector<double>& state) {
  constexpr std::size_t size = 16 + 3 + 3 + 6 + 3 + 3 + 1;
  if (state.size() != size ||
      !std::all_of(state.begin(), state.end(), [](double x) { return std::isfinite(x); }))
    throw std::runtime_error("engine::KinematicBody::set_state: " + std::to_string(state.size()) +
                             " numbers that are not the state of such a body (" + std::to_string(size) +
                             " finite ones); restore a world with the machine that it was saved with");
  const double* next = state.data();
  const auto take = [&](auto& numbers) {
    std::copy(next, next + numbers.size(), numbers.data());
    next += numbers.size();
  };
  Eigen::Isometry3d pose;
  take(pose.matrix());
  detail::check_pose("KinematicBody::set_state", pose);
  pose_ = pose;
  take(velocity_);
  take(angular_velocity_);
  take(direction_);
  take(wrench_.moment);
  take(wrench_.force);
  work_ = *next;
}

}  // namespace drawpoint::engine
