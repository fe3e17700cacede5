// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/granular/calibration/bulk_density.hpp>
#include <drawpoint/engine/granular/calibration/direct_shear.hpp>
#include <drawpoint/engine/granular/calibration/repose.hpp>

using namespace drawpoint;
using namespace drawpoint::engine::granular;

namespace {

RockSample stones(double friction) {
  RockSample sample;
  sample.contact = {.friction = friction};
  sample.sizes = single_size(0.3);
  return sample;
}

PouredHeapOptions small_heap(int threads) {
  PouredHeapOptions o;
  o.rocks = 60;
  o.world.threads = threads;
  return o;
}

}  // namespace

TEST(RockSample, MeansOfSizesAndMasses) {
  EXPECT_EQ(largest(blasted_ore), 0.8);
  EXPECT_NEAR(mean_length(blasted_ore), 0.2 * 0.3 + 0.3 * 0.4 + 0.3 * 0.6 + 0.2 * 0.8, 1e-15);
  EXPECT_NEAR(mean_mass(stones(0.5)), 4500 * 0.21 * 0.027, 0.03 * 4500 * 0.21 * 0.027);  // 0.21: rounded
}

TEST(PouredHeap, SameSeedSameHeapOnAnyNumberOfThreads) {
  const PouredHeap one = poured_heap(stones(0.7), small_heap(1)),
                   two = poured_heap(stones(0.7), small_heap(2));
  EXPECT_EQ(one.angle, two.angle);
  EXPECT_EQ(one.height, two.height);
  EXPECT_EQ(one.status, RunStatus::completed);
}

TEST(PouredHeap, StopsWhenAsked) {
  std::stop_source source;
  PouredHeapOptions o = small_heap(1);
  o.stop = source.get_token();
  int steps = 0;
  o.progress = [&](std::string_view, double) {
    if (++steps == 10) source.request_stop();
  };
  EXPECT_EQ(poured_heap(stones(0.7), o).status, RunStatus::stopped);
  EXPECT_EQ(steps, 10);
}

// Porosity and swell follow from the density exactly. Loose packs of angular blocks have a porosity of 0.35 to
// 0.55, in the core and, by walls a few rocks apart, in all of the box.
TEST(BulkDensity, IsThatOfALoosePackAndConsistent) {
  BulkDensityOptions o;
  o.side = 4;
  o.height = 4;
  const BulkDensity b = bulk_density(stones(0.7), o);
  EXPECT_NEAR(b.density, 4500 * (1 - b.porosity), 1e-9);
  EXPECT_NEAR(b.swell, b.porosity / (1 - b.porosity), 1e-12);
  EXPECT_GT(b.porosity, 0.35);
  EXPECT_LT(b.porosity, 0.55);
  EXPECT_GT(b.porosity_whole, 0.35);
  EXPECT_LT(b.porosity_whole, 0.55);
}

// Rock without friction still interlocks, and friction adds to it.
TEST(DirectShear, StrengthRisesWithFriction) {
  ShearOptions o;
  o.box = {.length = 6, .width = 3, .height = 4};
  const ShearResult smooth = direct_shear(stones(0.1), o), rough = direct_shear(stones(0.9), o);
  EXPECT_EQ(rough.status, RunStatus::completed);
  EXPECT_GT(smooth.large, 5);
  EXPECT_GT(rough.large, smooth.large + 10);
}
