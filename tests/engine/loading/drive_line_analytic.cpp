// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/drive_line.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <drawpoint/engine/loading/scenario.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/tests/support/yard.hpp>
#include <limits>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;
using drawpoint::support::Yard;
using Eigen::Vector3d;

namespace {

const Scenario scenario = with_speeds(lh621_in_a_drift(), "machine");
const DriveLine line = scenario.machine.drive_line;
constexpr double near_stall = 80e3;

constexpr double until_still = 6;  // its bounce dies down [s]

double rolling_radius(const Yard& yard) {
  return 0.5 * (yard.lhd.tyre_radius + yard.machine.pose(yard.lhd.wheels[0]).translation().z());
}

// With what its wheels' turning adds, I/r² each, I = ½ 1800 kg (1.01 m)².
double rolling_mass(const Yard& yard) {
  return 56.8e3 + 4 * 0.5 * 1800 * std::pow(yard.lhd.tyre_radius / rolling_radius(yard), 2);
}

}  // namespace

// 382 kW at 0.73 are 279 kW at the wheels: at 4 rad/s of four wheels 17.4 kN m each. Cylinders that do 85 kW
// take 100 kW of the engine.
TEST(DriveLine, LeavesTheWheelsWhatTheArmDoesNotTake) {
  EXPECT_DOUBLE_EQ(wheel_torque_limit(line, near_stall, 16, 0), 0.73 * 382e3 / 16);
  EXPECT_DOUBLE_EQ(wheel_torque_limit(line, near_stall, 16, 85e3), 0.73 * 282e3 / 16);
  EXPECT_DOUBLE_EQ(wheel_torque_limit(line, near_stall, 16, -85e3), 0.73 * 382e3 / 16);  // a load that sinks
  EXPECT_EQ(wheel_torque_limit(line, near_stall, 1, 0), near_stall);
  EXPECT_EQ(wheel_torque_limit(line, near_stall, 0, 0), near_stall);
  EXPECT_DOUBLE_EQ(wheel_torque_limit(line, near_stall, 16, 1e6), 1e-3 * near_stall);
  EXPECT_EQ(wheel_torque_limit(DriveLine{}, near_stall, 100, 1e9), near_stall);
}

TEST(DriveLine, RefusesWhatIsNoEngine) {
  EXPECT_NO_THROW(check(line));
  EXPECT_NO_THROW(check(DriveLine{}));
  EXPECT_THROW(check(DriveLine{.engine_power = 0}), std::invalid_argument);
  EXPECT_THROW(check(DriveLine{.engine_power = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(check(DriveLine{.wheel_efficiency = 1.01}), std::invalid_argument);
  EXPECT_THROW(check(DriveLine{.pump_efficiency = 0}), std::invalid_argument);
}

// From rest with all the engine has, the arm still: thrust F₀ up to v₀ = P/F₀, then constant power P at the
// wheels, so v² = v₀² + 2 P (t − t₀)/m with the mass m of the machine and of its wheels' turning.
//
// Error budget. The limit is that of the speed before a step of h, so a step does up to a h/v more work than P h,
// a = P/(m v): over a run P h ln(v/v₀) [J]. The thrust of 330 kN, 0.95 m above the floor, moves 64 kN of weight
// to the rear axle, 4.9 m away: 0.5 kJ in each pair of tyres of 4 MN/m; applied at once it swings to four times that,
// and all 4 kJ are lost by the end of the first second.
// The front tyres, which the rear takes load from, must not spin: 174 kN of thrust on 181 kN of load.
TEST(DriveLine, AcceleratesTheMachineWithItsPower) {
  MineMaterials dry = calibrated_materials();
  dry.tyre_terrain.friction = 1;
  Yard yard(scenario.machine, {}, dry);
  yard.stand(until_still);
  const Lhd& lhd = yard.lhd;
  machine::Machine& machine = yard.machine;
  World& world = yard.world;

  const double power = line.wheel_efficiency * line.engine_power;
  const double radius = rolling_radius(yard), mass = rolling_mass(yard);
  const double thrust = 4 * lhd.options.wheel_torque / radius;
  const double knee = power / thrust, knee_time = knee * mass / thrust;
  const auto turning = [&] {
    double sum = 0;
    for (int wheel : lhd.wheels) sum += std::abs(machine.speed(wheel));
    return sum;
  };
  for (int k = 1; k <= 200; ++k) {
    const double before = turning();
    yard.driver.command({.drive = 4.4});
    world.step();
    const double h = world.options().step, t = k * h, v = yard.driver.read().actual.drive;
    double work_rate = 0;
    for (int w = 0; w < 4; ++w)
      work_rate += machine.motor_force(lhd.wheel_motors[w]) * machine.speed(lhd.wheels[w]);
    EXPECT_LE(work_rate, 1.000001 * power * turning() / before) << t;
    if (t < 1) continue;
    const double exact = std::sqrt(knee * knee + 2 * power * (t - knee_time) / mass);
    EXPECT_NEAR(0.5 * mass * v * v, 0.5 * mass * exact * exact, 4e3 + power * h * std::log(v / knee)) << t;
    EXPECT_GE(work_rate, 0.99 * power) << t;
  }
}

// A push F on the front unit at the height of the axles for half a second: F t/m, less what pitching and the tyres
// take: F at 0.95 m shifts 10 kN over the wheelbase, 2.4 mm in each pair of tyres of 4 MN/m, and while the machine
// pitches by that, 1 mrad in some 0.3 s, the axle, 0.2 m below the centre, lags by 1 mm/s; 4 mm/s with the swing, 1 %.
// Held, it moves by what tyres of 2 MN/m give at most, 25 mm, once.
TEST(DriveLine, WheelsRollWhenTheDriveIsReleased) {
  const double push = 50e3, h = WorldOptions().step;
  for (const double share : {0.0, 1.0}) {
    Yard yard(scenario.machine);
    yard.stand(until_still);
    const double start = yard.driver.read().front_axle.x();
    for (int k = 0; k < 50; ++k) {
      yard.driver.command({}, share);
      yard.machine.add_force(yard.lhd.front, {Vector3d::Zero(), Vector3d(-push, 0, 0)});
      yard.world.step();
    }
    const MachineReading after = yard.driver.read();
    if (share == 0)
      EXPECT_NEAR(after.actual.drive, -push * 50 * h / rolling_mass(yard), 4e-3);
    else
      EXPECT_NEAR(after.front_axle.x(), start, 0.025);
  }
}
