// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// When an operator makes which move, eases the throttle and crowds: counted steps of a clock, and the executor on
// plants that hold the drive up. All numbers are exact up to one step of the clock, h.
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
  return {.round = {{.boom = 0.1, .tilt = 0.2, .time = 64 * h}, {.boom = 0, .tilt = -0.3, .time = 64 * h}},
          .held_up = 32 * h};
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

Cycle cycle_on(const Plan& plan, const OperatorMoves& moves, const Plant& plant,
               LiftEnd lift_end = LiftEnd::arm) {
  ExecutorOptions options;
  options.moves = moves;
  options.lift_end = lift_end;
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

// Slow from the clock's zero on: the first move from 32 h to 96 h and, 32 h after, the second from 128 h to 192 h, with
// 32 h after the last one; a second round goes on so.
TEST(MoveSequence, ComesWhenTheDriveIsHeldUpAndLeavesItTimeBetween) {
  for (const int rounds : {1, 2}) {
    OperatorMoves moves = moves_of_the_clock();
    moves.rounds = rounds;
    MoveSequence sequence(moves);
    for (int k = 0; k < 600; ++k) {
      sequence.step(k * h, k * h);
      const int number = k < 32 ? -1 : (k - 32) / 96;  // 64 of a move, 32 after it
      const bool due = number >= 0 && number < 2 * rounds && (k - 32) % 96 < 64;
      ASSERT_EQ(sequence.current() != nullptr, due) << k;
      if (due) {
        EXPECT_EQ(sequence.current()->tilt, number % 2 == 0 ? 0.2 : -0.3) << k;
      }
      EXPECT_EQ(sequence.left(), k < 32 + 96 * 2 * rounds) << k;
    }
  }
}

TEST(MoveSequence, DoesNotComeToADriveThatMoves) {
  MoveSequence sequence(moves_of_the_clock());
  for (int k = 0; k < 400; ++k) {
    sequence.step(k * h, 31 * h);
    EXPECT_EQ(sequence.current(), nullptr) << k;
  }
  EXPECT_TRUE(sequence.left());
}

TEST(OperatorMoves, NoneAreMadeByDefault) {
  const Cycle cycle = cycle_on(a_plan(1), {}, pile_that_holds);
  for (const Step& step : cycle.of(Stage::drive_in)) EXPECT_EQ(step.set.boom, 0);
  for (const Step& step : cycle.of(Stage::curl)) EXPECT_EQ(step.set.drive, 0);
}

// Without moves the drive-in ends when the drive has been slow for half a second; with them they come first: a lift and
// a dump of 64 steps each, at the arm's rates, and the drive pushes all along.
TEST(OperatorMoves, ComeBeforeADriveInIsStuck) {
  const OperatorMoves moves = moves_of_the_clock();
  const Cycle cycle = cycle_on(a_plan(1), moves, pile_that_holds);
  int lifted = 0, dumped = 0, steps = 0;
  for (const Step& step : cycle.of(Stage::drive_in)) {
    const SpeedPreset speeds = machine_speeds();
    EXPECT_NEAR(step.set.drive, std::min(speeds.drive_in, steps++ * h * speeds.limits.drive_acceleration),
                1e-12);
    EXPECT_EQ(step.set.boom > 0, step.set.tilt > 0);
    lifted += step.set.tilt == 0.2 && step.set.boom == 0.1;
    dumped += step.set.tilt == -0.3;
  }
  EXPECT_EQ(lifted, 64);
  EXPECT_EQ(dumped, 64);
  EXPECT_EQ(cycle.result(Stage::drive_in).reason, StageEnd::slow_actuator);
  // Slow since it is held up, at t; moves as above from there, and one step for each of the two that see it.
  const auto held_up = std::find_if(cycle.steps.begin(), cycle.steps.end(),
                                    [](const Step& step) { return step.set.boom > 0; });
  EXPECT_NEAR(cycle.result(Stage::drive_in).t_end - held_up->time, (224 - 32) * h, 2 * h);
}

// A lift of 2 s against rock that holds the arm ends by its own time, and not as a stuck drive-in: 256 steps.
TEST(OperatorMoves, AnArmThatIsHeldUpEndsNoMove) {
  const auto rock_that_holds = [](const ActuatorRates& set, const TipPose& tip, Stage stage) {
    const ActuatorRates actual = pile_that_holds(set, tip, stage);
    return stage == Stage::drive_in ? ActuatorRates{.drive = actual.drive} : actual;
  };
  const Cycle cycle = cycle_on(a_plan(1), {.round = {{.boom = 0.1, .time = 256 * h}}}, rock_that_holds);
  const std::vector<Step> steps = cycle.of(Stage::drive_in);
  EXPECT_EQ(std::count_if(steps.begin(), steps.end(), [](const Step& step) { return step.set.boom > 0; }),
            256);
}

// The drive is held up from the start of the lift: the source's rule ends it after half a second; while the arm moves
// it goes on.
TEST(OperatorMoves, ADriveThatIsHeldUpLetsTheLiftComeToItsHeight) {
  const Plan plan = a_plan(1.5);
  const Cycle source = cycle_on(plan, {}, pile_that_holds, LiftEnd::any_actuator);
  const Cycle usual = cycle_on(plan, {}, pile_that_holds);
  EXPECT_EQ(source.result(Stage::lift).reason, StageEnd::slow_actuator);
  EXPECT_LT(source.result(Stage::lift).end.z, 0.6 * plan.height);
  // It goes up as a share of what is left, and ends when the arm is set to less than a tenth of its limits: 0.02 of
  // 0.2 rad/s, 0.06 m/s of the tip, where the first speed is 0.4 m/s.
  EXPECT_GT(usual.result(Stage::lift).end.z, (1 - 0.06 / 0.4) * plan.height - 0.05);
}

// Turning the bucket up about an edge that stays low would take the boom down, and its heel into the floor.
TEST(OperatorMoves, NoLiftLowersTheBoom) {
  Plan plan = a_plan(0.1);
  plan.tilt = plan.slope;
  plan.corners = corner_points(plan, 2.0, ArmGeometry());
  const Cycle cycle = cycle_on(plan, {}, pile_that_holds);
  const std::vector<Step> lift = cycle.of(Stage::lift);
  ASSERT_FALSE(lift.empty());
  EXPECT_GT(lift.front().set.tilt, 0);
  for (const Step& step : lift) EXPECT_GE(step.set.boom, 0);
  EXPECT_GT(cycle.result(Stage::lift).end.phi, 0.8 * plan.tilt) << "it turns all the same";
}

// Wheels are set no faster than the machine moves and `most_slip` beyond.
TEST(OperatorMoves, TheThrottleIsEasedWhereWheelsWouldSpin) {
  OperatorMoves moves;
  moves.most_slip = 0.25;
  bool eased = false;
  double before = 0;
  for (const Step& step :
       cycle_on(a_plan(1), moves, [&](const ActuatorRates&set, const TipPose&tip, Stage stage) {
         EXPECT_LE(set.drive, before + 0.25);
         eased = eased || (stage == Stage::drive_in && set.drive == before + 0.25);
         const ActuatorRates actual = pile_that_holds(set, tip, stage);
         before = std::max(actual.drive, 0.0);
         return actual;
       }).steps)
    EXPECT_TRUE(std::isfinite(step.set.drive));
  EXPECT_TRUE(eased);
}

// The drive's set speed falls as the curl does, from `crowd` to the floor of the speeds; a drive that does not move
// then is not stuck, and the curl comes to its angle.
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
  EXPECT_EQ(message({.rounds = 0}), "loading::OperatorMoves: rounds [1] is 0.000000; give 1 to 100");
  EXPECT_EQ(message({.round = {{.tilt = -0.4, .time = 0}}}),
            "loading::OperatorMoves: round.time [s] is 0.000000; give a finite value above 0");
  EXPECT_EQ(message({.round = {{.tilt = std::nan(""), .time = 0.5}}}),
            "loading::OperatorMoves: round.tilt [rad/s] is nan; give a finite value");
  EXPECT_EQ(message({.crowd = std::nan("")}),
            "loading::OperatorMoves: crowd [m/s] is nan; give a finite value of at least 0");
  EXPECT_EQ(message({.most_slip = 0}),
            "loading::OperatorMoves: most_slip [m/s] is 0.000000; give a value above 0; infinity: the "
            "throttle is not "
            "eased");
  EXPECT_EQ(message({.curl_hold = 1.5}), "loading::OperatorMoves: curl_hold [1] is 1.500000; give 0 to 1");
  EXPECT_EQ(message({.crowd = 0.5, .curl_hold = 0}),
            "loading::OperatorMoves: curl_hold [1] is 0.000000; give a value above 0, or no crowd: released "
            "wheels do not push");
  EXPECT_EQ(message(skilled_operator()), "");
}
