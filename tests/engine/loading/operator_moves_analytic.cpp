// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// When an operator pulses, presses and crowds: counted steps of a clock, and the executor on plants that hold
// the drive up. All numbers are exact up to one step of the clock, h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/strategy/executor.hpp>
#include <drawpoint/engine/loading/strategy/operator_moves.hpp>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

constexpr double h = 1.0 / 128;  // sums of it are exact

OperatorMoves moves_of_the_clock() {
  return {.most_pulses = 2, .held_up = 32 * h, .pulse = 64 * h, .pulse_rates = {0, 0.1, 0.2}};
}

Plan a_plan(double height) {
  Plan plan;
  plan.feasible = true;
  plan.toe = 10;
  plan.depth = 1.4;
  plan.height = height;
  plan.slope = 38 * std::numbers::pi / 180;
  plan.tilt = 0.4 * plan.slope;
  plan.phi_max = 0.8;
  plan.corners = corner_points(plan, 2.0, ArmGeometry());
  return plan;
}

struct Step {
  double time;
  Stage stage;
  ActuatorRates set;
  double drive_share;
};

struct Cycle {
  std::vector<Step> steps;
  std::vector<StageResult> results;

  std::vector<Step> of(Stage stage) const {
    std::vector<Step> own;
    std::copy_if(steps.begin(), steps.end(), std::back_inserter(own),
                 [&](const Step& step) { return step.stage == stage; });
    return own;
  }
  const StageResult& result(Stage stage) const {
    return *std::find_if(results.begin(), results.end(), [&](const auto& r) { return r.stage == stage; });
  }
};

using Plant = std::function<ActuatorRates(const ActuatorRates& set, const TipPose& tip, Stage stage)>;

Cycle cycle_on(const Plan& plan, const OperatorMoves& moves, const Plant& plant) {
  ExecutorOptions options;
  options.moves = moves;
  const ArmGeometry arm;
  Executor executor(plan, arm, options);
  ArmPose pose = arm_pose(arm, {.x = plan.toe - 2.0});
  ActuatorRates actual;
  Cycle cycle;
  for (int k = 0; k < 90 * 128 && !executor.finished(); ++k) {
    const TipPose tip = tip_pose(arm, pose);
    const ActuatorRates set = executor.step({.time = k * h, .tip = tip, .actual = actual});
    cycle.steps.push_back({k * h, executor.stage(), set, executor.drive_share()});
    actual = plant(set, tip, executor.stage());
    pose.q_d += actual.drive * h;
    pose.a += actual.boom * h;
    pose.b += (actual.boom + actual.tilt) * h;
  }
  cycle.results = executor.results();
  return cycle;
}

// A pile that the drive does not enter by more than a metre.
ActuatorRates pile_that_holds(const ActuatorRates& set, const TipPose& tip, Stage) {
  return {.drive = tip.x < 11 ? set.drive : std::min(set.drive, 0.0), .boom = set.boom, .tilt = set.tilt};
}

}  // namespace

// Slow from the clock's zero on: pulses from 32 h to 96 h and, 32 h after, from 128 h to 192 h, with 32 h after the last one.
TEST(Pulses, ComeWhenTheDriveIsHeldUpAndLeaveItTimeBetween) {
  Pulses pulses(moves_of_the_clock());
  for (int k = 0; k < 400; ++k) {
    const bool due = (k >= 32 && k < 96) || (k >= 128 && k < 192);
    EXPECT_EQ(pulses.step(k * h, k * h), due) << k;
    EXPECT_EQ(pulses.left(), k < 224) << k;
  }
}

TEST(Pulses, DoNotComeToADriveThatMoves) {
  Pulses pulses(moves_of_the_clock());
  for (int k = 0; k < 400; ++k) EXPECT_FALSE(pulses.step(k * h, 31 * h)) << k;
  EXPECT_TRUE(pulses.left());
}

TEST(OperatorMoves, NoneAreMadeByDefault) {
  const Cycle cycle = cycle_on(a_plan(1), {}, pile_that_holds);
  for (const Step& step : cycle.of(Stage::drive_in)) EXPECT_EQ(step.set.boom, 0);
  for (const Step& step : cycle.of(Stage::curl)) EXPECT_EQ(step.set.drive, 0);
}

// Without pulses the drive-in ends when the drive has been slow for 1 s; with them they come first: two of 64
// steps, at the arm's rates, and the drive pushes all along.
TEST(OperatorMoves, PulsesComeBeforeADriveInIsStuck) {
  const OperatorMoves moves = moves_of_the_clock();
  const Cycle cycle = cycle_on(a_plan(1), moves, pile_that_holds);
  int pulsed = 0, steps = 0;
  for (const Step& step : cycle.of(Stage::drive_in)) {
    const SpeedPreset speeds = machine_speeds();
    EXPECT_NEAR(step.set.drive, std::min(speeds.drive_in, steps++ * h * speeds.limits.drive_acceleration),
                1e-12);
    EXPECT_EQ(step.set.boom > 0, step.set.tilt > 0);
    if (step.set.boom == 0) continue;
    EXPECT_EQ(step.set.boom, moves.pulse_rates.boom);
    EXPECT_EQ(step.set.tilt, moves.pulse_rates.tilt);
    ++pulsed;
  }
  EXPECT_EQ(pulsed, 2 * 64);
  EXPECT_EQ(cycle.result(Stage::drive_in).reason, StageEnd::slow_actuator);
  // Slow since it is held up, at t; pulses as above from there, and one step for each of the two that see it.
  const auto held_up = std::find_if(cycle.steps.begin(), cycle.steps.end(),
                                    [](const Step& step) { return step.set.boom > 0; });
  EXPECT_NEAR(cycle.result(Stage::drive_in).t_end - held_up->time, (224 - 32) * h, 2 * h);
}

// The drive is held up from the start of the lift: the plan's rule ends it after 1 s, pressing lets the arm come to its height.
TEST(OperatorMoves, APressingDriveLetsTheLiftComeToItsHeight) {
  OperatorMoves moves;
  const Plan plan = a_plan(1.5);
  const Cycle before = cycle_on(plan, moves, pile_that_holds);
  moves.press = true;
  const Cycle with = cycle_on(plan, moves, pile_that_holds);
  EXPECT_EQ(before.result(Stage::lift).reason, StageEnd::slow_actuator);
  EXPECT_LT(before.result(Stage::lift).end.z, 0.6 * plan.height);
  // It slows down to the floor of the speeds (5 %) and ends when no set speed of the arm is above the least one.
  EXPECT_GT(with.result(Stage::lift).end.z, 0.9 * plan.height);
}

// The drive's set speed falls as the curl does, from `crowd` to the floor of the speeds; a drive that does not move then
// is not stuck, and the curl comes to its angle.
TEST(OperatorMoves, CrowdingPushesThroughTheCurl) {
  OperatorMoves moves;
  moves.crowd = 0.5;
  const Cycle cycle = cycle_on(a_plan(1), moves, pile_that_holds);
  const std::vector<Step> curl = cycle.of(Stage::curl);
  ASSERT_FALSE(curl.empty());
  EXPECT_DOUBLE_EQ(curl.front().set.drive, moves.crowd);
  for (std::size_t k = 0; k < curl.size(); ++k) {
    EXPECT_DOUBLE_EQ(curl[k].set.drive / moves.crowd, curl[k].set.tilt / machine_speeds().curl);
    if (k > 0) {
      EXPECT_LE(curl[k].set.drive, curl[k - 1].set.drive);
    }
  }
  EXPECT_EQ(cycle.result(Stage::curl).reason, StageEnd::goal);
}

TEST(OperatorMoves, TheDriveIsReleasedInTheCurlOnly) {
  OperatorMoves moves;
  for (const double hold : {0.0, 0.4, 1.0}) {
    moves.curl_hold = hold;
    for (const Step& step : cycle_on(a_plan(1), moves, pile_that_holds).steps)
      EXPECT_EQ(step.drive_share, step.stage == Stage::curl ? hold : 1) << name(step.stage);
  }
}

TEST(OperatorMoves, RefuseWhatMakesNoSense) {
  const auto message = [](const OperatorMoves& moves) {
    ExecutorOptions options;
    options.moves = moves;
    try {
      Executor(a_plan(1), ArmGeometry(), options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message({.most_pulses = -1}),
            "loading::OperatorMoves: most_pulses [1] is -1.000000; give 0 to 100");
  EXPECT_EQ(message({.pulse = 0}),
            "loading::OperatorMoves: pulse [s] is 0.000000; give a finite value above 0");
  EXPECT_EQ(message({.crowd = std::nan("")}),
            "loading::OperatorMoves: crowd [m/s] is nan; give a finite value of at least 0");
  EXPECT_EQ(
      message({.pulse_rates = {.drive = 1}}),
      "loading::OperatorMoves: pulse_rates.drive [m/s] is 1.000000; give 0; the drive keeps the speed of the "
      "drive-in");
  EXPECT_EQ(message({.curl_hold = 1.5}), "loading::OperatorMoves: curl_hold [1] is 1.500000; give 0 to 1");
  EXPECT_EQ(message({.crowd = 0.5, .curl_hold = 0}),
            "loading::OperatorMoves: curl_hold [1] is 0.000000; give a value above 0, or no crowd: released "
            "wheels do not push");
  EXPECT_EQ(message(skilled_operator()), "");
}
