// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/granular/heap_surface.hpp>
#include <drawpoint/engine/granular/pile.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <limits>
#include <stdexcept>
#include <string>

using namespace drawpoint;
using namespace drawpoint::engine::granular;
using engine::World;
using support::at;

namespace {

World empty_world() { return World({}, support::one_material({.friction = 0.5})); }

// Heights of a cone of the given slope and height over a grid of places, as surface_heights() lays them.
std::vector<double> cone(double degrees, double height, double spacing) {
  const double slope = std::tan(degrees * M_PI / 180), reach = height / slope + spacing;
  std::vector<double> heights;
  for (double x = -reach + spacing / 2; x < reach; x += spacing)
    for (double y = -reach + spacing / 2; y < reach; y += spacing)
      heights.push_back(std::max(0.0, height - slope * std::hypot(x, y)));
  return heights;
}

template <class Act>
std::string refusal_of(const Act& act) {
  try {
    act();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

// Counting places gives the area of a disc of radius R to about the square root of the places that its edge
// crosses, √(8 R/s) s² (each is in or out by chance): an error in R of √(8 R/s) s²/(2 π R), at most 0.2 s for
// R ≥ 10 s, with s the spacing. A slope fitted to radii from 10 s to R_max = 39 s (or more, the lower the
// cone) over 24 levels or more is off by less than 2 · 0.2 s / (R_max − 10 s) = 1.4 %, which is 0.4° at 45°
// (dα = ½ sin 2α dR/R).
TEST(HeapSurface, AngleOfASyntheticConeIsExact) {
  for (const double degrees : {25.0, 38.0, 45.0})
    EXPECT_NEAR(angle_of_cone(cone(degrees, 1.5, 0.03), 0.03, 0.3), degrees, 0.4) << degrees;
}

// Columns as wide as the places are apart, s = 0.05 m: depths are whole multiples of s, so off by s/√12 by
// chance. Over n = 48 levels from 0.15 to 1.6 m the slope dx/dz of the least-squares line is off by
// (s/√12) √12/(√n · 1.5 m) = 0.5 %; three times that is 0.4° at 45° (dα = ½ sin 2α per relative error).
TEST(HeapSurface, AngleOfAStaircaseIsThatOfItsSlope) {
  for (const double degrees : {30.0, 45.0}) {
    World world = empty_world();
    const double slope = std::tan(degrees * M_PI / 180), crest = 2, length = crest / slope;
    for (double x = -length + place_spacing / 2; x < 0; x += place_spacing) {
      const double height = -slope * x;
      world.add_rock(support::box_body({place_spacing / 2, 0.5, height / 2}), at(x, 0, height / 2));
    }
    EXPECT_NEAR(angle_of_bank(world, {-length, 0, -0.5, 0.5}, 0.3, crest), degrees, 0.4);
  }
}

TEST(HeapSurface, AHeapWithoutFlanksHasNoAngle) {
  EXPECT_TRUE(std::isnan(angle_of_cone(std::vector<double>(100, 0.2), 0.05, 0.3)));
}

// The lines of a box that stands upright are cut exactly; spacing 0.05 divides its sides, so that no place is
// half in. What is left is round-off of some 1e-12 over 1e4 lines.
TEST(HeapSurface, SolidVolumeOfAnUprightBoxIsExact) {
  World world = empty_world();
  world.add_rock(support::box_body({0.5, 0.4, 0.3}), at(0, 0, 1));
  const Area area{-1, 1, -1, 1};
  EXPECT_NEAR(solid_volume(world, area, 0, 2), 0.48, 1e-9);
  EXPECT_NEAR(solid_volume(world, area, 0.9, 1.1), 0.16, 1e-9);
  EXPECT_NEAR(solid_volume(world, {0, 1, -1, 1}, 0, 1), 0.12, 1e-9);
  EXPECT_NEAR(mean_height(world, area), 1.3 * 0.8 / 4, 1e-9);
}

// Lines s = L/240 apart are a midpoint rule for the integral of the chord over the rock's outline, exact
// where the chord is linear. A convex outline, at most L each way, crosses at most 4 L/s squares of the grid.
// Where it does, a square is counted whole or not at all: off by up to half of it, by s² c/√12 in the mean
// square, with c the chord there. The worst rock is an upright prism, whose chord is V/A up to the outline,
// with the least area that its volume allows: A ≥ V/L ≥ 0.17 L², as no chord is longer than L. The squares'
// errors have either sign: √(4 L/s) s²/(√12 A) = 31/(240² · 3.46 · 0.17) = 9.1e-4 of V in the mean square.
// Edges within the outline bend the chord and do not break it: of the next order in s/L. 3.3 times that is
// allowed.
TEST(HeapSurface, SolidVolumeOfATurnedRockIsThatOfItsHull) {
  const double L = 0.6, spacing = L / 240;
  for (int shape = 0; shape < 6; ++shape) {
    World world = empty_world();
    Eigen::Isometry3d pose = at(0.013, -0.021, 1);
    pose.linear() = Eigen::AngleAxisd(0.7 + shape, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    world.add_rock(RockLibrary(4500).body({shape, L}), pose);
    const double unit = rock_shapes()[static_cast<std::size_t>(shape)].volume(), volume = unit * L * L * L;
    EXPECT_GE(unit, 0.17) << shape;
    const Area area{-L - 0.1, L + 0.1, -L - 0.1, L + 0.1};
    EXPECT_NEAR(solid_volume(world, area, 0, 2, spacing), volume, 3e-3 * volume) << shape;
  }
}

TEST(HeapSurface, AWorldWithoutRocksHasNoAngle) {
  EXPECT_TRUE(std::isnan(angle_of_cone(empty_world(), 0.3)));
}

TEST(HeapSurface, RefusesWhatHasNoPlaces) {
  const World world = empty_world();
  const Area area{-1, 1, -1, 1};
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const std::string spacing = "granular::heap_surface: spacing of places is 0.000000 m; give more than 0 m",
                    size = "granular::heap_surface: size of a rock is 0.000000 m; give more than 0 m";
  EXPECT_EQ(refusal_of([&] { surface_heights(world, area, 0); }), spacing);
  EXPECT_EQ(refusal_of([&] { mean_height(world, area, 0); }), spacing);
  EXPECT_EQ(refusal_of([&] { solid_volume(world, area, 0, 1, 0); }), spacing);
  EXPECT_EQ(refusal_of([&] { angle_of_cone(world, 0.3, 0); }), spacing);
  EXPECT_EQ(refusal_of([&] { angle_of_cone(std::vector<double>{1}, 0, 0.3); }), spacing);
  EXPECT_EQ(refusal_of([&] { angle_of_bank(world, area, 0.3, 1, 0); }), spacing);
  EXPECT_EQ(refusal_of([&] { angle_of_cone(world, 0); }), size);
  EXPECT_EQ(refusal_of([&] { angle_of_cone(std::vector<double>{1}, 0.05, 0); }), size);
  EXPECT_EQ(refusal_of([&] { angle_of_bank(world, area, 0, 1); }), size);
  for (const double wrong : {-0.1, nan, infinite}) {
    EXPECT_THROW(surface_heights(world, area, wrong), std::invalid_argument) << wrong;
    EXPECT_THROW(angle_of_cone(world, wrong), std::invalid_argument) << wrong;
  }
  EXPECT_EQ(refusal_of([&] { angle_of_bank(world, area, 0.3, infinite); }),
            "granular::heap_surface: crest is inf m; give a finite height");
  EXPECT_EQ(refusal_of([&] {
              mean_height(world, {1, 1, -1, 1});
            }),
            "granular::heap_surface: area from x = 1.000000 to 1.000000, y = -1.000000 to 1.000000 m has no "
            "place at "
            "a spacing of 0.050000 m; give finite sides of more than half the spacing");
  for (const Area& wrong :
       {Area{1, -1, -1, 1}, Area{0, 0.02, 0, 1}, Area{0, infinite, 0, 1}, Area{nan, 1, 0, 1}})
    EXPECT_THROW(surface_heights(world, wrong), std::invalid_argument) << wrong.x0 << " to " << wrong.x1;
}
