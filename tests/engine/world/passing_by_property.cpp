// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Bodies that never touch leave each other alone, however near, fast and shaped: no impulse, not a bit of velocity.
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>
#include <random>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;

namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vector3d direction(Random& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// 8 to 20 points on an ellipsoid, or a box.
engine::ConvexPolyhedron any_hull(Random& random) {
  const Vector3d half(between(random, 0.05, 0.4), between(random, 0.05, 0.4), between(random, 0.05, 0.4));
  if (random() % 2) return engine::box(half);
  std::vector<Vector3d> points;
  for (int k = 8 + static_cast<int>(random() % 13); k > 0; --k)
    points.push_back(direction(random).cwiseProduct(half));
  const auto hull = engine::ConvexPolyhedron::hull_of(points);
  Eigen::Isometry3d to_centre = Eigen::Isometry3d::Identity();
  to_centre.translation() = -engine::mass_properties(hull, 1).centre;
  return hull.transformed(to_centre);
}

engine::RockBody rock_of(const engine::ConvexPolyhedron& hull) {
  return {support::shared(hull), 100, Vector3d::Constant(4), 0};
}

Eigen::Isometry3d any_pose(Random& random) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(between(random, 0, M_PI), direction(random)));
}

// How far the hull reaches along the unit vector n.
double reach(const engine::ConvexPolyhedron& hull, const Eigen::Matrix3d& R, const Vector3d& n) {
  double most = -1e9;
  for (const Vector3d& p : hull.vertices()) most = std::max(most, n.dot(R * p));
  return most;
}

// Two hulls on the two sides of a plane, which one goes along without coming nearer to it than the clearance:
// they never touch.
struct Passing {
  explicit Passing(Random& random)
      : still(any_hull(random)),
        mover(any_hull(random)),
        X_still(any_pose(random)),
        X_mover(any_pose(random)),
        n(direction(random)) {
    clearance = std::exp(between(random, std::log(2e-5), std::log(0.03)));
    velocity =
        std::exp(between(random, std::log(0.2), std::log(20.0))) * n.cross(direction(random)).normalized();
    const double most = reach(still, X_still.linear(), n) + reach(mover, X_mover.linear(), -n) + clearance;
    X_mover.translation() = most * n - between(random, 0.3, 0.9) * velocity.normalized();
  }
  engine::ConvexPolyhedron still, mover;
  Eigen::Isometry3d X_still, X_mover;
  Vector3d n, velocity;
  double clearance;
};

World world_of(double step) {
  engine::WorldOptions options;
  options.gravity = Vector3d::Zero();
  options.step = step;
  return World(options, support::one_material({.friction = 0.5, .stiffness = 1e8}));
}

}  // namespace

class PassingBy : public testing::TestWithParam<double> {};  // step [s]

// By a fixed body, and by a rock with which it shares a velocity that is added to both. Without gravity a
// rock that nothing touches keeps its velocity bit by bit.
TEST_P(PassingBy, LeavesNoImpulse) {
  const double h = GetParam();
  Random random(11);
  for (int trial = 0; trial < 400; ++trial) {
    const Passing scene(random);
    World world = world_of(h);
    const Vector3d carried =
        trial % 2 ? Vector3d(between(random, 0, 3) * direction(random)) : Vector3d::Zero();
    if (trial % 2)
      world.add_rock(rock_of(scene.still), scene.X_still, carried);
    else
      world.add_static(support::shared(scene.still), scene.X_still, 0);
    const int rock = world.add_rock(rock_of(scene.mover), scene.X_mover, scene.velocity + carried);
    const int steps = static_cast<int>(2 / (h * scene.velocity.norm())) + 1;
    for (int k = 0; k < std::min(steps, 400); ++k) {
      world.step();
      for (const engine::ContactPoint& point : world.problem().points)
        ASSERT_EQ(point.impulse, Vector3d::Zero())
            << "trial " << trial << ", step " << k << ", clearance " << scene.clearance << " m, "
            << scene.velocity.norm() << " m/s";
    }
    ASSERT_EQ(world.rock(rock).velocity, Vector3d(scene.velocity + carried)) << "trial " << trial;
  }
}

// Spinning, each within the sphere that holds it, by up to 2 rad in a step.
TEST_P(PassingBy, WhileBothSpinLeavesNoImpulse) {
  const double h = GetParam(), spin = std::min(100.0, 2 / h);
  Random random(12);
  for (int trial = 0; trial < 500; ++trial) {
    Passing scene(random);
    World world = world_of(h);
    double radii = 0;
    for (const auto* hull : {&scene.still, &scene.mover}) {
      double most = 0;
      for (const Vector3d& p : hull->vertices()) most = std::max(most, p.norm());
      radii += most;
    }
    const Vector3d along =
        scene.X_mover.translation().dot(scene.velocity) * scene.velocity / scene.velocity.squaredNorm();
    scene.X_mover.translation() = along + (radii + scene.clearance) * scene.n;
    world.add_rock(rock_of(scene.still), scene.X_still, Vector3d::Zero(),
                   between(random, 0, spin) * direction(random));
    const int rock = world.add_rock(rock_of(scene.mover), scene.X_mover, scene.velocity,
                                    between(random, 0, spin) * direction(random));
    const int steps = static_cast<int>(2 / (h * scene.velocity.norm())) + 1;
    for (int k = 0; k < std::min(steps, 400); ++k) world.step();
    ASSERT_EQ(world.rock(rock).velocity, scene.velocity) << "trial " << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, PassingBy, testing::Values(0.001, 0.01, 0.03));

// A cube that falls 5 mm beside the edge of a box at 4.4 m/s goes on falling freely.
TEST(PassingBy, ACubeFallsBesideAnEdge) {
  for (const double start : {1.0, 1.003, 1.007, 1.011, 1.019}) {
    engine::WorldOptions options;
    World world(options, support::one_material({.friction = 0.5, .stiffness = 1e8}));
    world.add_static(support::shared(engine::box({0.5, 0.5, 0.5})), support::at(0, 0, -0.5), 0);
    const int cube =
        world.add_rock(support::box_body(Vector3d::Constant(0.2)), support::at(0.705, 0.1, start + 0.2));
    for (int k = 0; k < 100; ++k) world.step();
    EXPECT_NEAR(world.rock(cube).pose.translation().x(), 0.705, 1e-12);
    EXPECT_EQ(world.rock(cube).angular_velocity, Vector3d::Zero());
    EXPECT_NEAR(world.rock(cube).velocity.z(), -9.81, 1e-9);
  }
}

// What does touch is stopped, from any side and at any speed: the pass is not bought with holes. A hull is
// thrown at the middle of another and must not come out behind it.
TEST_P(PassingBy, WhatMeetsIsStopped) {
  const double h = GetParam();
  Random random(13);
  for (int trial = 0; trial < 200; ++trial) {
    const engine::ConvexPolyhedron wall = engine::box({1, 1, between(random, 0.05, 0.3)}),
                                   hull = any_hull(random);
    World world = world_of(h);
    world.add_static(support::shared(wall), Eigen::Isometry3d::Identity(), 0);
    Eigen::Isometry3d pose = any_pose(random);
    const double speed = between(random, 1, 20);
    Vector3d velocity(between(random, -0.5, 0.5), between(random, -0.5, 0.5), -1);
    velocity *= speed / velocity.norm();
    const Vector3d goal(between(random, -0.2, 0.2), between(random, -0.2, 0.2), 0);
    pose.translation() = goal - velocity * (1.5 / speed);
    const int rock =
        world.add_rock(rock_of(hull), pose, velocity, between(random, 0, 20) * direction(random));
    const int steps = static_cast<int>(3 / (h * speed)) + 1;
    for (int k = 0; k < steps; ++k) {
      world.step();
      const Vector3d p = world.rock(rock).pose.translation();
      ASSERT_TRUE(p.z() > 0 || p.head<2>().cwiseAbs().maxCoeff() > 1)
          << "trial " << trial << " at " << p.transpose();
    }
  }
}

// Nor is what rises past the underside of a ledge, against its weight, held back by more than the weight.
TEST(PassingBy, ARockRisesPastALedge) {
  for (const double start : {-0.700, -0.707, -0.714, -0.721}) {
    World world({}, support::one_material({.friction = 0.5, .stiffness = 1e8}));
    world.add_static(support::shared(engine::box({0.5, 0.5, 0.1})), support::at(0, 0, 0), 0);
    const int cube =
        world.add_rock(support::box_body(Vector3d::Constant(0.2)), support::at(0.705, 0.1, start), {0, 0, 4});
    for (int k = 0; k < 30; ++k) world.step();
    EXPECT_NEAR(world.rock(cube).velocity.z(), 4 - 9.81 * 0.3, 1e-9);
    EXPECT_EQ(world.rock(cube).angular_velocity, Vector3d::Zero());
  }
}
