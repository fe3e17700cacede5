// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The arm's kinematics (Lindmark 2016, equations 25-37) against numbers that were computed independently and
// printed to nine decimals: tolerance 5e-10 and round-off.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/strategy/kinematics.hpp>
#include <drawpoint/tests/engine/loading/denavit_hartenberg.hpp>
#include <limits>
#include <numbers>
#include <random>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double printed = 5.1e-10;

const ArmGeometry vector_arm{.FG = 2.3, .GK = 1.6, .x_F = 0.4, .z_F = 0.9, .psi_b = 0.35};
const DhJoints vector_joints{.q_d = 1.2, .theta_2 = 2.0, .theta_3 = -0.3};
const TipRates vector_rates{.v_x = 0.8, .v_z = 0.25, .omega = 0.4};

// Poses at least 0.3 rad from the vertical boom, where the inverse amplifies round-off by less than 4.
ArmPose random_pose(std::mt19937& bits) {
  std::uniform_real_distribution<double> drive(-5, 20), boom(-1.2, 1.2), tip(-1.5, 1.5);
  return {.q_d = drive(bits), .a = boom(bits), .b = tip(bits)};
}

TEST(Kinematics, TipOfTheTestVector) {
  const Eigen::Matrix4d T = dh_tip_frame(vector_arm, vector_joints);
  EXPECT_NEAR(T(0, 3), -0.263288915, printed);
  EXPECT_NEAR(T(2, 3), 5.278047778, printed);
  EXPECT_NEAR(T(0, 0), -0.461072691, printed);
  EXPECT_NEAR(T(1, 0), 0, 1e-15);
  EXPECT_NEAR(T(2, 0), 0.887362369, printed);
}

TEST(Kinematics, ElevationsOfTheTestVector) {
  const ArmPose pose = arm_pose(vector_joints);
  EXPECT_NEAR(pose.a / degree, -24.591559026, printed);
  EXPECT_NEAR(pose.b / degree, -7.402825172, printed);
  const TipPose tip = tip_pose(vector_arm, pose);
  EXPECT_NEAR(tip.phi / degree, -27.456348002, printed);
  EXPECT_NEAR(tip.z, -0.263288915, printed);
  EXPECT_NEAR(tip.x, 5.278047778, printed);
}

TEST(Kinematics, InverseRatesOfTheTestVector) {
  const DhJoints rates = dh_inverse_rates(vector_arm, vector_joints, vector_rates);
  EXPECT_NEAR(rates.theta_2, 0.183928663, printed);
  EXPECT_NEAR(rates.theta_3, -0.583928663, printed);
  EXPECT_NEAR(rates.q_d, 0.893584586, printed);
}

// Why the correction of the Jacobian matters: with the printed sign the boom would turn the other way.
TEST(Kinematics, ThePrintedJacobianReversesTheBoom) {
  Eigen::Matrix<double, 6, 3> J = dh_jacobian(vector_arm, vector_joints);
  J(0, 1) += 2 * vector_arm.FG * std::sin(vector_joints.theta_2);
  Eigen::Matrix3d square;
  square << J.row(0), J.row(2), J.row(4);
  const Eigen::Vector3d rates =
      square.inverse() * Eigen::Vector3d(vector_rates.v_z, vector_rates.v_x, vector_rates.omega);
  EXPECT_NEAR(rates[0], 0.541494461, printed);
  EXPECT_NEAR(rates[1], -0.183928663, printed);
  EXPECT_NEAR(rates[2], -0.216071337, printed);
}

TEST(Kinematics, LinkTransformsAreProperAndMultiplyToTheClosedForm) {
  std::mt19937 bits(4);
  for (int k = 0; k < 200; ++k) {
    const ArmPose pose = random_pose(bits);
    const DhJoints joints = dh_joints(pose);
    for (const Eigen::Matrix4d& A : dh_link_transforms(vector_arm, joints))
      EXPECT_NEAR((A.topLeftCorner<3, 3>().determinant()), 1, 1e-14);
    const Eigen::Matrix4d T = dh_tip_frame(vector_arm, joints);
    const TipPose tip = tip_pose(vector_arm, pose);
    // Coordinates reach 24 m: 1e-14 is two to three units in their last place.
    EXPECT_NEAR(T(0, 3), tip.z, 1e-14);
    EXPECT_NEAR(T(2, 3), tip.x, 1e-14);
    EXPECT_NEAR(T(0, 0), std::sin(tip.phi), 1e-14);
    EXPECT_NEAR(T(2, 0), std::cos(tip.phi), 1e-14);
    EXPECT_NEAR(T(1, 2), 1, 1e-14);
  }
}

// Central differences with step e: truncation e²/6 times a third derivative of at most FG + GK = 3.9,
// round-off 2e-16 * 24 m / e. With e = 1e-5 that is 6e-11 + 5e-10.
TEST(Kinematics, JacobianIsTheDerivativeOfThePose) {
  std::mt19937 bits(5);
  constexpr double e = 1e-5;
  for (int k = 0; k < 100; ++k) {
    const DhJoints joints = dh_joints(random_pose(bits));
    const auto J = dh_jacobian(vector_arm, joints);
    for (int column = 0; column < 3; ++column) {
      DhJoints plus = joints, minus = joints;
      (column == 0 ? plus.q_d : column == 1 ? plus.theta_2 : plus.theta_3) += e;
      (column == 0 ? minus.q_d : column == 1 ? minus.theta_2 : minus.theta_3) -= e;
      const TipPose high = tip_pose(vector_arm, arm_pose(plus)), low = tip_pose(vector_arm, arm_pose(minus));
      EXPECT_NEAR(J(0, column), (high.z - low.z) / (2 * e), 1e-9);
      EXPECT_NEAR(J(2, column), (high.x - low.x) / (2 * e), 1e-9);
      EXPECT_NEAR(J(4, column), (high.phi - low.phi) / (2 * e), 1e-9);
    }
  }
}

TEST(Kinematics, BothInversesAgreeAndInvertTheForwardRates) {
  std::mt19937 bits(6);
  std::uniform_real_distribution<double> rate(-2, 2);
  for (int k = 0; k < 500; ++k) {
    const ArmPose pose = random_pose(bits);
    const TipRates wanted{.v_x = rate(bits), .v_z = rate(bits), .omega = rate(bits)};
    const ActuatorRates rates = actuator_rates(vector_arm, pose, wanted);
    const DhJoints dh = dh_inverse_rates(vector_arm, dh_joints(pose), wanted);
    // Rates reach 20, and 1/cos a amplifies round-off by up to 2.8.
    EXPECT_NEAR(rates.drive, dh.q_d, 5e-14);
    EXPECT_NEAR(rates.boom, -dh.theta_2, 5e-14);
    EXPECT_NEAR(rates.tilt, -dh.theta_3, 5e-14);
    const TipRates back = tip_rates(vector_arm, pose, rates);
    EXPECT_NEAR(back.v_x, wanted.v_x, 5e-14);
    EXPECT_NEAR(back.v_z, wanted.v_z, 5e-14);
    EXPECT_NEAR(back.omega, wanted.omega, 5e-14);
  }
}

TEST(Kinematics, ArmPoseInvertsTipPose) {
  std::mt19937 bits(7);
  for (int k = 0; k < 500; ++k) {
    const ArmPose pose = random_pose(bits);
    const ArmPose back = arm_pose(vector_arm, tip_pose(vector_arm, pose));
    EXPECT_NEAR(back.a, pose.a, 1e-14);
    EXPECT_NEAR(back.b, pose.b, 1e-14);
    EXPECT_NEAR(back.q_d, pose.q_d, 5e-14);
  }
  const ArmPose out_of_reach = arm_pose(vector_arm, {.x = 0, .z = 9, .phi = 0});
  EXPECT_DOUBLE_EQ(out_of_reach.a, std::numbers::pi / 2);
}

TEST(Kinematics, GeometryOfTheReferencePose) {
  const ArmGeometry arm = arm_geometry({-0.60, 0, 1.80}, {2.05, 0, 0.50}, {3.85, 0, 0.00});
  EXPECT_NEAR(arm.FG, 2.952, 5e-4);
  EXPECT_NEAR(arm.GK, 1.868, 5e-4);
  EXPECT_NEAR(arm.psi_b / degree, -15.52, 5e-3);
  const TipPose tip = tip_pose(arm, arm_pose(arm, {.x = 3.85, .z = 0, .phi = 0}));
  EXPECT_NEAR(tip.x, 3.85, 1e-14);
  EXPECT_NEAR(tip.z, 0, 1e-14);
  EXPECT_NEAR(arm_pose(arm, {.x = 3.85}).a / degree, -26.13, 5e-3);
}

TEST(Kinematics, LimitsScaleAllRatesByOneFactor) {
  const RateLimits limits{.drive = 1.0, .boom = 0.2, .tilt = 0.5};
  const ActuatorRates slow = within_limits({.drive = -0.9, .boom = 0.1, .tilt = -0.4}, limits);
  EXPECT_EQ(slow.drive, -0.9);
  EXPECT_EQ(slow.boom, 0.1);
  EXPECT_EQ(slow.tilt, -0.4);
  const ActuatorRates fast = within_limits({.drive = 2.0, .boom = -0.8, .tilt = 0.3}, limits);
  EXPECT_DOUBLE_EQ(fast.drive, 0.5);  // the boom asks for four times its limit
  EXPECT_DOUBLE_EQ(fast.boom, -0.2);
  EXPECT_DOUBLE_EQ(fast.tilt, 0.075);
}

TEST(Kinematics, AVerticalBoomGivesFiniteRates) {
  const double nearly_vertical = std::numbers::pi / 2;
  const ActuatorRates rates = within_limits(
      actuator_rates(vector_arm, {.q_d = 0, .a = nearly_vertical, .b = 0}, vector_rates), RateLimits{});
  EXPECT_TRUE(std::isfinite(rates.drive) && std::isfinite(rates.boom) && std::isfinite(rates.tilt));
  EXPECT_LE(std::abs(rates.boom), RateLimits{}.boom * (1 + std::numeric_limits<double>::epsilon()));
}

}  // namespace
