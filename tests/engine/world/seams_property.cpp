// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A surface made of parts is one surface: what slides over the joints of a floor of tiles goes as far as on a
// half-space, and what should stop it does.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/tests/support/scenes.hpp>
#include <random>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;

namespace {

using Random = std::mt19937_64;
constexpr double g = 9.81;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Eigen::Matrix3d any_turn(Random& random) {
  std::normal_distribution<double> normal;
  const Eigen::Vector4d q(normal(random), normal(random), normal(random), normal(random));
  return Eigen::Quaterniond(q).normalized().toRotationMatrix();
}

World world_of(const Eigen::Matrix3d& floor, double friction, double stiffness) {
  engine::WorldOptions options;
  options.gravity = -g * floor.col(2);
  return World(options, support::one_material({.friction = friction, .stiffness = stiffness}));
}

// The floor's frame in the world.
Eigen::Isometry3d placed(const Eigen::Matrix3d& floor, const Vector3d& p) {
  Eigen::Isometry3d X(floor);
  X.translation() = floor * p;
  return X;
}

// A prism whose top is the rectangle of these sides about the origin; its sides lean outwards by `lean` below.
engine::Shape tile(double x, double y, double lean) {
  std::vector<Vector3d> points;
  for (const double sx : {-0.5, 0.5})
    for (const double sy : {-0.5, 0.5}) {
      points.emplace_back(sx * x, sy * y, 0);
      points.emplace_back(sx * (x + 2 * lean), sy * (y + 2 * lean), -0.3);
    }
  return engine::ConvexPolyhedron::hull_of(points);
}

struct Tiling {
  double length, width, shift, lean, gap;
};

// From x = -1 to 5 and y = -3 to 3, row by row, each row shifted against the last.
void add_tiles(World& world, const Eigen::Matrix3d& floor, const Tiling& t) {
  const auto shape = support::shared(tile(t.length - t.gap, t.width - t.gap, t.lean));
  int row = 0;
  for (double y = -2; y < 2 + t.width; y += t.width, ++row)
    for (double x = -1 - t.length + std::fmod(row * t.shift, t.length); x < 4.5; x += t.length)
      world.add_static(shape, placed(floor, {x, y, 0}), 0);
}

// How far a block slides that starts at v along the angle.
double slide(World& world, const Eigen::Matrix3d& floor, const Vector3d& half, double v, double angle) {
  const Vector3d way = floor * Vector3d(std::cos(angle), std::sin(angle), 0);
  const int block = world.add_rock(support::box_body(half), placed(floor, {0, 0, half.z()}), v * way);
  for (int k = 0; k < 400 && world.rock(block).velocity.norm() > 1e-4; ++k) world.step();
  const Vector3d from = floor * Vector3d(0, 0, half.z());
  return (world.rock(block).pose.translation() - from).dot(way);
}

}  // namespace

// Flat blocks (which do not tip) on floors that stand anyhow in the world.
TEST(Seams, ABlockSlidesOverTilesAsFarAsOverAHalfSpace) {
  Random random(21);
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::Matrix3d floor = trial % 3 ? any_turn(random) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    const double friction = between(random, 0.2, 0.6), v = between(random, 1, 4),
                 angle = between(random, -0.6, 0.6), stiffness = std::pow(10, between(random, 7, 9));
    const Vector3d half(between(random, 0.1, 0.4), between(random, 0.1, 0.4), between(random, 0.03, 0.06));
    const Tiling tiling{between(random, 0.15, 0.8), between(random, 0.15, 0.8), between(random, 0, 0.4),
                        trial % 2 ? 0.0 : between(random, -0.03, 0.03), trial % 4 ? 0.0 : 5e-4};
    World plane = world_of(floor, friction, stiffness), tiles = world_of(floor, friction, stiffness);
    plane.add_static(support::shared(engine::HalfSpace{floor.col(2), 0}), Eigen::Isometry3d::Identity(), 0);
    add_tiles(tiles, floor, tiling);
    const double expected = slide(plane, floor, half, v, angle), way = slide(tiles, floor, half, v, angle);
    EXPECT_NEAR(way, expected, 0.01 * expected)
        << "trial " << trial << ": " << v << " m/s, friction " << friction << ", tiles " << tiling.length
        << " x " << tiling.width << " m, gap " << tiling.gap << ", lean " << tiling.lean;
  }
}

// 20 starts over a row of boxes of 0.5 m: 0.68 m at 2 m/s, 2.72 m at 4 m/s.
TEST(Seams, ABlockSlidesOverARowOfBoxes) {
  for (const double v : {2.0, 4.0})
    for (int start = 0; start < 20; ++start) {
      World world = world_of(Eigen::Matrix3d::Identity(), 0.3, 1e8);
      for (int k = -2; k < 10; ++k)
        world.add_static(support::shared(engine::box({0.25, 1, 0.25})),
                         support::at(0.5 * k + 0.025 * start, 0, -0.25), 0);
      const double way = slide(world, Eigen::Matrix3d::Identity(), Vector3d::Constant(0.2), v, 0);
      EXPECT_NEAR(way, v * v / (2 * 0.3 * g), 0.01 * v * v / (2 * 0.3 * g)) << start;
    }
}

// A step in the floor and a wall that stands on it, sunk into it or not: the block does not pass.
TEST(Seams, AStepAndAWallStopWhatSlides) {
  for (const double step : {0.003, 0.01, 0.5})
    for (const double foot : {0.0, 0.2}) {
      World world = world_of(Eigen::Matrix3d::Identity(), 0.1, 1e8);
      world.add_static(support::shared(engine::box({2, 2, 0.25})), support::at(0, 0, -0.25), 0);
      world.add_static(support::shared(engine::box({0.5, 2, 0.5 * (step + foot)})),
                       support::at(1, 0, 0.5 * (step - foot)), 0);
      const double way = slide(world, Eigen::Matrix3d::Identity(), {0.2, 0.2, 0.05}, 1, 0);
      EXPECT_NEAR(way, 0.3, 0.005) << "step of " << step << " m, foot " << foot << " m";
    }
}

// A wall that leans, in front of which the block lies: it takes the block's push, and the floor its weight,
// however little it leans.
TEST(Seams, AWallThatLeansStopsWhatSlides) {
  for (const double degrees : {-5.0, -1.0, -0.01, 0.01, 0.1, 1.0, 5.0})
    for (const double foot : {0.0, 0.2}) {
      World world = world_of(Eigen::Matrix3d::Identity(), 0.1, 1e8);
      world.add_static(support::shared(engine::box({2, 2, 0.25})), support::at(0, 0, -0.25), 0);
      Eigen::Isometry3d wall(Eigen::AngleAxisd(degrees * M_PI / 180, Vector3d::UnitY()));
      wall.translation() = Vector3d(0.5, 0, 0) + wall.linear() * Vector3d(0.5, 0, 0.5 * (1 - foot));
      world.add_static(support::shared(engine::box({0.5, 2, 0.5 * (1 + foot)})), wall, 0);
      const int block =
          world.add_rock(support::box_body({0.2, 0.2, 0.05}), support::at(0, 0, 0.05), {1, 0, 0});
      for (int k = 0; k < 200; ++k) {
        world.step();
        ASSERT_LT(world.rock(block).pose.translation().x(), 0.305)
            << degrees << " deg, foot " << foot << " m";
        ASSERT_GT(world.rock(block).pose.translation().z(), 0.045)
            << degrees << " deg, foot " << foot << " m";
      }
    }
}

// So do slabs with many corners and sides that lean outwards, whose corners meet those of tiles.
TEST(Seams, ASlabOfManyCornersSlidesOverTilesAsFarAsOverABox) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    Random random(seed);
    std::vector<Vector3d> points;
    for (int k = 0; k < 12; ++k) {
      const double x = between(random, -0.5, 0.5), y = between(random, -0.5, 0.5);
      points.emplace_back(x, y, 0.06);
      points.emplace_back(0.8 * x, 0.8 * y, -0.06);
    }
    const engine::PlacedHull slab = engine::place_hull(points, 2700);
    const Eigen::Isometry3d start = support::at(0, 0, 0.06) * slab.X_PB;
    double way[2];
    for (const bool tiles : {false, true}) {
      World world = world_of(Eigen::Matrix3d::Identity(), 0.4, 1e8);
      if (!tiles) world.add_static(support::shared(engine::box({30, 30, 0.25})), support::at(0, 0, -0.25), 0);
      for (int i = -4; tiles && i < 12; ++i)
        for (int j = -6; j < 7; ++j)
          world.add_static(support::shared(engine::box({0.15, 0.2, 0.25})),
                           support::at(0.3 * i + 0.02 * seed, 0.4 * j, -0.25), 0);
      const int rock = world.add_rock(slab.body, start, {3, 0.5, 0});
      for (int k = 0; k < 120; ++k) world.step();
      way[tiles] = (world.rock(rock).pose.translation() - start.translation()).norm();
    }
    EXPECT_NEAR(way[1], way[0], 0.01 * way[0]) << "seed " << seed;
  }
}
