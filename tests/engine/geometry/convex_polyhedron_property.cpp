// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
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

struct Mesh {
  std::vector<Vector3d> points;
  std::size_t vertices, faces;
  double volume, surface;
};

// Corners, middles of edges and of faces, several times over, as in a list of triangles.
Mesh subdivided_box(double x, double y, double z) {
  Mesh mesh{{}, 8, 6, 8 * x * y * z, 8 * (x * y + y * z + z * x)};
  for (int copy = 0; copy < 3; ++copy)
    for (int i : {-1, 0, 1})
      for (int j : {-1, 0, 1})
        for (int k : {-1, 0, 1})
          if (i || j || k) mesh.points.emplace_back(i * x, j * y, k * z);
  return mesh;
}

// A prism of radius and half height 1 with points along its edges and in the middle of its ends.
Mesh ring_of(int sides) {
  const double turn = 2 * std::numbers::pi / sides, area = 0.5 * sides * std::sin(turn);
  Mesh mesh{{},
            static_cast<std::size_t>(2 * sides),
            static_cast<std::size_t>(sides + 2),
            2 * area,
            2 * area + 2 * sides * 2 * std::sin(turn / 2)};
  for (double z : {-1.0, 1.0}) mesh.points.emplace_back(0, 0, z);
  for (int k = 0; k < sides; ++k)
    for (double z : {-1.0, 0.0, 1.0}) mesh.points.emplace_back(std::cos(k * turn), std::sin(k * turn), z);
  return mesh;
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

// A mesh as files have it: turned, moved and sized as may be, in single precision or as text of six digits. A number x
// is then off by at most 2^-24 |x| or 5e-6 |x|, so points by e = sqrt(3) of that for the largest, the volume by e times
// the surface, and planes by a few e, below the 1e-5 of the extent within which faces are merged: text is not moved
// away.
TEST(ConvexPolyhedron, FindsTheFacesThatAMeshMeant) {
  struct Rounded {
    double error;  // of a number
    double away;   // in sizes of the mesh
    double (*round)(double);
  };
  const Rounded single{std::pow(2.0, -24), 10, [](double x) { return double(float(x)); }};
  const Rounded six_digits{5e-6, 0, [](double x) {
                             char text[32];
                             std::snprintf(text, sizeof text, "%.6g", x);
                             return std::atof(text);
                           }};
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  for (const Mesh& mesh : {subdivided_box(1, 1, 1), subdivided_box(1, 0.4, 0.05), ring_of(3), ring_of(5),
                           ring_of(16), ring_of(48)})
    for (const Rounded& rounded : {single, six_digits})
      for (int trial = 0; trial < 200; ++trial) {
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng)).normalized();
        const double size = std::pow(10.0, trial % 5 - 2);
        const Vector3d away = rounded.away * Vector3d(normal(rng), normal(rng), normal(rng));
        std::vector<Vector3d> points;
        double largest = 0;
        for (const Vector3d& p : mesh.points) {
          points.push_back((size * (turn * p + away)).unaryExpr(rounded.round));
          largest = std::max(largest, points.back().cwiseAbs().maxCoeff());
        }
        const auto shape = ConvexPolyhedron::hull_of(points);
        ASSERT_EQ(shape.vertices().size(), mesh.vertices) << mesh.points.size() << " points, trial " << trial;
        ASSERT_EQ(shape.faces().size(), mesh.faces) << mesh.points.size() << " points, trial " << trial;
        const double e = std::sqrt(3.0) * rounded.error * largest;
        ASSERT_NEAR(shape.volume(), size * size * size * mesh.volume, 2 * e * size * size * mesh.surface);
      }
}

// What SciPy's ConvexHull, which is Qhull, takes: any points that span a volume. All lie within the tolerance of the
// hull, and its volume is what Qhull says of the same points (facets as triangles), here summed from them.
TEST(ConvexPolyhedron, TakesAnyCloud) {
  std::mt19937 rng(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const int count = 4 + static_cast<int>(rng() % 300);
    const Vector3d sizes(1, std::pow(10.0, -(trial % 4)), std::pow(10.0, -(trial % 6)));
    std::vector<Vector3d> points;
    for (int k = 0; k < count; ++k) {
      Vector3d p(normal(rng), normal(rng), normal(rng));
      if (trial % 3 == 1) p.normalize();
      if (trial % 3 == 2) p = Vector3d(uniform(rng), uniform(rng), uniform(rng));
      points.push_back(sizes.cwiseProduct(p));
      if (trial % 5 == 0) points.push_back(points.back());
    }
    const auto shape = ConvexPolyhedron::hull_of(points);
    const double tolerance = 2e-5 * shape.length();
    for (std::size_t f = 0; f < shape.faces().size(); ++f) {
      const Vector3d& n = shape.face_normals()[f];
      for (const Vector3d& p : points)
        ASSERT_LE(n.dot(p - shape.vertices()[static_cast<std::size_t>(shape.faces()[f][0])]), tolerance)
            << "trial " << trial;
    }
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
