// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/tests/support/scenes.hpp>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;

namespace {

constexpr double h = 0.005, g = 9.81;

// A flat block (0.8 x 0.8 x 0.2 m, so that it cannot tip below 76 deg) on a slope, laid down at its rest
// overlap.
World block_on_slope(double angle, double friction) {
  engine::WorldOptions options;
  options.gravity = support::tilted_gravity(angle);
  options.step = h;
  World world(options, support::one_material({friction, 0.0, 1e8, 0}));
  support::add_floor(world);
  world.add_rock(support::box_body({0.4, 0.4, 0.1}), support::at(0, 0, 0.1));
  return world;
}

}  // namespace

// Below the friction angle the block sticks: after the contact has taken up its load (a few steps) it must
// not move. What is left is the solver's error: each substep it leaves at most a share of 1e-5 of the load
// unsolved, Δv = 1e-5 g h/S = 3e-8 m/s, and single precision 6e-8 of a substep's g h/S; the test allows 1e-5
// m in two seconds.
TEST(BlockOnIncline, SticksBelowTheFrictionAngle) {
  const double mu = 0.6;  // friction angle 30.96 deg
  for (double degrees : {5.0, 15.0, 25.0, 30.5}) {
    World world = block_on_slope(degrees * M_PI / 180, mu);
    for (int k = 0; k < 100; ++k) world.step();
    const double x = world.rocks()[0].pose.translation().x();
    for (int k = 0; k < 400; ++k) world.step();
    EXPECT_LT(std::abs(world.rocks()[0].pose.translation().x() - x), 1e-5) << degrees << " deg";
    EXPECT_LT(world.rocks()[0].velocity.norm(), 1e-5) << degrees << " deg";
  }
}

// Above it slides with a = g (sin α − μ cos α). The stepper is first order: after n steps v = n h a exactly
// for a constant force, so the error is that of the normal force while the contact settles. The block starts
// at zero overlap; in a time of about 2τ = 4h it loses up to μ g cos α per step: |Δv| ≤ 4 h μ g = 0.12 m/s is
// too crude a bound to test with, so the acceleration is measured after 0.25 s, when the normal force is
// steady: then only the solver's error remains (< 1e-4).
TEST(BlockOnIncline, SlidesWithTheExactAccelerationAboveIt) {
  const double mu = 0.6;
  for (double degrees : {32.0, 40.0, 55.0}) {
    const double angle = degrees * M_PI / 180;
    World world = block_on_slope(angle, mu);
    for (int k = 0; k < 50; ++k) world.step();
    const double v = world.rocks()[0].velocity.x();
    for (int k = 0; k < 100; ++k) world.step();
    const double a = (world.rocks()[0].velocity.x() - v) / (100 * h);
    EXPECT_NEAR(a, g * (std::sin(angle) - mu * std::cos(angle)), 1e-4 * g) << degrees << " deg";
  }
}

// The cone is circular: a block thrown in any direction on a level floor stops after v²/(2 μ g) on a straight
// line. Distance error: one step's travel from the O(h) integration, v h = 0.01 m, of which the semi-implicit
// rule takes half: bound v h.
TEST(BlockOnFloor, StopsAtTheSameDistanceInEveryDirection) {
  const double mu = 0.5, v = 2.0, exact = v * v / (2 * mu * g);
  for (int k = 0; k < 16; ++k) {
    const double phi = 2 * M_PI * k / 16 + 0.1;
    World world = block_on_slope(0, mu);
    for (int s = 0; s < 60; ++s) world.step();
    const Vector3d start = world.rocks()[0].pose.translation();
    world.set_rock_velocity(0, v * Vector3d(std::cos(phi), std::sin(phi), 0), Vector3d::Zero());
    for (int s = 0; s < 200; ++s) world.step();
    const Vector3d path = world.rocks()[0].pose.translation() - start;
    EXPECT_NEAR(path.head<2>().norm(), exact, v * h);
    EXPECT_NEAR(std::atan2(path.y(), path.x()), std::remainder(phi, 2 * M_PI), 0.01);
  }
}
