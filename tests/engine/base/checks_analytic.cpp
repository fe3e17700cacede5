// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/base/checks.hpp>

using namespace drawpoint::engine::detail;

namespace {

TEST(Checks, NumbersAreWrittenAsStreamsDo) {
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(1e-9), "1e-09");
  EXPECT_EQ(text(1234567.0), "1.23457e+06");
  EXPECT_EQ(text(std::nan("")), "nan");
  EXPECT_EQ(text(Eigen::Vector3d(1, -2, 0.5)), "(1, -2, 0.5)");
}

TEST(Checks, BothEndsOfARangeBelongToIt) {
  const Range allowed{0, 0.5, "m"};
  for (const double value : {0.0, 0.25, 0.5}) EXPECT_NO_THROW(require("World: slack", value, allowed));
  for (const double value : {-1e-9, 0.6, std::nan("")})
    EXPECT_THROW(require("World: slack", value, allowed), std::invalid_argument);
  try {
    require("World: slack", 0.6, allowed);
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "World: slack is 0.6 m; allowed: 0 to 0.5 m");
  }
}

TEST(Checks, UnitVectorsWithinTheTolerance) {
  EXPECT_TRUE(is_unit(Eigen::Vector3d(1, 2, 3).normalized()));
  EXPECT_TRUE(is_unit(Eigen::Vector3d(1 + 0.9e-9, 0, 0)));
  EXPECT_FALSE(is_unit(Eigen::Vector3d(1 + 1.1e-9, 0, 0)));
  EXPECT_FALSE(is_unit(Eigen::Vector3d(std::nan(""), 0, 0)));
}

// A shear by s takes RᵀR to (0, s; s, s²), so to a norm of √2 s but for s².
TEST(Checks, RotationsWithinTheTolerance) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const auto sheared = [&](double s) {
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear(0, 1) = s;
    return Eigen::Matrix3d(R * shear);
  };
  EXPECT_TRUE(is_rotation(R));
  EXPECT_NEAR(off_orthonormal(sheared(1e-4)), std::sqrt(2.0) * 1e-4, 1e-8);
  EXPECT_TRUE(is_rotation(sheared(0.9e-6 / std::sqrt(2.0))));
  EXPECT_FALSE(is_rotation(sheared(1.1e-6 / std::sqrt(2.0))));
  EXPECT_FALSE(is_rotation(-R)) << "a reflection";
  EXPECT_FALSE(is_rotation(Eigen::Matrix3d::Constant(std::nan(""))));
}

}  // namespace
