// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/world/kinematic_body.hpp>
#include <drawpoint/tests/support/scenes.hpp>

using namespace drawpoint::engine;
using drawpoint::support::add_floor;
using drawpoint::support::at;
using drawpoint::support::box_body;
using drawpoint::support::one_material;
using drawpoint::support::shared;
using Eigen::Vector3d;

namespace {

constexpr double g = 9.81;
constexpr double budget = 1e-3;  // of a weight at rest: stack_analytic.cpp

// A tower of two cubes of 0.4 m on the floor, the fixed surface 0; 160 kg each.
World tower(const WorldOptions& options = {}) {
  World world(options, one_material({.friction = 0.5, .stiffness = 1e8}));
  add_floor(world);
  for (int k = 0; k < 2; ++k) world.add_rock(box_body({0.2, 0.2, 0.2}), at(0, 0, 0.2 + 0.4 * k));
  return world;
}

void run(World& world, double time) {
  while (world.time() < time) world.step();
}

// As rock_wrench() sums them.
Wrench sum_of_pairs(const World& world, int rock) {
  const SurfaceOwner owner{Owner::rock, rock};
  Wrench sum;
  for (const PairForce& pair : world.pair_forces()) {
    const double sign = (pair.b == owner ? 1 : 0) - (pair.a == owner ? 1 : 0);
    const Vector3d arm = pair.position - world.rock(rock).pose.translation();
    sum.force += sign * pair.force;
    sum.moment += sign * (pair.moment + arm.cross(pair.force));
  }
  return sum;
}

void expect_tower_at_rest(const World& world) {
  const double weight = g * world.rock(0).body.mass;
  const std::vector<PairForce> pairs = world.pair_forces();
  ASSERT_EQ(pairs.size(), 2u);
  for (const PairForce& pair : pairs) {
    const bool ground = pair.a.owner == Owner::fixed;
    const double load = (ground ? 2 : 1) * weight;
    EXPECT_EQ(pair.a, ground ? (SurfaceOwner{Owner::fixed, 0}) : (SurfaceOwner{Owner::rock, 0}));
    EXPECT_EQ(pair.b, (SurfaceOwner{Owner::rock, ground ? 0 : 1}));
    EXPECT_LT((pair.force - load * Vector3d::UnitZ()).norm(), 2 * budget * weight);
    // The load goes through the axis of the tower: force and moment about any point of it balance.
    EXPECT_NEAR(pair.position.z(), ground ? 0 : 0.4, 1e-4);
    const Vector3d about_axis =
        pair.moment + Vector3d(pair.position.x(), pair.position.y(), 0).cross(pair.force);
    EXPECT_LT(about_axis.norm(), 2 * budget * weight * 0.4);
  }
  for (int rock : {0, 1}) {
    const Wrench wrench = world.rock_wrench(rock);
    const Wrench sum = sum_of_pairs(world, rock);
    EXPECT_EQ(wrench.force, sum.force);
    EXPECT_EQ(wrench.moment, sum.moment);
    EXPECT_LT((wrench.force - weight * Vector3d::UnitZ()).norm(), 2 * budget * weight);
    EXPECT_LT(wrench.moment.norm(), 2 * budget * weight * 0.4);
  }
}

}  // namespace

TEST(PairForces, OfATowerAtRest) {
  World world = tower();
  EXPECT_TRUE(world.pair_forces().empty()) << "before the first step";
  run(world, 3);
  expect_tower_at_rest(world);
}

// On the part as the part itself feels it: the sum of the pairs' single-precision impulses is the solver's own sum but
// for round-off of 1e-6.
TEST(PartWrench, IsWhatTheBodyFeels) {
  World world({}, one_material({.friction = 0.5, .stiffness = 1e8}));
  KinematicBody plate(at(0.1, 0, -0.25));
  world.attach(&plate);
  world.add_part_shape(0, shared(box({1, 1, 0.25})), at(0, 0, 0), 0);
  world.add_rock(box_body({0.2, 0.2, 0.2}), at(0.3, 0.2, 0.2));
  run(world, 1);
  const Wrench pairs = world.part_wrench(0);
  const Wrench& felt = plate.contact_wrench();
  EXPECT_GT(felt.force.norm(), 1000);
  EXPECT_LT((pairs.force - felt.force).norm(), 1e-5 * felt.force.norm());
  EXPECT_LT((pairs.moment - felt.moment).norm(), 1e-5 * felt.force.norm());
  EXPECT_THROW(world.part_wrench(1), std::invalid_argument);
  EXPECT_THROW(world.rock_wrench(7), std::invalid_argument);
}

TEST(CastRay, FindsTheFirstSurface) {
  World world = tower();
  KinematicBody blade(at(0, 3, 1));
  world.attach(&blade);
  world.add_part_shape(0, shared(box({0.5, 0.1, 0.5})), at(0, 0, 0.5), 0);
  constexpr double round_off = 1e-14;
  const auto down = world.cast_ray({{0.05, 0.02, 5}, -Vector3d::UnitZ()});
  ASSERT_TRUE(down);
  EXPECT_EQ(down->surface, (SurfaceOwner{Owner::rock, 1}));
  EXPECT_NEAR(down->distance, 5 - 0.8, round_off);
  EXPECT_LT((down->position - Vector3d(0.05, 0.02, 0.8)).norm(), round_off);
  EXPECT_LT((down->normal - Vector3d::UnitZ()).norm(), round_off);
  EXPECT_EQ(world.cast_ray({{1, 0, 5}, -Vector3d::UnitZ()})->surface, (SurfaceOwner{Owner::fixed, 0}));
  const auto side = world.cast_ray({{0, 0.5, 1.5}, Vector3d::UnitY()});
  ASSERT_TRUE(side);
  EXPECT_EQ(side->surface, (SurfaceOwner{Owner::part, 0}));
  EXPECT_NEAR(side->distance, 3 - 0.1 - 0.5, round_off);
  EXPECT_FALSE(world.cast_ray({{0, 0, 5}, Vector3d::UnitZ()}));
  EXPECT_FALSE(world.cast_ray({{0.05, 0.02, 5}, -Vector3d::UnitZ()}, 4));
  world.remove_rock(1);
  EXPECT_EQ(world.cast_ray({{0.05, 0.02, 5}, -Vector3d::UnitZ()})->surface, (SurfaceOwner{Owner::rock, 0}));
  EXPECT_THROW(world.cast_ray({{0, 0, 5}, {0, 0, -2}}), std::invalid_argument);
}

// Free fall by steps of any length: a step from speed v goes h v - g h² / 2 and ends at v - g h; exact but for
// round-off.
TEST(StepOfALength, FallsByIt) {
  World world({}, one_material({.friction = 0.5}));
  world.add_rock(box_body({0.2, 0.2, 0.2}), at(0, 0, 0));
  double t = 0, z = 0;
  for (double h : {0.01, 0.0025, 0.03, 0.001, 0.0417}) {
    world.step(h);
    z -= h * g * t + g * h * h / 2;
    t += h;
    EXPECT_NEAR(world.time(), t, 1e-15);
    EXPECT_NEAR(world.rock(0).velocity.z(), -g * t, 1e-14);
    EXPECT_NEAR(world.rock(0).pose.translation().z(), z, 1e-14);
  }
}

// A load at rest is the same force in a step of any length, so its impulses scale with the step and nothing jumps.
TEST(StepOfALength, KeepsARestingLoad) {
  World world = tower();
  run(world, 3);
  for (double h : {0.0025, 0.004, 0.01}) {
    world.step(h);
    expect_tower_at_rest(world);
  }
  EXPECT_LT(world.fastest_rock(), 1e-3);
}

TEST(StepOfALength, IsRefusedOutsideItsRange) {
  World world = tower();
  for (double h : {0.0, -0.01, 0.2, std::nan("")}) EXPECT_THROW(world.step(h), std::invalid_argument);
  EXPECT_EQ(world.time(), 0);
}
