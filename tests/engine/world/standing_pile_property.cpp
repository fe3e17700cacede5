// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/pile_world.hpp>

// A box is filled with rocks that nothing but friction holds: no rolling or spinning resistance. Five seconds after
// they were let go the pile must stand: the centres drift by less than 0.1 mm/s in the mean, and no more than one in a
// hundred by more than 1 mm/s. (A pile whose contacts jump between the ends of what carries a rock drifts by some 2
// mm/s.)
using namespace drawpoint;

TEST(StandingPile, HoldsStillWithoutRollingResistance) {
  support::PileMaterial material;
  material.rolling = 0;
  support::PileWorld world(support::rock_pile(1200, 1, material), {});
  const double h = world.world().options().step;
  const auto steps = [&](double seconds) {
    for (int k = 0; k < std::lround(seconds / h); ++k) world.world().step();
    return world.states();
  };
  const auto before = steps(5), after = steps(2);
  const support::Drift drift = support::drift(before, after, 2);
  EXPECT_LT(drift.mean, 1e-4);
  EXPECT_LT(drift.p99, 1e-3);
  std::printf("drift: mean %.2g, 99 of 100 below %.2g mm/s\n", 1e3 * drift.mean, 1e3 * drift.p99);
}
