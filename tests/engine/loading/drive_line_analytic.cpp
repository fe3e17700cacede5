// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/drift.hpp>
#include <drawpoint/engine/loading/drive_line.hpp>
#include <drawpoint/engine/loading/lhd_driver.hpp>
#include <drawpoint/engine/loading/scenario.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <limits>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;
using Eigen::Vector3d;

namespace {

const Scenario scenario = with_speeds(lh621_in_a_drift(), "machine");
const DriveLine line = scenario.machine.drive_line;
constexpr double near_stall = 80e3;

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
// wheels, so v² = v₀² + 2 P (t − t₀)/m with the mass m of the machine and of its wheels' turning, I/r² each
// (I = ½ 1800 kg (1.01 m)², r the way per turn).
//
// Error budget. The limit is that of the speed before a step of h, so a step does up to a h/v more work than P h,
// a = P/(m v): over a run P h ln(v/v₀) [J]. The thrust of 330 kN, 0.95 m above the floor, moves 64 kN of weight
// to the rear axle, 4.9 m away: 0.5 kJ in each pair of tyres of 4 MN/m; applied at once it swings to four times that,
// and all 4 kJ are lost by the end of the first second.
TEST(DriveLine, AcceleratesTheMachineWithItsPower) {
  const Lhd lhd = sandvik_lh621(scenario.machine);
  machine::Machine machine(lhd.spec);
  World world({}, material_table(calibrated_materials()));
  LhdDriver driver(lhd, machine);
  world.add_static(std::make_shared<const Shape>(HalfSpace{Vector3d::UnitZ(), 0}),
                   Eigen::Isometry3d::Identity(), static_cast<int>(SurfaceKind::terrain));
  driver.place(0, 0);
  add_machine(world, lhd, machine);
  for (int k = 0; k < 100; ++k) world.step();

  const double power = line.wheel_efficiency * line.engine_power;
  const double radius = 0.5 * (lhd.tyre_radius + machine.pose(lhd.wheels[0]).translation().z());
  const double mass = 56.8e3 + 4 * 0.5 * 1800 * lhd.tyre_radius * lhd.tyre_radius / (radius * radius);
  const double thrust = 4 * lhd.options.wheel_torque / radius;
  const double knee = power / thrust, knee_time = knee * mass / thrust;
  const auto turning = [&] {
    double sum = 0;
    for (int wheel : lhd.wheels) sum += std::abs(machine.speed(wheel));
    return sum;
  };
  for (int k = 1; k <= 200; ++k) {
    const double before = turning();
    driver.command({.drive = 4.4});
    world.step();
    const double h = world.options().step, t = k * h, v = driver.read().actual.drive;
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
