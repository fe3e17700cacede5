// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/engine/geometry/ray.hpp>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <numbers>

using namespace drawpoint::engine;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

// Some ten operations on numbers of size 10, each rounded by 1e-16.
constexpr double round_off = 1e-14;

Isometry3d at(double x, double y, double z) { return Isometry3d(Eigen::Translation3d(x, y, z)); }

bool inside(const ConvexPolyhedron& hull, const Vector3d& p) {
  for (std::size_t f = 0; f < hull.faces().size(); ++f)
    if (hull.face_normals()[f].dot(p - hull.vertices()[static_cast<std::size_t>(hull.faces()[f][0])]) > 0)
      return false;
  return true;
}

// The first point of the ray inside the hull, by small steps and bisection to 1e-9; below 0 where there is none.
double searched(const ConvexPolyhedron& hull, const Ray& ray, double most) {
  constexpr double step = 1e-3;
  for (double end = step; end <= most; end += step) {
    if (!inside(hull, ray.origin + end * ray.direction)) continue;
    double out = end - step, in = end;
    while (in - out > 1e-9) {
      const double middle = 0.5 * (in + out);
      (inside(hull, ray.origin + middle * ray.direction) ? in : out) = middle;
    }
    return in;
  }
  return -1;
}

}  // namespace

TEST(Ray, MeetsAHalfSpace) {
  const HalfSpace ground{Vector3d::UnitZ(), 1};  // stands at z = 3 in all
  const double slant = std::numbers::sqrt2 / 2;
  const auto down = intersect({{0, 0, 8}, -Vector3d::UnitZ()}, ground, at(0, 0, 2), 100);
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->distance, 5, round_off);
  EXPECT_LT((down->normal - Vector3d::UnitZ()).norm(), round_off);
  const auto slanting = intersect({{0, 0, 8}, {slant, 0, -slant}}, ground, at(0, 0, 2), 100);
  ASSERT_TRUE(slanting);
  EXPECT_NEAR(slanting->distance, 5 * std::numbers::sqrt2, 10 * round_off);
  EXPECT_FALSE(intersect({{0, 0, 8}, -Vector3d::UnitZ()}, ground, at(0, 0, 2), 4.9)) << "too far";
  EXPECT_FALSE(intersect({{0, 0, 8}, Vector3d::UnitZ()}, ground, at(0, 0, 2), 100)) << "looks away";
  EXPECT_FALSE(intersect({{0, 0, 8}, Vector3d::UnitX()}, ground, at(0, 0, 2), 100)) << "runs beside it";
  EXPECT_FALSE(intersect({{0, 0, 0}, Vector3d::UnitZ()}, ground, at(0, 0, 2), 100)) << "starts inside";
}

TEST(Ray, MeetsATurnedBox) {
  Isometry3d pose = at(5, 1, 0);
  pose.rotate(Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitZ()));
  const Shape cube = box({1, 1, 1});
  // An edge points at the ray at x = 5 - sqrt(2); 0.5 beside it the face lies 0.5 deeper.
  const auto hit = intersect({{0, 1.5, 0.3}, Vector3d::UnitX()}, cube, pose, 100);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 5 - std::numbers::sqrt2 + 0.5, 10 * round_off);
  EXPECT_LT((hit->normal - Vector3d(-1, 1, 0).normalized()).norm(), round_off);
  EXPECT_FALSE(intersect({{0, 1 + 1.4143, 0}, Vector3d::UnitX()}, cube, pose, 100)) << "passes by";
  EXPECT_FALSE(intersect({{5, 1, 0}, Vector3d::UnitX()}, cube, pose, 100)) << "starts inside";
}

TEST(Ray, MeetsACylinder) {
  const Cylinder wheel{0.5, 0.2};
  const auto side = intersect({{-3, 0.1, 0.3}, Vector3d::UnitX()}, wheel, at(0, 0, 0), 100);
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->distance, 3 - 0.4, round_off);  // sqrt(0.5^2 - 0.3^2)
  EXPECT_LT((side->normal - Vector3d(-0.8, 0, 0.6)).norm(), round_off);
  const auto end = intersect({{0.1, 2, 0.1}, -Vector3d::UnitY()}, wheel, at(0, 0, 0), 100);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->distance, 1.8, round_off);
  EXPECT_LT((end->normal - Vector3d::UnitY()).norm(), round_off);
  EXPECT_FALSE(intersect({{-3, 0, 0.5 + 1e-9}, Vector3d::UnitX()}, wheel, at(0, 0, 0), 100));
  EXPECT_TRUE(intersect({{-3, 0, 0.5 - 1e-9}, Vector3d::UnitX()}, wheel, at(0, 0, 0), 100));
  EXPECT_FALSE(intersect({{0.1, 2, 0.6}, -Vector3d::UnitY()}, wheel, at(0, 0, 0), 100))
      << "beside the end face";
}

// Against a search that only knows which side of each face a point is on. It sees a chord longer than its step; a hit
// on a shorter one may be ours alone.
TEST(Ray, EntersRocksWhereASearchDoes) {
  CounterRandom random(11);
  int hits = 0;
  for (int k = 0; k < 300; ++k) {
    const ConvexPolyhedron& rock = granular::rock_shapes()[static_cast<std::size_t>(k % 6)];
    const auto sign = [&] { return 2 * random.uniform() - 1; };
    const Vector3d from = Vector3d(sign(), sign(), sign()).normalized() * 1.5;
    const Vector3d to(0.3 * sign(), 0.3 * sign(), 0.3 * sign());
    const Ray ray{from, (to - from).normalized()};
    const auto hit = intersect(ray, rock, Isometry3d::Identity(), 3);
    const double expected = searched(rock, ray, 3);
    if (expected < 0) continue;
    ++hits;
    ASSERT_TRUE(hit) << "ray " << k;
    EXPECT_NEAR(hit->distance, expected, 2e-9) << "ray " << k;
    EXPECT_LT(hit->normal.dot(ray.direction), 0) << "ray " << k;
  }
  EXPECT_GT(hits, 100) << "the rays must be aimed at the rocks";
}
