// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/granular/heap_surface.hpp>
#include <drawpoint/engine/granular/pile.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/tests/support/scenes.hpp>

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

// Of a tilted rock of volume V whose outline has a length of at most 4 L, the places along the outline, 4 L/s of
// them, have chords of at most s tan(steepness) there, so s L/2 in the mean of both signs: an error of less than
// √(4 L/s) · s² · L/2 = 1.2e-5 m³ L³ for s = L/60, against V ≥ 0.18 L³: 5e-4 of it is asked.
TEST(HeapSurface, SolidVolumeOfATurnedRockIsThatOfItsHull) {
  const double L = 0.6, spacing = L / 60;
  for (int shape = 0; shape < 6; ++shape) {
    World world = empty_world();
    Eigen::Isometry3d pose = at(0.013, -0.021, 1);
    pose.linear() = Eigen::AngleAxisd(0.7 + shape, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    world.add_rock(RockLibrary(4500).body({shape, L}), pose);
    const double volume = rock_shapes()[static_cast<std::size_t>(shape)].volume() * L * L * L;
    EXPECT_NEAR(solid_volume(world, {-1, 1, -1, 1}, 0, 2, spacing), volume, 5e-4 * volume) << shape;
  }
}
