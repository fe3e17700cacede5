// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>

using namespace drawpoint;
using engine::contact::World;

// Five equal cubes at rest. Statics: the interface under m cubes carries m M g over k, so the exact overlap
// is m M g / k: at most 5 · 67.5 kg · g / k = 3.3e-6 m. The solver adds the error of unconverged sweeps, for
// N sweeps on a column of n at most about 3 n g h² / N in a cold start (1-D column study): n = 5, N = 100, h
// = 5 ms: 3.7e-5 m; warm starting stays below. Speeds that such an error can drive: overlap error over
// relaxation time, 3.7e-5 m / 2h = 4e-3 m/s at most; sideways the tower may creep by what the warm start
// forgets: the bound of 1 mm in 5 s is a hundredth of what would topple it.
TEST(Stack, RestsWithinTheOverlapBound) {
  constexpr int n = 5;
  constexpr double side = 0.3, bound = 3.7e-5 + 3.3e-6;
  engine::contact::WorldOptions options;
  options.solver.sweeps = 100;
  World world(options, support::one_material({0.8, 0.3, 1e9, 0}));
  support::add_floor(world);
  for (int k = 0; k < n; ++k)
    world.add_rock(support::box_body({side / 2, side / 2, side / 2}), support::at(0, 0, side * (k + 0.5)));
  double overlap = 0;
  for (int k = 0; k < 1000; ++k) {
    const auto report = world.step();
    if (k >= 500) overlap = std::max(overlap, report.max_overlap);
  }
  EXPECT_LT(overlap, bound);
  EXPECT_GT(overlap, 0);
  for (int k = 0; k < n; ++k) {
    const auto& rock = world.rocks()[k];
    EXPECT_NEAR(rock.pose.translation().z(), side * (k + 0.5), (k + 1) * bound);
    EXPECT_LT(rock.velocity.norm(), 4e-3);
    EXPECT_LT(rock.pose.translation().head<2>().norm(), 1e-3);
  }
}

// The weight arrives on the floor: at rest the vertical impulses of a step on the ground contacts add up to h
// n M g.
TEST(Stack, FloorCarriesTheWholeWeight) {
  constexpr double side = 0.4;
  World world({}, support::one_material({0.8, 0.3, 1e9, 0}));
  support::add_floor(world);
  for (int k = 0; k < 3; ++k)
    world.add_rock(support::box_body({side / 2, side / 2, side / 2}), support::at(0, 0, side * (k + 0.5)));
  for (int k = 0; k < 600; ++k) world.step();
  double carried = 0;
  for (const auto& pair : world.problem().pairs)
    for (int k = 0; k < pair.count && pair.a * pair.b == 0; ++k)
      carried += std::abs(world.problem().points[pair.first + k].impulse.z());
  const double weight = 3 * world.rocks()[0].body.mass * 9.81;
  EXPECT_NEAR(carried / world.options().step, weight, 1e-3 * weight);
}
