// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Points as they are typed: numbers, names of levels, and what is neither.

#include <drawpoint/studies/commands/options/points.h>
#include <drawpoint/studies/run/settings.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

const doe::Problem crushing{{{"speed", "m/s", 0.1, 2},
                             doe::categorical_variable("plate", {"smooth", "ribbed", "toothed"}),
                             doe::integer_variable("teeth", "1", 1, 8)},
                            {{"wear", "mm"}}};

std::string refusal(const std::vector<std::string>& x) {
  try {
    checked_points(crushing, x);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(TypedPoints, ALevelIsItsNameOrItsNumber) {
  const Eigen::MatrixXd named = checked_points(crushing, {"0.3", "toothed", "4", "1e-1", "0", "8"});
  EXPECT_EQ(named, (Eigen::MatrixXd(2, 3) << 0.3, 2, 4, 0.1, 0, 8).finished());
}

TEST(TypedPoints, WhatIsTypedAnewIsTheSamePoint) {
  const Eigen::VectorXd point = Eigen::Vector3d(0.1 + 0.2, 1, 7);
  EXPECT_EQ(checked_points(crushing, typed(point)).row(0).transpose(), point);
}

TEST(TypedPoints, WhatIsNoValueIsRefusedWithWhatWouldBe) {
  EXPECT_EQ(refusal({"0.3", "ribed", "4"}),
            "--x: plate = \"ribed\" is no number; give one of smooth, ribbed, toothed");
  EXPECT_EQ(refusal({"fast", "smooth", "4"}), "--x: speed = \"fast\" is no number");
  EXPECT_EQ(refusal({"nan", "smooth", "4"}), "--x: speed = \"nan\" is no number");
  EXPECT_EQ(refusal({"3", "smooth", "4"}), "--x: speed = 3 m/s is outside its range 0.1 to 2 m/s");
  EXPECT_EQ(refusal({"1", "smooth", "4.5"}),
            "--x: teeth = 4.5 is not whole; give a whole number from 1 to 8");
  EXPECT_EQ(refusal({"1", "smooth"}), "--x: got 2 values, need 3: speed, plate, teeth");
}

}  // namespace
