// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/kinematics.hpp>
#include <numbers>

namespace drawpoint::engine::loading {
namespace {

constexpr double half_pi = std::numbers::pi / 2;
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

DhJoints dh_joints(const ArmPose& pose) {
  return {.q_d = pose.q_d, .theta_2 = half_pi - pose.a, .theta_3 = pose.a - pose.b};
}

ArmPose arm_pose(const DhJoints& joints) {
  return {.q_d = joints.q_d, .a = half_pi - joints.theta_2, .b = half_pi - joints.theta_2 - joints.theta_3};
}

std::array<Eigen::Matrix4d, 4> dh_link_transforms(const ArmGeometry& arm, const DhJoints& joints) {
  const auto hinge = [](double theta, double length) {
    Eigen::Matrix4d A;
    A << std::cos(theta), -std::sin(theta), 0, length * std::cos(theta),  //
        std::sin(theta), std::cos(theta), 0, length * std::sin(theta),    //
        0, 0, 1, 0,                                                       //
        0, 0, 0, 1;
    return A;
  };
  Eigen::Matrix4d A_1, A_4;
  A_1 << 1, 0, 0, arm.z_F, 0, 0, -1, 0, 0, 1, 0, arm.x_F + joints.q_d, 0, 0, 0, 1;
  const double c = std::cos(arm.psi_b), s = std::sin(arm.psi_b);
  A_4 << c, s, 0, 0, s, -c, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1;
  return {A_1, hinge(joints.theta_2, arm.FG), hinge(joints.theta_3, arm.GK), A_4};
}

Eigen::Matrix4d dh_tip_frame(const ArmGeometry& arm, const DhJoints& joints) {
  const auto A = dh_link_transforms(arm, joints);
  return A[0] * A[1] * A[2] * A[3];
}

Eigen::Matrix<double, 6, 3> dh_jacobian(const ArmGeometry& arm, const DhJoints& joints) {
  const double theta_23 = joints.theta_2 + joints.theta_3;
  const double up_3 = -arm.GK * std::sin(theta_23), forward_3 = arm.GK * std::cos(theta_23);
  Eigen::Matrix<double, 6, 3> J = Eigen::Matrix<double, 6, 3>::Zero();
  J.row(0) << 0, up_3 - arm.FG * std::sin(joints.theta_2), up_3;
  J.row(2) << 1, forward_3 + arm.FG * std::cos(joints.theta_2), forward_3;
  J.row(4) << 0, -1, -1;
  return J;
}

DhJoints dh_inverse_rates(const ArmGeometry& arm, const DhJoints& joints, const TipRates& rates) {
  const double theta_23 = joints.theta_2 + joints.theta_3;
  const double rate_2 =
      (rates.omega * arm.GK * std::sin(theta_23) - rates.v_z) / (arm.FG * std::sin(joints.theta_2));
  const double rate_d =
      rates.v_x - rate_2 * arm.FG * std::cos(joints.theta_2) + rates.omega * arm.GK * std::cos(theta_23);
  return {.q_d = rate_d, .theta_2 = rate_2, .theta_3 = -rate_2 - rates.omega};
}

}  // namespace drawpoint::engine::loading
