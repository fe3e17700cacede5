// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/engine/world/kinematic_body.hpp>

#include <drawpoint/engine/world/checks.h>
#include <algorithm>
#include <drawpoint/engine/base/checks.hpp>
#include <stdexcept>
#include <string>
#include <tuple>

namespace drawpoint::engine {
namespace {
constexpr double most_acceleration = 1e6;  // [m/s²], [rad/s²]
}  // namespace

void KinematicBody::set_velocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity) {
  detail::check_velocity("KinematicBody::set_velocity", velocity, angular_velocity);
  velocity_ = velocity;
  angular_velocity_ = angular_velocity;
}

void KinematicBody::set_acceleration(const Eigen::Vector3d& acceleration,
                                     const Eigen::Vector3d& angular_acceleration) {
  for (const auto& [name, value, unit] :
       {std::tuple("acceleration", acceleration.norm(), "m/s2"),
        std::tuple("angular acceleration", angular_acceleration.norm(), "rad/s2")})
    detail::require(std::string("engine::KinematicBody::set_acceleration: the ") + name, value,
                    {0, most_acceleration, unit});
  acceleration_ = acceleration;
  angular_acceleration_ = angular_acceleration;
}

std::optional<PrescribedMotion> KinematicBody::prescribed() const {
  return PrescribedMotion{{pose_.translation(), velocity_, angular_velocity_, acceleration_},
                          angular_acceleration_};
}

// No freedom: its parts answer nothing.
const SuperBody& KinematicBody::linearise(double h, const Eigen::Vector3d&) {
  step_ = h;
  super_.velocity_before = super_.velocity = Eigen::VectorXd();
  super_.part_maps.assign(1, SpatialMap(6, 0));
  super_.origins.assign(1, pose_.translation());
  return super_;
}

void KinematicBody::advance(const SuperBodySolution& solution) {
  const SpatialVector& impulse = solution.part_impulses.at(0);
  const Eigen::Vector3d mean = velocity_ + 0.5 * step_ * acceleration_,
                        mean_turning = angular_velocity_ + 0.5 * step_ * angular_acceleration_;
  wrench_ = {impulse.head<3>() / step_, impulse.tail<3>() / step_};
  work_ -= step_ * (wrench_.force.dot(mean) + wrench_.moment.dot(mean_turning));
  velocity_ += step_ * acceleration_;
  angular_velocity_ += step_ * angular_acceleration_;
  pose_.translation() += step_ * mean;
  const double angle = step_ * mean_turning.norm();
  if (angle == 0) return;
  const Eigen::AngleAxisd turn(angle, mean_turning.normalized());
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
  put(acceleration_);
  put(angular_acceleration_);
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
  take(acceleration_);
  take(angular_acceleration_);
  if (std::max(acceleration_.norm(), angular_acceleration_.norm()) > most_acceleration)
    throw std::runtime_error("engine::KinematicBody::set_state: an acceleration of more than " +
                             std::to_string(most_acceleration) +
                             " m/s2 or rad/s2; restore a world of this version");
  take(wrench_.moment);
  take(wrench_.force);
  work_ = *next;
}

}  // namespace drawpoint::engine
