// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Ways that are not simulated take what the executor takes on a machine that does as it is told: to the step of the
// clock.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/strategy/left_out.hpp>
#include <numbers>
#include <vector>

using namespace drawpoint::engine::loading;

namespace {

Plan plan_of(double depth, double height) {
  Plan plan;
  plan.feasible = true;
  plan.toe = 10;
  plan.depth = depth;
  plan.height = height;
  plan.slope = 35 * std::numbers::pi / 180;
  plan.tilt = 0.5 * plan.slope;
  plan.phi_max = 0.78;
  plan.corners = corner_points(plan, 2.0, ArmGeometry());
  return plan;
}

struct Moment {
  double time, tip_x, drive, stage_time, done, whole;
  Stage stage;
};

// A machine without mass or rock, stepped by h.
std::vector<Moment> driven(const Plan& plan, const ExecutorOptions& options, double h) {
  const ArmGeometry arm;
  Executor executor(plan, arm, options);
  ArmPose pose = arm_pose(arm, {.x = plan.corners[0].x});
  ActuatorRates actual;
  std::vector<Moment> moments;
  for (int k = 0; k * h < 60 && !executor.finished(); ++k) {
    const TipPose tip = tip_pose(arm, pose);
    const ActuatorRates set = executor.step({.time = k * h, .tip = tip, .actual = actual});
    const double whole = -executor.goal().x;
    moments.push_back({k * h, tip.x, actual.drive, executor.stage_time(), executor.progress() * whole, whole,
                       executor.stage()});
    actual = set;
    pose.q_d += set.drive * h;
    pose.a += set.boom * h;
    pose.b += (set.boom + set.tilt) * h;
  }
  return moments;
}

}  // namespace

// t = v/(2a) + L/v beyond the way v²/2a in which it gains its speed, √(2 L/a) before it.
TEST(LeftOut, ApproachIsUniformAccelerationThenSpeed) {
  SpeedPreset speeds = lindmark2016_speeds();  // 1.5 m/s, 2 m/s²
  EXPECT_DOUBLE_EQ(approach(2, speeds).time, 1.5 / 4 + 2 / 1.5);
  EXPECT_EQ(approach(2, speeds).speed, 1.5);
  EXPECT_DOUBLE_EQ(approach(0.25, speeds).speed, 1);
  EXPECT_DOUBLE_EQ(approach(0.25, speeds).time, 0.5);
  EXPECT_EQ(approach(0, speeds).time, 0);
  speeds.limits.drive_acceleration = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(approach(3, speeds).time, 2);
}

// From wherever the executor's own run is cut: its remaining time, to two steps of its clock and the millisecond of the
// sum.
TEST(LeftOut, TheSumOfBothPartsIsTheWhole) {
  constexpr double h = 0.002;
  for (const SpeedPreset& speeds : {lindmark2016_speeds(), machine_speeds()})
    for (const bool faithful : {false, true}) {
      ExecutorOptions options{.speeds = speeds};
      if (faithful) options.progress = faithful_progress();
      const std::vector<Moment> run = driven(plan_of(1.5, 1.0), options, h);
      ASSERT_EQ(run.back().stage, Stage::finished);
      int cuts = 0;
      for (const Moment& cut : run) {
        if (cut.stage != Stage::back_out || cuts++ % 100 != 50) continue;
        const LeftOut rest = way_back(cut.whole, cut.done, -cut.drive, cut.stage_time, options);
        EXPECT_NEAR(cut.time + rest.time, run.back().time, 2 * h + 0.002);
        EXPECT_LE(rest.speed, speeds.back_out + 1e-12);
      }
      EXPECT_GT(cuts, 100);
      // The approach: when the tip passes the toe, and how fast it is there.
      for (const Moment& at : run) {
        if (at.tip_x < 9.9) continue;
        const LeftOut way = approach(1.9, speeds);
        EXPECT_NEAR(way.time, at.time, 2 * h + way.speed * h / speeds.drive_in);
        EXPECT_NEAR(way.speed, at.drive, 2 * h * speeds.limits.drive_acceleration);
        break;
      }
    }
}

// A cycle that begins at the toe, with what was driven before, goes on as the whole one does: same stages, same places.
TEST(LeftOut, ACycleBegunAtTheToeEndsAboveA) {
  constexpr double h = 0.002;
  const Plan plan = plan_of(1.5, 1.0);
  const ExecutorOptions options{.speeds = lindmark2016_speeds()};
  const ArmGeometry arm;
  const LeftOut way = approach(1.9, options.speeds);
  Executor executor(plan, arm, options, {.distance = 1.9, .speed = way.speed});
  ArmPose pose = arm_pose(arm, {.x = plan.corners[0].x + 1.9});
  ActuatorRates actual{.drive = way.speed};
  double t = 0;
  for (; t < 60 && !executor.finished(); t += h) {
    actual = executor.step({.time = t, .tip = tip_pose(arm, pose), .actual = actual});
    pose.q_d += actual.drive * h;
    pose.a += actual.boom * h;
    pose.b += (actual.boom + actual.tilt) * h;
  }
  ASSERT_EQ(executor.results().size(), 4u);
  // Stage 4 ends within its tolerance, 2 % of a way of some 6 m.
  EXPECT_NEAR(tip_pose(arm, pose).x, plan.corners[0].x, 0.02 * 6 + 0.01);
  // Both runs end within that tolerance of A, where they back at the floor of the speeds, 5 % of 3.8 m/s: what their
  // ends lie apart, by steps of 2 ms at up to 1.5 m/s in each of four stages, takes at most 0.06 s there.
  EXPECT_NEAR(t + way.time, driven(plan, options, h).back().time, 4 * 1.5 * h / (0.05 * 3.8));
}
