// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/granular/calibration/bulk_density.hpp>
#include <drawpoint/engine/granular/calibration/direct_shear.hpp>
#include <drawpoint/engine/granular/calibration/edge_penetration.hpp>
#include <drawpoint/engine/granular/calibration/repose.hpp>
#include <drawpoint/engine/granular/calibration/tilting_box.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

/// A test that is asked to stop in one of its phases makes no step more; `run` runs it with the options.
template <class Run>
void expect_stops_in(const std::vector<std::string>& phases, RunOptions& options, const Run& run) {
  for (const std::string& last : phases) {
    std::stop_source source;
    options.stop = source.get_token();
    int after = 0;
    options.progress = [&](std::string_view phase, double) {
      if (source.stop_requested()) ++after;
      if (phase == last) source.request_stop();
    };
    EXPECT_EQ(run(), RunStatus::stopped) << last;
    EXPECT_EQ(after, 0) << last;
  }
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

TEST(PouredHeap, RefusesARadiusWithoutEnd) {
  PouredHeapOptions o = small_heap(1);
  o.radius = std::numeric_limits<double>::infinity();
  EXPECT_THROW(poured_heap(stones(0.7), o), std::invalid_argument);
}

TEST(DrainedBank, RefusesWhatIsNoNumber) {
  DrainedBankOptions o;
  o.height = std::nan("");
  EXPECT_THROW(drained_bank(stones(0.7), o), std::invalid_argument);
  o = {};
  o.opening_speed = 0;
  EXPECT_THROW(drained_bank(stones(0.7), o), std::invalid_argument);
}

// Porosity and swell follow from the density exactly. Loose packs of angular blocks have a porosity of 0.35
// to 0.55, in the core and, by walls a few rocks apart, in all of the box.
TEST(BulkDensity, IsThatOfALoosePackAndConsistent) {
  BulkDensityOptions o;
  o.side = 4;
  o.height = 4;
  const BulkDensity b = bulk_density(stones(0.7), o);
  ASSERT_EQ(b.status, RunStatus::completed);
  EXPECT_NEAR(b.density, 4500 * (1 - b.porosity), 1e-9);
  EXPECT_NEAR(b.swell, b.porosity / (1 - b.porosity), 1e-12);
  EXPECT_GT(b.porosity, 0.35);
  EXPECT_LT(b.porosity, 0.55);
  EXPECT_GT(b.porosity_whole, 0.35);
  EXPECT_LT(b.porosity_whole, 0.55);
}

TEST(BulkDensity, StopsWhenAsked) {
  std::stop_source source;
  BulkDensityOptions o;
  o.stop = source.get_token();
  source.request_stop();
  EXPECT_EQ(bulk_density(stones(0.7), o).status, RunStatus::stopped);
}

TEST(BulkDensity, RefusesWhatIsNoNumber) {
  BulkDensityOptions o;
  o.height = std::nan("");
  EXPECT_THROW(bulk_density(stones(0.7), o), std::invalid_argument);
}

// Without gravity rocks stay where they are let go, in the middle of squares of 0.99 L: the lines where four
// squares meet, one of which is in the middle of the box, pass between them.
TEST(BulkDensity, RefusesABedWithAHoleInIt) {
  BulkDensityOptions o;
  o.side = 4;
  o.height = 3;
  o.world.gravity.setZero();
  try {
    bulk_density(stones(0.7), o);
    FAIL() << "took a bed with a hole";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "granular::bulk_density: the core's lowest place is 0.000000 m high; a core that begins at "
                 "0.300000 m takes more than 0.450000 m; fill the box higher than 3.000000 largest rocks");
  }
}

TEST(DirectShear, StopsWhenAsked) {
  ShearOptions o;
  o.box = {.length = 4, .width = 2, .height = 2};
  expect_stops_in({"pour", "settle", "shear"}, o, [&] { return direct_shear(stones(0.7), o).status; });
}

EdgeOptions small_bank() {
  EdgeOptions o;
  o.width = 3, o.height = 4;
  o.edge_width = 2;
  o.depth = 1;
  o.speed = 0.15;  // whole steps in every part
  o.parts = 4;
  return o;
}

// The mean force times the way is the work of the edge: over four parts of equal length, with the same steps
// in each.
TEST(EdgePenetration, WorkIsForceTimesWayOnAnyNumberOfThreads) {
  EdgeOptions o = small_bank();
  const EdgeResult one = edge_penetration(stones(0.7), o);
  ASSERT_EQ(one.status, RunStatus::completed);
  EXPECT_NEAR(one.work, 0.5 * (one.early_force + one.mean_force) * o.depth * 0.3, 1e-6 * one.work);
  EXPECT_EQ(one.line_force, one.mean_force / (2 * 0.3));
  EXPECT_GT(one.slope, 20);
  EXPECT_LT(one.slope, 60);
  o.world.threads = 2;
  EXPECT_EQ(edge_penetration(stones(0.7), o).work, one.work);
}

TEST(EdgePenetration, StopsWhenAsked) {
  EdgeOptions o = small_bank();
  expect_stops_in({"pour", "settle", "approach", "push"}, o,
                  [&] { return edge_penetration(stones(0.7), o).status; });
}

// Friction adds to what interlocking holds: three beds of the default size start at 29.5 ± 0.2° with a
// friction of 0.1 and at 42.9 ± 0.3° with 0.9 (standard errors).
TEST(TiltingBox, SlidesLaterWithMoreFriction) {
  constexpr int boxes = 2;
  TiltingBoxOptions o;
  o.length = 6;
  o.width = 3;
  o.rate = 4;
  double slippery = 0, gripping = 0;
  for (o.seed = 1; o.seed <= boxes; ++o.seed)
    for (const auto& [friction, mean] : {std::pair(0.1, &slippery), std::pair(0.9, &gripping)}) {
      const TiltResult result = tilting_box(stones(friction), o);
      ASSERT_EQ(result.status, RunStatus::completed) << friction << ", seed " << o.seed;
      *mean += result.start / boxes;
    }
  EXPECT_GT(slippery, std::atan(0.1) * 180 / M_PI);
  EXPECT_GT(gripping, slippery) << slippery;
}

TEST(TiltingBox, StopsWhenAsked) {
  TiltingBoxOptions o;
  o.length = o.width = 3, o.height = 4;
  expect_stops_in({"pour", "settle", "tilt"}, o, [&] { return tilting_box(stones(0.7), o).status; });
}

// Rock with little friction still interlocks, and friction adds to it. Six boxes of each (seeds 1 to 6) gave
// 38° and 61°, at half the speed 37° and 63°; single boxes scatter by 7° (standard deviation, pooled over
// these 24), so the difference of means over three by 7° √(2/3) = 5.7° about 23°. A change that draws other
// runs raises a false alarm with a chance of 8e-4 over the 5° that are asked of the difference (3.2 standard
// deviations), and of 1e-5 over the 20° that are asked of the smooth rock: those are far more than the 5.7°
// of its coefficient alone, and the mean over three, 38° ± 4°, is 4.4 standard deviations above.
TEST(DirectShear, StrengthRisesWithFriction) {
  constexpr int boxes = 3;
  ShearOptions o;
  o.box = {.length = 6, .width = 3, .height = 4};
  o.speed = 0.1;
  double smooth = 0, rough = 0;
  for (o.seed = 1; o.seed <= boxes; ++o.seed)
    for (const auto& [friction, mean] : {std::pair(0.1, &smooth), std::pair(0.9, &rough)}) {
      const ShearResult result = direct_shear(stones(friction), o);
      ASSERT_EQ(result.status, RunStatus::completed) << friction << ", seed " << o.seed;
      *mean += result.large / boxes;
    }
  EXPECT_GT(smooth, 20);
  EXPECT_GT(rough, smooth + 5);
}
