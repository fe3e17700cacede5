// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/tests/support/card_house.hpp>

// What stands by friction alone stands for a minute. Five seconds after it was let go nothing may move by more than a
// micrometre in sixty: 1.7e-8 m/s. A substep may leave 1e-5 of the load unsolved, 6e-8 m/s of speed; only errors that
// come and go stay within the bound, a bias of a third of them would not. And the solver must see that all stands: a
// step costs one iteration then. No rolling or spinning resistance.
using namespace drawpoint;
using engine::World;
using support::PlacedBlock;

namespace {

constexpr double settling = 5, standing = 60, still = 1e-6;  // [s], [s], [m]

std::vector<Eigen::Vector3d> places(const World& world) {
  std::vector<Eigen::Vector3d> result;
  for (const engine::Rock& rock : world.rocks()) result.push_back(rock.pose.translation());
  return result;
}

double farthest(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  double most = 0;
  for (std::size_t k = 0; k < from.size(); ++k) most = std::max(most, (to[k] - from[k]).norm());
  return most;
}

// `settled`: how far the blocks may go while they take up their load [m].
void expect_to_stand(const std::vector<PlacedBlock>& blocks, double settled, double slope = 0) {
  engine::WorldOptions options;
  options.gravity = support::tilted_gravity(slope);
  World world(options, support::one_material({.friction = 0.8, .stiffness = 1e8}));
  support::add_floor(world);
  for (const PlacedBlock& block : blocks) world.add_rock(block.body, block.pose);
  const auto start = places(world);
  while (world.time() < settling) world.step();
  const auto before = places(world);
  EXPECT_LT(farthest(start, before), settled);
  int iterations = 0;
  while (world.time() < settling + standing) iterations = world.step().iterations;
  EXPECT_LT(farthest(before, places(world)), still);
  EXPECT_EQ(iterations, 1);
}

// With its lowest vertex on the floor.
PlacedBlock rock_on_floor(const engine::ConvexPolyhedron& shape) {
  PlacedBlock rock = support::placed(shape, 4500);
  double lowest = 0;
  for (const Eigen::Vector3d& p : std::get<engine::ConvexPolyhedron>(*rock.body.shape).vertices())
    lowest = std::min(lowest, (rock.pose.linear() * p).z());
  rock.pose.translation() = Eigen::Vector3d(0, 0, -lowest);
  return rock;
}

}  // namespace

// Contacts close by load over stiffness: under ten cubes of 67.5 kg 6.6e-5 m, all ten together 3.7e-4 m.
TEST(StandsForAMinute, TowerOfTen) {
  std::vector<PlacedBlock> tower;
  for (int k = 0; k < 10; ++k)
    tower.push_back({support::box_body(Eigen::Vector3d::Constant(0.15)), support::at(0, 0, 0.3 * (k + 0.5))});
  expect_to_stand(tower, 4e-4);
}

// Seven cards of 18 kg weigh 1.2 kN: no contact closes by more than 1.2e-5 m, and a storey sinks by at most as much
// over sin 20°, three times, where its feet, its edges and the card across them give way: 2 · 3 · 1.2e-5 / 0.34 m.
TEST(StandsForAMinute, HouseOfCards) { expect_to_stand(support::CardHouse{}.cards(), 2.1e-4); }

// Twice the limit of the thrust line would be 0.215 R; 0.13 R stands with joints that open and close by load over
// stiffness (masonry_arch_validation derives 0.006 m for them).
TEST(StandsForAMinute, Arch) { expect_to_stand(support::semicircular_arch(24, 2, 0.26, 0.6), 6e-3); }

// Friction angle 38.7°. The block sinks by its weight over the stiffness, 3.1e-5 m.
TEST(StandsForAMinute, BlockOnAnIncline) {
  for (const double degrees : {5.0, 15.0, 30.0, 37.0}) {
    SCOPED_TRACE(degrees);
    expect_to_stand({{support::box_body({0.4, 0.4, 0.1}), support::at(0, 0, 0.1)}}, 4e-5,
                    degrees * M_PI / 180);
  }
}

// On 10° each shape finds a face that bears it within its own length.
TEST(StandsForAMinute, RockOnAnIncline) {
  constexpr double length = 0.4;
  for (const auto& shape : engine::granular::rock_shapes()) {
    SCOPED_TRACE(&shape - engine::granular::rock_shapes().data());
    expect_to_stand({rock_on_floor(shape.scaled(length))}, length, 10 * M_PI / 180);
  }
}
