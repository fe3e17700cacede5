// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What the search for axes leaves out on the word of single precision: no face and no edge that separates by
// more, however little.
#include <gtest/gtest.h>

#include <drawpoint/engine/geometry/hull_extremes.h>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <random>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::detail::CollisionHull;
using engine::detail::HullBound;
using engine::detail::HullEdge;

namespace {
namespace this_file {

// Heights of order 1 m in double precision.
constexpr double round_off = 1e-15;

// Calls check(hull, points): rocks of 0.45 m and two or three points within 0.1 m of their surface.
template <class Check>
void for_rocks_and_points(const Check& check) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (const auto& shape : engine::granular::rock_shapes()) {
    const CollisionHull hull(shape.scaled(0.45));
    for (int k = 0; k < 200; ++k) {
      std::vector<Vector3d> points;
      for (int p = 0; p < 2 + k % 2; ++p) {
        const HullEdge& edge = hull.edges[rng() % hull.edges.size()];
        points.push_back(hull.vertices[edge.start] + share(rng) * edge.along +
                         0.1 * Vector3d(share(rng) - 0.5, share(rng) - 0.5, share(rng) - 0.5));
      }
      check(hull, points);
    }
  }
}

double ease_of(const CollisionHull& hull, const std::vector<Vector3d>& points) {
  double farthest = 0;
  for (const Vector3d& p : points) farthest = std::max(farthest, p.norm());
  return engine::constants::single_round_off * (farthest + hull.reach);
}

const HullBound* find(const std::vector<HullBound>& found, int size, int feature) {
  for (int k = 0; k < size; ++k)
    if (found[k].feature == feature) return &found[k];
  return nullptr;
}

// The most that the lowest of the points lies over the edge, among directions between its two normals.
double most_over(const CollisionHull& hull, const HullEdge& edge, const std::vector<Vector3d>& points) {
  double most = -1;
  for (int k = 0; k <= 50; ++k) {
    const Vector3d n =
        ((1 - k / 50.0) * hull.normals[edge.left] + k / 50.0 * hull.normals[edge.right]).normalized();
    double lowest = 1;
    for (const Vector3d& p : points) lowest = std::min(lowest, n.dot(p - hull.vertices[edge.start]));
    most = std::max(most, lowest);
  }
  return most;
}

TEST(HullBounds, MissNoFaceThatThePointLiesOver) {
  for_rocks_and_points([](const CollisionHull& hull, const std::vector<Vector3d>& points) {
    std::vector<HullBound> found(hull.edges.size());
    for (int f = 0; f < hull.face_count(); ++f) {
      const double height = hull.normals[f].dot(points[0]) - hull.offsets[f];
      const int size = faces_over(hull, points[0], height - round_off, found.data());
      const HullBound* face = find(found, size, f);
      ASSERT_TRUE(face);
      EXPECT_GE(face->most, height);
      EXPECT_LE(face->most, height + 2 * ease_of(hull, points));  // a bound that says something
    }
  });
}

TEST(HullBounds, MissNoEdgeThatAllPointsLieOver) {
  for_rocks_and_points([](const CollisionHull& hull, const std::vector<Vector3d>& points) {
    std::vector<HullBound> found(hull.edges.size());
    for (int e = 0; e < static_cast<int>(hull.edges.size()); ++e) {
      const double height = most_over(hull, hull.edges[e], points);
      const int size = edges_over(hull, points, height - round_off, found.data());
      const HullBound* edge = find(found, size, e);
      ASSERT_TRUE(edge);
      EXPECT_GE(edge->most, height);
    }
  });
}

// Of a point in the prism of a face the edges of that face say no more than the face itself.
TEST(HullBounds, OverTheMiddleOfAFaceItsEdgesAreNoHigher) {
  for (const auto& shape : engine::granular::rock_shapes()) {
    const CollisionHull hull(shape.scaled(0.45));
    std::vector<HullBound> found(hull.edges.size());
    for (int f = 0; f < hull.face_count(); ++f) {
      const std::vector<Vector3d> above{hull.middles[f] + 0.01 * hull.normals[f]};
      const int size = edges_over(hull, above, 0.01 + 2 * ease_of(hull, above), found.data());
      for (int e : hull.edges_of(f)) EXPECT_FALSE(find(found, size, e)) << "face " << f << ", edge " << e;
    }
  }
}

}  // namespace this_file
}  // namespace
