// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <map>
#include <numbers>
#include <random>

using drawpoint::engine::box;
using drawpoint::engine::ConvexPolyhedron;
using drawpoint::engine::prism;
using Eigen::Vector3d;

namespace {

// What makes a list of faces the hull of the points: a closed surface of planar faces with nothing above any
// of them.
void expect_hull(const ConvexPolyhedron& shape, std::span<const Vector3d> points) {
  std::map<std::pair<int, int>, int> edges;
  for (std::size_t f = 0; f < shape.faces().size(); ++f) {
    const auto& face = shape.faces()[f];
    const Vector3d& n = shape.face_normals()[f];
    EXPECT_NEAR(n.norm(), 1, 1e-14);
    const double offset = n.dot(shape.vertices()[face[0]]);
    for (const Vector3d& p : points) EXPECT_LE(n.dot(p), offset + 2e-9 * shape.length());
    for (int v : face) EXPECT_NEAR(n.dot(shape.vertices()[v]), offset, 2e-9 * shape.length());
    for (std::size_t k = 0; k < face.size(); ++k) ++edges[{face[k], face[(k + 1) % face.size()]}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_EQ(shape.vertices().size() + shape.faces().size(), edges.size() / 2 + 2);
}

std::vector<Vector3d> random_points(std::mt19937& rng, int count) {
  std::normal_distribution<double> normal;
  std::vector<Vector3d> points;
  for (int k = 0; k < count; ++k) points.emplace_back(normal(rng), normal(rng), normal(rng));
  return points;
}

std::string message_of(const std::vector<Vector3d>& points) {
  try {
    ConvexPolyhedron::hull_of(points);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(ConvexPolyhedron, IsTheHullOfRandomPoints) {
  std::mt19937 rng(1);
  for (int count : {4, 5, 8, 13, 20, 50})
    for (int trial = 0; trial < 20; ++trial) {
      const auto points = random_points(rng, count);
      expect_hull(ConvexPolyhedron::hull_of(points), points);
    }
}

TEST(ConvexPolyhedron, MergesCoplanarFacesAndDropsInnerPoints) {
  std::vector<Vector3d> grid;  // 27 points of a cube: corners, edge and face middles, centre
  for (int x : {-1, 0, 1})
    for (int y : {-1, 0, 1})
      for (int z : {-1, 0, 1}) grid.emplace_back(x, y, z);
  std::mt19937 rng(2);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng)).normalized();
    std::vector<Vector3d> points;
    for (const Vector3d& p : grid) points.push_back(turn * p + Vector3d(5, -3, 2));
    points.push_back(points.front());
    const auto cube = ConvexPolyhedron::hull_of(points);
    EXPECT_EQ(cube.vertices().size(), 8u);
    EXPECT_EQ(cube.faces().size(), 6u);
    for (const auto& face : cube.faces()) EXPECT_EQ(face.size(), 4u);
    EXPECT_NEAR(cube.volume(), 8, 1e-13);
    EXPECT_NEAR(cube.length(), 2 * std::sqrt(3), 1e-14);
    expect_hull(cube, points);
  }
}

TEST(ConvexPolyhedron, PrismHasItsSidesAndVolume) {
  for (int sides : {3, 6, 48}) {
    const auto wheel = prism(0.9, 0.35, sides);
    EXPECT_EQ(wheel.vertices().size(), static_cast<std::size_t>(2 * sides));
    EXPECT_EQ(wheel.faces().size(), static_cast<std::size_t>(sides + 2));
    const double area = 0.5 * sides * 0.81 * std::sin(2 * std::numbers::pi / sides);
    EXPECT_NEAR(wheel.volume(), 0.7 * area, 1e-13);
    expect_hull(wheel, wheel.vertices());
  }
}

TEST(ConvexPolyhedron, ScalesAndMoves) {
  const auto block = box({0.5, 1, 1.5});
  EXPECT_NEAR(block.scaled(0.2).volume(), 0.008 * block.volume(), 1e-15);
  EXPECT_NEAR(block.radius(), std::sqrt(3.5), 1e-15);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.translation() << 10, 20, 30;
  const auto moved = block.transformed(pose);
  EXPECT_NEAR(moved.volume(), 6, 1e-12);
  for (std::size_t f = 0; f < 6; ++f)
    EXPECT_LT((moved.face_normals()[f] - pose.linear() * block.face_normals()[f]).norm(), 1e-13);
}

TEST(ConvexPolyhedron, RefusesWhatSpansNoVolume) {
  EXPECT_EQ(message_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
            "engine::ConvexPolyhedron: 3 points span no volume; give at least four finite points that span "
            "a volume");
  EXPECT_NE(message_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 3, 0}}).find("in one plane"),
            std::string::npos);
  EXPECT_NE(message_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}).find("not finite"),
            std::string::npos);
  EXPECT_THROW(box({1, 0, 1}), std::invalid_argument);
  EXPECT_THROW(prism(1, 1, 2), std::invalid_argument);
  EXPECT_THROW(box({1, 1, 1}).scaled(-1), std::invalid_argument);
}
