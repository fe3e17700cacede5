// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/geometry/mass_properties.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <functional>
#include <string>

using namespace drawpoint::engine;
using drawpoint::support::add_floor;
using drawpoint::support::at;
using drawpoint::support::expect_told;
using drawpoint::support::one_material;
using drawpoint::support::shared;
using Eigen::Vector3d;

namespace {

std::vector<Vector3d> moved(const ConvexPolyhedron& hull, const Eigen::Isometry3d& pose) {
  std::vector<Vector3d> points;
  for (const Vector3d& p : hull.vertices()) points.push_back(pose * p);
  return points;
}

}  // namespace

// A brick of sides 1, 2, 3 somewhere in space: mass ρ abc, moments m (b² + c²)/12 and so on by rising size. Round-off:
// some hundred operations on numbers of size 10.
TEST(RockBody, FromTheHullOfABrick) {
  Eigen::Isometry3d pose = at(7, -3, 2);
  pose.rotate(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  const auto points = moved(box({0.5, 1, 1.5}), pose);
  const RockBody body = RockBody::from_hull(points, 2000, 4);
  EXPECT_NEAR(body.mass, 12000, 12000 * 1e-13);
  EXPECT_LT((body.inertia - Vector3d(5000, 10000, 13000)).norm(), 13000 * 1e-12);
  EXPECT_EQ(body.material, 4);
  const MassProperties inside = mass_properties(std::get<ConvexPolyhedron>(*body.shape), 2000);
  EXPECT_LT(inside.centre.norm(), 1e-12);
  EXPECT_LT((inside.inertia - Eigen::Matrix3d(body.inertia.asDiagonal())).norm(), 13000 * 1e-12);
}

// A cube has any axes as principal ones: it keeps those that it was given.
TEST(RockBody, AxesThatArePrincipalAreKept) {
  const PlacedHull cube = place_hull(moved(box({0.2, 0.2, 0.2}), at(1, 2, 3)), 2700);
  EXPECT_EQ(cube.X_PB.linear(), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_LT((cube.X_PB.translation() - Vector3d(1, 2, 3)).norm(), 1e-14);
}

// Each corner of the placed body is one of the points.
TEST(RockBody, PlacedWhereItsPointsAre) {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 0.8, 0}, {0, 0, 0.6}, {0.5, 0.5, 0.5}};
  const PlacedHull placed = place_hull(points, 2700);
  const auto& hull = std::get<ConvexPolyhedron>(*placed.body.shape);
  ASSERT_EQ(hull.vertices().size(), points.size());
  for (const Vector3d& corner : hull.vertices()) {
    double nearest = 1;
    for (const Vector3d& p : points) nearest = std::min(nearest, (placed.X_PB * corner - p).norm());
    EXPECT_LT(nearest, 1e-14);
  }
  EXPECT_NEAR(placed.X_PB.linear().determinant(), 1, 1e-14);
}

TEST(RockBody, OffItsCentreIsRefused) {
  World world({}, one_material({.friction = 0.5}));
  const auto points = moved(box({0.2, 0.2, 0.2}), at(0.01, 0, 0));
  RockBody body = RockBody::from_hull(points, 2000);
  body.shape = shared(ConvexPolyhedron::hull_of(points));
  expect_told([&] { world.add_rock(body, at(0, 0, 1)); },
              {"World::add_rock", "centre of mass is at (0.01, ", "RockBody::from_hull"});
  EXPECT_TRUE(world.rocks().empty());
}

// Who forgets the friction of two surfaces that can touch is told when the second one is added, not shown ice.
TEST(Friction, MustBeGiven) {
  const RockBody rock = drawpoint::support::box_body({0.2, 0.2, 0.2});
  expect_told([] { World world({}, one_material({.stiffness = 1e8})); },
              {"kinds 0 and 0", "friction is not given"});
  World world({}, MaterialTable(2));
  add_floor(world);
  RockBody other = rock;
  other.material = 1;
  expect_told([&] { world.add_rock(rock, at(0, 0, 1)); },
              {"World::add_rock", "kind 0", "MaterialTable::set(0, 0"});
  expect_told([&] { world.add_rock(other, at(0, 0, 1)); }, {"MaterialTable::set(0, 1"});
  // Fixed surfaces never touch each other, so nothing need be said of them.
  EXPECT_NO_THROW(world.add_static(shared(box({1, 1, 1})), at(0, 0, 0), 1));
}

TEST(HalfSpaceNormal, SaysHowFarItIsOff) {
  World world({}, one_material({.friction = 0.5}));
  const Vector3d normal = (1 + 1e-8) * Vector3d::UnitZ();
  expect_told(
      [&] {
        world.add_static(shared(HalfSpace{normal, 0}), at(0, 0, 0), 0);
      },
      {"off 1 by 1e-08", "less than 1e-9", "normalized()"});
}
