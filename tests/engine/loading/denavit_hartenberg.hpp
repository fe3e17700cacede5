// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <drawpoint/engine/loading/strategy/kinematics.hpp>
#include <numbers>

/// The arm as a Denavit-Hartenberg chain, Lindmark (2016): the independent reference for kinematics.hpp.
/// Corrected matrices (entry (2,3) of A₂ and A₃ is 0, A₄ = R_z(ψ)R_x(π)) and the corrected sign in entry (1,2) of
/// the Jacobian. θ₂ = π/2 − a, θ₃ = a − b; frame 0 has its x axis up and its z axis forward; a₁ = z_F, d₁ = x_F.
namespace drawpoint::engine::loading {

struct DhJoints {
  double q_d = 0;                   ///< [m]
  double theta_2 = 0, theta_3 = 0;  ///< [rad]
};

inline DhJoints dh_joints(const ArmPose& pose) {
  return {.q_d = pose.q_d, .theta_2 = 0.5 * std::numbers::pi - pose.a, .theta_3 = pose.a - pose.b};
}

inline ArmPose arm_pose(const DhJoints& joints) {
  return {.q_d = joints.q_d,
          .a = 0.5 * std::numbers::pi - joints.theta_2,
          .b = 0.5 * std::numbers::pi - joints.theta_2 - joints.theta_3};
}

inline std::array<Eigen::Matrix4d, 4> dh_link_transforms(const ArmGeometry& arm, const DhJoints& joints) {
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

inline Eigen::Matrix4d dh_tip_frame(const ArmGeometry& arm, const DhJoints& joints) {
  const auto A = dh_link_transforms(arm, joints);
  return A[0] * A[1] * A[2] * A[3];
}

inline Eigen::Matrix<double, 6, 3> dh_jacobian(const ArmGeometry& arm, const DhJoints& joints) {
  const double theta_23 = joints.theta_2 + joints.theta_3;
  const double up_3 = -arm.GK * std::sin(theta_23), forward_3 = arm.GK * std::cos(theta_23);
  Eigen::Matrix<double, 6, 3> J = Eigen::Matrix<double, 6, 3>::Zero();
  J.row(0) << 0, up_3 - arm.FG * std::sin(joints.theta_2), up_3;
  J.row(2) << 1, forward_3 + arm.FG * std::cos(joints.theta_2), forward_3;
  J.row(4) << 0, -1, -1;
  return J;
}

inline DhJoints dh_inverse_rates(const ArmGeometry& arm, const DhJoints& joints, const TipRates& rates) {
  const double theta_23 = joints.theta_2 + joints.theta_3;
  const double rate_2 =
      (rates.omega * arm.GK * std::sin(theta_23) - rates.v_z) / (arm.FG * std::sin(joints.theta_2));
  const double rate_d =
      rates.v_x - rate_2 * arm.FG * std::cos(joints.theta_2) + rates.omega * arm.GK * std::cos(theta_23);
  return {.q_d = rate_d, .theta_2 = rate_2, .theta_3 = -rate_2 - rates.omega};
}

}  // namespace drawpoint::engine::loading
