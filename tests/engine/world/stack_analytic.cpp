// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>

using namespace drawpoint;
using engine::World;

// Ten equal cubes at rest. Statics: the interface under m cubes carries m M g over k, so the mean overlap is
// m M g / k: at most 10 · 67.5 kg · g / k = 6.6e-6 m. While the tower rocks, its corners share the load
// unequally: up to two of four carry all of it, and twice that is the deepest. The solver adds the error of
// unconverged iterations, for N iterations per substep on a column of n at most about 3 n g (h/S)² / N (1-D
// column study): n = 10, h/S = 0.625 ms, at least N = 100 of the 500 budgeted iterations: 1.2e-6 m. Speeds
// that such overlaps can drive: overlap over the relaxation time of two steps, 1.4e-5 m / 20 ms = 7e-4 m/s;
// sideways the tower may creep by 0.3 mm in 5 s, a five-hundredth of what would topple it.
TEST(Stack, RestsWithinTheOverlapBound) {
  constexpr int n = 10;
  constexpr double side = 0.3, bound = 2 * 6.6e-6 + 1.2e-6;
  World world({}, support::one_material({0.8, 0.3, 1e9, 0}));
  support::add_floor(world);
  for (int k = 0; k < n; ++k)
    world.add_rock(support::box_body({side / 2, side / 2, side / 2}), support::at(0, 0, side * (k + 0.5)));
  double overlap = 0;
  for (int k = 0; k < 500; ++k) {
    const auto report = world.step();
    if (k >= 250) overlap = std::max(overlap, report.max_overlap);
  }
  EXPECT_LT(overlap, bound);
  EXPECT_GT(overlap, 0);
  for (int k = 0; k < n; ++k) {
    const auto& rock = world.rocks()[k];
    EXPECT_NEAR(rock.pose.translation().z(), side * (k + 0.5), (k + 1) * bound);
    EXPECT_LT(rock.velocity.norm(), bound / 0.02);
    EXPECT_LT(rock.pose.translation().head<2>().norm(), 3e-4);
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
