// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/hydraulics.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <drawpoint/engine/loading/scenario.hpp>
#include <drawpoint/tests/support/yard.hpp>
#include <limits>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;
using drawpoint::support::Yard;
using Eigen::Vector3d;

namespace {

const Hydraulics circuit = lh621_hydraulics();
const LhdOptions machine_options = with_speeds(lh621_in_a_drift(), "machine").machine;

/// Sets the boom's rate with the tilt cylinder at rest, as a closed valve holds it.
void set_boom(Yard& yard, double rate) {
  const Lhd& lhd = yard.lhd;
  const Eigen::MatrixXd ratios =
      yard.machine.transmission({lhd.lift_rods[0], lhd.tilt_rod}, {lhd.boom, lhd.bucket},
                                {lhd.rear, lhd.wheels[0], lhd.wheels[1], lhd.wheels[2], lhd.wheels[3]});
  yard.driver.command({.boom = rate, .tilt = -rate * ratios(1, 0) / ratios(1, 1)});
}

/// Time from one coordinate of the first lift rod to another while the boom is set to a rate it cannot have
/// [s].
double stroke_time(Yard& yard, double boom_rate, double from, double to) {
  const auto steps_to = [&](double place) {
    int steps = 0;
    const auto left = [&] { return place - yard.machine.coordinate(yard.lhd.lift_rods[0]); };
    for (const double way = left(); left() * way > 0 && steps < 2000; ++steps) {
      set_boom(yard, boom_rate);
      yard.world.step();
    }
    return steps;
  };
  steps_to(from);
  return steps_to(to) * yard.world.options().step;
}

}  // namespace

// 28 MPa on π/4 (180 mm)² are 712.5 kN; on what a rod of 100 mm leaves of it 492.6 kN.
TEST(Hydraulics, ACylinderPushesWithItsPistonAndPullsWithTheRing) {
  EXPECT_NEAR(pushing_force(circuit.lift, 28e6), 712.513e3, 1);
  EXPECT_NEAR(pulling_force(circuit.lift, 28e6), 492.602e3, 1);
  EXPECT_EQ(pulling_force({.bore = 0.2}, 28e6), pushing_force({.bore = 0.2}, 28e6));
}

// At half of what the pump feeds nothing is slowed; at twice, all by half; what two cylinders ask together is
// shared.
TEST(Hydraulics, ThePumpSlowsAllCylindersAlike) {
  const double all = circuit.pump_flow / (2 * flow(circuit.lift, 1.0));  // both lift cylinders, out
  EXPECT_EQ(flow_share(circuit, 0.5 * all, 0), 1);
  EXPECT_DOUBLE_EQ(flow_share(circuit, 2 * all, 0), 0.5);
  const double tilt = circuit.pump_flow / flow(circuit.tilt, 1.0);
  EXPECT_DOUBLE_EQ(flow_share(circuit, all, tilt), 0.5);
  EXPECT_DOUBLE_EQ(flow_share(circuit, 0, tilt), 1);
  EXPECT_GT(flow_share(circuit, -all, -tilt), 0.5);  // going in takes less oil
  EXPECT_EQ(flow_share(circuit, 0, 0), 1);
  EXPECT_EQ(flow_share(Hydraulics{}, 10, 10), 1);
}

TEST(Hydraulics, RefusesWhatIsNoCircuit) {
  EXPECT_NO_THROW(check(circuit));
  EXPECT_NO_THROW(check(Hydraulics{}));
  EXPECT_THROW(check(Hydraulics{.pressure = std::numeric_limits<double>::infinity()}), std::invalid_argument);
  EXPECT_THROW(check(Hydraulics{.pump_flow = 0}), std::invalid_argument);
  EXPECT_THROW(check(Hydraulics{.pump_flow = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(check(Hydraulics{.lift = {.bore = 0}}), std::invalid_argument);
  EXPECT_THROW(check(Hydraulics{.tilt = {.bore = 0.2, .rod = 0.2}}), std::invalid_argument);
}

// A boom set to go faster than the pump can feed goes at the pump's speed, which its motor holds exactly: a
// metre of stroke with both cylinders takes 1 m · 2 A/Q, out with the piston's area, in with the ring's, and
// each count of steps begins and ends within a step. The rates at which the tilt cylinder stands are those of
// the pose before a step: it moves by what the ratios change in a step, 1e-3 of the lift's speed, and takes
// as little of the pump's flow, 2e-3 of the time. The whole stroke of 1.271 m is 8.0 s up and 5.5 s down.
TEST(Hydraulics, ThePumpGivesTheTimeOfTheLift) {
  Yard yard(machine_options);
  yard.stand(1);
  const double out = 2 * flow(circuit.lift, 1.0) / circuit.pump_flow;
  const double in = 2 * flow(circuit.lift, -1.0) / circuit.pump_flow;
  const double two_steps = 2 * yard.world.options().step;
  EXPECT_NEAR(stroke_time(yard, 1.0, 0.1, 1.1), out, two_steps + 2e-3 * out);
  EXPECT_NEAR(stroke_time(yard, -1.0, 1.1, 0.1), in, two_steps + 2e-3 * in);
  EXPECT_NEAR(1.271 * out, 8.0, 0.05);
  EXPECT_NEAR(1.271 * in, 5.5, 0.05);
}

// Lift and tilt set together beyond what the pump feeds: both come at the same share of what was set, from
// the same pose. The motors hold their speeds to round-off; the poses differ by nothing but what the tyres do
// in the step.
TEST(Hydraulics, ThePumpKeepsTheRatioOfLiftAndTilt) {
  Yard yard(machine_options), free_yard;
  for (Yard* each : {&yard, &free_yard}) {
    each->stand(1);
    each->driver.command({.boom = 0.2, .tilt = 0.4});
    each->world.step();
  }
  const LhdDriver &slowed = yard.driver, &set = free_yard.driver;
  const double share = flow_share(circuit, set.lift_speed(), set.tilt_speed());
  EXPECT_LT(share, 0.6);
  EXPECT_NEAR(slowed.lift_speed(), share * set.lift_speed(), 1e-3 * set.lift_speed());
  EXPECT_NEAR(slowed.tilt_speed(), share * set.tilt_speed(), 1e-3 * set.tilt_speed());
}

// Between boom and front unit, a force on the boom and its opposite on the front unit, so that the machine as
// a whole feels nothing: at 1.38 m from hinge F against the cylinders' 1.2 m, with the arm's weight, some 110
// kN at twice that.
// 1.2 MN up are 1.1 to 1.2 MN in the cylinders, more than the ring areas hold (0.99 MN): the valve holds those and the
// rods come out. 0.9 MN down are 1.2 to 1.3 MN, which the rings would not hold and the pistons (1.43 MN) do.
TEST(Hydraulics, WhatLiftsTheBoomMeetsTheRingAreaOnly) {
  for (const double push : {1.2e6, -0.9e6}) {
    Yard yard(machine_options);
    yard.stand(1);
    const Lhd& lhd = yard.lhd;
    const double before = yard.machine.coordinate(lhd.lift_rods[0]);
    for (int k = 0; k < 10; ++k) {
      yard.driver.command({});
      const Vector3d force(0, 0, push);
      const Vector3d lever =
          yard.machine.pose(lhd.boom).translation() - yard.machine.pose(lhd.front).translation();
      yard.machine.add_force(lhd.boom, {Vector3d::Zero(), force});
      yard.machine.add_force(lhd.front, {-lever.cross(force), -force});
      yard.world.step();
    }
    const double held = yard.driver.lift_force(), moved = yard.machine.coordinate(lhd.lift_rods[0]) - before;
    if (push > 0) {
      EXPECT_NEAR(held, -2 * pulling_force(circuit.lift, circuit.pressure), 1e-6 * push);
      EXPECT_GT(moved, 1e-3);
    } else {
      EXPECT_LT(held, 2 * pushing_force(circuit.lift, circuit.pressure));
      EXPECT_GT(held, 2 * pulling_force(circuit.lift, circuit.pressure));
      EXPECT_NEAR(moved, 0, 1e-6);
    }
  }
}
