// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The crash into a fixed rock. Its end is statics: the wheels push at their torque limit, F = 4 M / r, against a rock
// at a known place across the bucket.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/yield_test.hpp>
#include <stdexcept>
#include <string>

using namespace drawpoint::engine::loading;

namespace {

Scenario scenario() { return with_speeds(lh621_in_a_drift(), "machine"); }

std::string refusal(const YieldTestOptions& options) {
  try {
    yield_test(scenario(), options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

}  // namespace

// F = 4 · 81 kN m / 0.93 m = 348 kN at most, and what the tyres hold (0.65 · 57 t · g = 363 kN) at most. About the
// vertical the hinge bears F y − F_y a: y the place of the contact, the rock's give or take half of its width, 0.15 m;
// F_y the side force, by friction on steel at most 0.5 F; a = 1.8 m from pin to edge. The rock's face leans by 20° at
// most: F_z is at most tan(20° + 27°) F = 1.1 F and adds F_z y about the long axis. In the middle only the rock's half
// width and F_y are left.
TEST(YieldTest, EndsWithTheThrustTimesItsArm) {
  const double thrust = 4 * LhdOptions().wheel_torque / 0.93;
  const auto end = [&](double offset) {
    return yield_test(scenario(), {.rock_size = 0.3, .offset = offset, .after_touch = 4}).twisting.back();
  };
  const auto most = [&](double y) { return thrust * std::hypot(y + 0.5 * 1.8, 1.1 * y); };
  for (const double offset : {0.8, -0.8}) {
    EXPECT_LT(end(offset), most(0.8 + 0.15)) << offset;
    EXPECT_GT(end(offset), end(0)) << offset;
  }
}

// Wheels are set by their mean rolling radius, known to half of the 8 % between loaded and free.
TEST(YieldTest, TouchesAtTheDriveInSpeed) {
  const YieldTest test = yield_test(scenario());
  EXPECT_NEAR(test.touch_speed, machine_speeds().drive_in, 0.04 * machine_speeds().drive_in);
  EXPECT_EQ(test.time.front(), 0);
  EXPECT_EQ(test.time.size(), test.torque.size());
}

// A low-pass of a signal never exceeds its largest magnitude: each value is a mean, with positive weights, of those
// before. The filter runs from the approach on, when the hinge bears the bucket's weight alone: at the touch it takes
// up 1 − exp(−2π 20 Hz 10 ms) = 0.715 of the step, and the largest value of a peak of one or two steps is 0.92 of it at
// most. Away from the middle the same push has the longer arm.
TEST(YieldTest, PeaksAreOrdered) {
  const YieldTest middle = yield_test(scenario()), side = yield_test(scenario(), {.offset = 1.2});
  for (const YieldTest& test : {middle, side}) {
    EXPECT_EQ(test.peak, *std::max_element(test.torque.begin(), test.torque.end()));
    EXPECT_LE(test.peak, test.unfiltered_peak);
    EXPECT_LE(test.peak_twisting, test.peak);
    EXPECT_GT(test.peak, 0);
  }
  EXPECT_GT(side.peak_twisting, middle.peak_twisting);
  EXPECT_LT(side.torque.front(), 0.75 * side.unfiltered_peak);
  EXPECT_EQ(yield_test(scenario(), {.lowpass_hz = 0}).peak, middle.unfiltered_peak);
}

TEST(YieldTest, RefusesWhatMakesNoSense) {
  EXPECT_EQ(refusal({.rock_size = 0.1}),
            "loading::YieldTestOptions: rock_size [m] is 0.100000; give 0.3 to 3 m");
  EXPECT_EQ(
      refusal({.offset = 2}),
      "loading::YieldTestOptions: offset [m] is 2.000000; give -1.600000 to 1.600000 m, the bucket's edge");
  EXPECT_EQ(refusal({.lowpass_hz = -1}),
            "loading::YieldTestOptions: lowpass_hz [Hz] is -1.000000; give 0 (none) or more");
  EXPECT_EQ(refusal({.run_up = 0}), "loading::YieldTestOptions: run_up [m] is 0.000000; give 0.5 to 50 m");
}

TEST(YieldTest, RefusesAMachineThatIsNotSetToDrive) {
  for (const double speed : {0.0, -1.0, std::nan("")}) {
    Scenario standing = scenario();
    standing.executor.speeds.drive_in = speed;
    EXPECT_THROW(yield_test(standing), std::invalid_argument) << speed;
  }
}

TEST(YieldTest, SaysThatTheMachineDoesNotCome) {
  Scenario weak = scenario();
  weak.machine.wheel_torque = 1;
  EXPECT_THROW(yield_test(weak), std::runtime_error);
}
