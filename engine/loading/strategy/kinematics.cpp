// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/strategy/kinematics.hpp>
#include <numbers>

namespace drawpoint::engine::loading {
namespace {

constexpr double least_cosine = 1e-3;

}  // namespace

ArmGeometry arm_geometry(const Eigen::Vector3d& F, const Eigen::Vector3d& G, const Eigen::Vector3d& K) {
  const double along_x = K.x() - G.x(), along_z = K.z() - G.z();
  return {.FG = std::hypot(G.x() - F.x(), G.z() - F.z()),
          .GK = std::hypot(along_x, along_z),
          .x_F = F.x(),
          .z_F = F.z(),
          .psi_b = std::atan2(along_z, along_x)};
}

TipPose tip_pose(const ArmGeometry& arm, const ArmPose& pose) {
  return {.x = pose.q_d + arm.x_F + arm.FG * std::cos(pose.a) + arm.GK * std::cos(pose.b),
          .z = arm.z_F + arm.FG * std::sin(pose.a) + arm.GK * std::sin(pose.b),
          .phi = pose.b - arm.psi_b};
}

ArmPose arm_pose(const ArmGeometry& arm, const TipPose& tip) {
  const double b = tip.phi + arm.psi_b;
  const double sine = (tip.z - arm.z_F - arm.GK * std::sin(b)) / arm.FG;
  const double a = std::asin(std::clamp(sine, -1.0, 1.0));
  return {.q_d = tip.x - arm.x_F - arm.FG * std::cos(a) - arm.GK * std::cos(b), .a = a, .b = b};
}

TipRates tip_rates(const ArmGeometry& arm, const ArmPose& pose, const ActuatorRates& rates) {
  const double omega = rates.boom + rates.tilt;
  return {.v_x = rates.drive - arm.FG * std::sin(pose.a) * rates.boom - arm.GK * std::sin(pose.b) * omega,
          .v_z = arm.FG * std::cos(pose.a) * rates.boom + arm.GK * std::cos(pose.b) * omega,
          .omega = omega};
}

ActuatorRates actuator_rates(const ArmGeometry& arm, const ArmPose& pose, const TipRates& rates) {
  const double cosine = std::cos(pose.a);
  const double lever = arm.FG * std::copysign(std::max(std::abs(cosine), least_cosine), cosine);
  const double boom = (rates.v_z - arm.GK * std::cos(pose.b) * rates.omega) / lever;
  return {.drive = rates.v_x + arm.FG * std::sin(pose.a) * boom + arm.GK * std::sin(pose.b) * rates.omega,
          .boom = boom,
          .tilt = rates.omega - boom};
}

ActuatorRates within_limits(const ActuatorRates& rates, const RateLimits& limits) {
  double factor = 1;
  const auto limit = [&](double rate, double largest) {
    if (std::abs(rate) > largest) factor = std::min(factor, largest / std::abs(rate));
  };
  limit(rates.drive, limits.drive);
  limit(rates.boom, limits.boom);
  limit(rates.tilt, limits.tilt);
  return {.drive = factor * rates.drive, .boom = factor * rates.boom, .tilt = factor * rates.tilt};
}

}  // namespace drawpoint::engine::loading
