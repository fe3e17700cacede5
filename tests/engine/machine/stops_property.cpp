// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// No joint goes past an end of its stroke, from wherever it starts, however fast, in either direction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/tests/support/machines.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <limits>
#include <random>

using namespace drawpoint;
using Eigen::Vector3d;

namespace {

engine::machine::MachineSpec sliding_block(double lower, double upper) {
  return {{support::slider("block", 10, 1)}, {}, {}, {{"stroke", {0}, lower, upper}}};
}

}  // namespace

// A stop lets the joint come to its end and no farther, so the coordinate after any step is at most round-off past it
// (single precision of the way of a step: 1e-7 of 10 m).
TEST(Stop, EndsAStrokeWhicheverEndIsNearer) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> unit(0, 1), power(-3, 3);
  for (int trial = 0; trial < 300; ++trial) {
    const double lower = -unit(rng), upper = lower + 0.01 + unit(rng);
    const double start = lower + unit(rng) * (upper - lower);
    const double speed = (trial % 2 ? 1 : -1) * std::min(999.0, std::pow(10.0, power(rng)));
    engine::machine::Machine machine(sliding_block(lower, upper));
    machine.set_coordinate(0, start);
    machine.set_velocity(Vector3d::Zero(), {{0, speed}});
    engine::WorldOptions options;
    options.gravity = Vector3d::Zero();
    engine::World world(options, engine::MaterialTable(1));
    world.attach(&machine);
    for (int step = 0; step < 20; ++step) {
      world.step(0.001 * (1 + trial % 20));
      ASSERT_LT(machine.coordinate(0), upper + 1e-6) << "from " << start << " at " << speed << " m/s";
      ASSERT_GT(machine.coordinate(0), lower - 1e-6) << "from " << start << " at " << speed << " m/s";
    }
    const double free_way = start + speed * 20 * 0.001 * (1 + trial % 20);
    ASSERT_NEAR(machine.coordinate(0), std::clamp(free_way, lower, upper), 1e-6);
  }
}

// A stroke with one end, the other at infinity.
TEST(Stop, MayHaveOneEnd) {
  engine::machine::Machine machine(sliding_block(-std::numeric_limits<double>::infinity(), 0.5));
  machine.set_velocity(Vector3d::Zero(), {{0, 3.0}});
  engine::WorldOptions options;
  options.gravity = Vector3d::Zero();
  engine::World world(options, engine::MaterialTable(1));
  world.attach(&machine);
  for (int step = 0; step < 100; ++step) world.step();
  EXPECT_NEAR(machine.coordinate(0), 0.5, 1e-6);
  machine.set_velocity(Vector3d::Zero(), {{0, -3.0}});
  for (int step = 0; step < 100; ++step) world.step();
  EXPECT_NEAR(machine.coordinate(0), 0.5 - 3.0, 1e-6);
}
