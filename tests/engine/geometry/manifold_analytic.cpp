// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/contact_pairs.hpp>
#include <numbers>
#include <set>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::box;
using engine::Cylinder;
using engine::HalfSpace;
using engine::Manifold;
using support::contact_of;
using support::pose_at;
using support::share;

namespace {

// Positions of order 1 m pass through two rotations and a projection: a few 1e-16, summed to well below this.
constexpr double round_off = 1e-13;
const auto ground = share(HalfSpace{Vector3d::UnitZ(), 0});
const auto unit_box = share(box({0.5, 0.5, 0.5}));

Eigen::Quaterniond turn(double angle, const Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

// All points at one gap, at different places, with different features.
void expect_flat(const Manifold& m, int count, double gap) {
  ASSERT_EQ(m.count, count);
  std::set<std::uint32_t> features;
  for (int k = 0; k < count; ++k) {
    EXPECT_NEAR(m.points[k].gap, gap, round_off);
    features.insert(m.points[k].feature);
  }
  EXPECT_EQ(static_cast<int>(features.size()), count);
}

}  // namespace

TEST(Manifold, BoxOnPlaneHasFourPointsAtTheExactGap) {
  for (double gap : {-0.003, 0.0, 0.004}) {
    const auto found = contact_of({ground}, {unit_box, pose_at({3, 2, 0.5 + gap}, turn(0.4, {0, 0, 1}))});
    ASSERT_EQ(found.size(), 1u);
    expect_flat(found[0], 4, gap);
    EXPECT_LT((found[0].normal - Vector3d::UnitZ()).norm(), round_off);
    Vector3d mean = Vector3d::Zero();
    for (const auto& p : found[0].points) mean += p.position / 4;
    EXPECT_LT((mean - Vector3d(3, 2, gap / 2)).norm(), round_off);
  }
  EXPECT_TRUE(contact_of({ground}, {unit_box, pose_at({0, 0, 0.5101})}).empty());
}

TEST(Manifold, NormalPointsFromTheFirstToTheSecond) {
  const auto found = contact_of({unit_box, pose_at({0, 0, 0.499})}, {ground});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT((found[0].normal + Vector3d::UnitZ()).norm(), round_off);
  EXPECT_NEAR(found[0].radius, std::cbrt(3 / (4 * std::numbers::pi)), round_off);
}

TEST(Manifold, BoxOnBoxTouchesInTheCommonRectangle) {
  // The upper box is shifted by (0.3, 0.2): the common rectangle is [-0.2, 0.5] x [-0.3, 0.5].
  const double gap = -0.002;
  const auto found = contact_of({unit_box}, {unit_box, pose_at({0.3, 0.2, 1 + gap})});
  ASSERT_EQ(found.size(), 1u);
  expect_flat(found[0], 4, gap);
  for (const Vector3d& corner : {Vector3d(-0.2, -0.3, 0.5 + gap / 2), Vector3d(0.5, -0.3, 0.5 + gap / 2),
                                 Vector3d(0.5, 0.5, 0.5 + gap / 2), Vector3d(-0.2, 0.5, 0.5 + gap / 2)}) {
    double nearest = 1;
    for (const auto& p : found[0].points) nearest = std::min(nearest, (p.position - corner).norm());
    EXPECT_LT(nearest, round_off);
  }
  // Equal spheres of V = 1 m³: half the radius.
  EXPECT_NEAR(found[0].radius, 0.5 * std::cbrt(3 / (4 * std::numbers::pi)), round_off);
}

TEST(Manifold, OctagonOfTurnedBoxesIsReducedToFourSpreadPoints) {
  const auto found =
      contact_of({unit_box}, {unit_box, pose_at({0, 0, 0.999}, turn(std::numbers::pi / 4, {0, 0, 1}))});
  ASSERT_EQ(found.size(), 1u);
  expect_flat(found[0], 4, -0.001);
  // The octagon has area 2(√2 − 1) = 0.83; the best four of its corners hold 1/√2 of it, any choice that is
  // not a sliver 0.3.
  double area = 0;  // the triangles of all triples cover the quadrilateral twice
  const auto& p = found[0].points;
  for (const auto& [i, j, k] : {std::array{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}})
    area += 0.25 * (p[j].position - p[i].position).cross(p[k].position - p[i].position).norm();
  EXPECT_GT(area, 0.5);
}

TEST(Manifold, CrossedEdgesTouchInOnePoint) {
  // Two bars lie on edge, one along x, one along y; their edges cross at the origin when h = 0.
  const double d = 0.1 * std::sqrt(2.0);
  const auto along_x = share(box({1, 0.1, 0.1})), along_y = share(box({0.1, 1, 0.1}));
  const Eigen::Quaterniond on_edge_x = turn(std::numbers::pi / 4, {1, 0, 0}),
                           on_edge_y = turn(std::numbers::pi / 4, {0, 1, 0});
  for (double h : {-0.004, 0.006}) {
    const auto found =
        contact_of({along_x, pose_at({0, 0, -d}, on_edge_x)}, {along_y, pose_at({0, 0, d + h}, on_edge_y)});
    ASSERT_EQ(found.size(), 1u);
    ASSERT_EQ(found[0].count, 1);
    EXPECT_NEAR(found[0].points[0].gap, h, round_off);
    EXPECT_LT((found[0].points[0].position - Vector3d(0, 0, h / 2)).norm(), round_off);
    EXPECT_LT((found[0].normal - Vector3d::UnitZ()).norm(), round_off);
  }
}

// An octagonal plate of circumradius R stands on one side of its lower face, tilted by t: the two ends of that side
// touch, the other corners hang up to 2 R cos(π/8) sin t = 7.4 mm over the plane, within the margin. What touches must
// be among the four points.
TEST(Manifold, OfManyPointsThoseThatTouchAreKept) {
  const double R = 0.2, half = 0.05, t = 0.02, apothem = R * std::cos(std::numbers::pi / 8);
  const Eigen::Quaterniond lying = turn(std::numbers::pi / 2, {1, 0, 0}), tilted = turn(-t, {1, 0, 0});
  const double height = half * std::cos(t) + apothem * std::sin(t);
  for (double gap : {-0.001, 0.0, 0.002}) {
    const auto found = contact_of(
        {ground}, {share(engine::prism(R, half, 8)), pose_at({0, 0, height + gap}, tilted * lying)});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].count, 4);
    int lowest = 0;
    for (int k = 0; k < found[0].count; ++k) lowest += std::abs(found[0].points[k].gap - gap) < round_off;
    EXPECT_EQ(lowest, 2);
  }
}

// A bar on edge lies along x across a block of half width 0.2, tilted by ±t. Its edge meets the block's upper edges at
// x = ±0.2, at heights h ∓ 0.2 tan t over the block; along the axis, which the bar's edge and the lower of the two
// span, both are shorter by cos t. Both ends are points, however little the bar tilts, and to whichever side.
TEST(Manifold, EdgeAcrossANearlyFlatFaceTouchesAtBothEnds) {
  const auto block = share(box({0.2, 1, 0.1})), bar = share(box({1, 0.1, 0.1}));
  const double h = -0.0005, radius = 0.1 * std::sqrt(2.0);
  for (double t : {-0.005, -1e-4, 1e-4, 0.005}) {
    const Eigen::Quaterniond placed = turn(t, {0, 1, 0}) * turn(std::numbers::pi / 4, {1, 0, 0});
    const double centre = 0.1 + h + radius / std::cos(t);  // puts the lower edge at height h over x = 0
    const auto found = contact_of({block}, {bar, pose_at({0, 0, centre}, placed)});
    ASSERT_EQ(found.size(), 1u);
    ASSERT_EQ(found[0].count, 2) << "t = " << t;
    for (double x : {-0.2, 0.2}) {
      const bool second = std::abs(found[0].points[1].position.x() - x) < 1e-4;
      const auto& p = found[0].points[second ? 1 : 0];
      // Half a gap beside the edge, along the normal.
      EXPECT_NEAR(p.position.x(), x, 0.5 * std::abs(p.gap) * std::abs(std::sin(t)) + round_off);
      EXPECT_NEAR(p.position.y(), 0, round_off);
      EXPECT_NEAR(p.gap, (h - x * std::tan(t)) * std::cos(t), round_off);
    }
  }
}

TEST(Manifold, CornerOnAFaceTouchesInOnePoint) {
  // A cube balanced on a corner: its lowest corner is √3/2 below the centre.
  const Eigen::Quaterniond on_corner =
      Eigen::Quaterniond::FromTwoVectors(Vector3d(1, 1, 1), Vector3d::UnitZ());
  for (double gap : {-0.005, 0.005}) {
    const auto found = contact_of({share(box({1, 1, 1}))},
                                  {unit_box, pose_at({0.2, 0.3, 1 + std::sqrt(0.75) + gap}, on_corner)});
    ASSERT_EQ(found.size(), 1u);
    ASSERT_EQ(found[0].count, 1);
    EXPECT_NEAR(found[0].points[0].gap, gap, round_off);
    EXPECT_LT((found[0].points[0].position - Vector3d(0.2, 0.3, 1 + gap / 2)).norm(), round_off);
  }
}

TEST(Manifold, CornerBesideACornerTouchesAlongTheirLine) {
  // Cubes apart along the space diagonal: no face looks at the other cube, the corners are nearest.
  const double gap = 0.006;
  const Vector3d diagonal = Vector3d(1, 1, 1).normalized();
  const auto found = contact_of({unit_box}, {unit_box, pose_at(Vector3d(1, 1, 1) + gap * diagonal)});
  ASSERT_EQ(found.size(), 1u);
  ASSERT_EQ(found[0].count, 1);
  EXPECT_NEAR(found[0].points[0].gap, gap, round_off);
  EXPECT_LT((found[0].normal - diagonal).norm(), 1e-12);
  EXPECT_TRUE(contact_of({unit_box}, {unit_box, pose_at(Vector3d(1, 1, 1) + 0.0105 * diagonal)}).empty());
}

TEST(Manifold, RollingCylinderTouchesAlongItsLowestLine) {
  const auto wheel = share(Cylinder{0.9, 0.35});
  for (double spin : {0.0, 0.3, 1.234}) {
    const auto found = contact_of({ground}, {wheel, pose_at({5, 1, 0.899}, turn(spin, {0, 1, 0}))});
    ASSERT_EQ(found.size(), 1u);
    expect_flat(found[0], 2, -0.001);
    for (double y : {0.65, 1.35}) {
      double nearest = 1;
      for (int k = 0; k < 2; ++k)
        nearest = std::min(nearest, (found[0].points[k].position - Vector3d(5, y, -0.0005)).norm());
      EXPECT_LT(nearest, round_off);
    }
  }
}

TEST(Manifold, StandingCylinderHasFourPoints) {
  const auto wheel = share(Cylinder{0.9, 0.35});
  const auto found =
      contact_of({ground}, {wheel, pose_at({0, 0, 0.35}, turn(std::numbers::pi / 2, {1, 0, 0}))});
  ASSERT_EQ(found.size(), 1u);
  expect_flat(found[0], 4, 0);
}

TEST(Manifold, CylinderOnABoxIsWithinTheSagittaOfItsPrism) {
  const double R = 0.9, sagitta = R * (1 - std::cos(std::numbers::pi / 48));
  const auto wheel = share(Cylinder{R, 0.35});
  for (int k = 0; k < 20; ++k) {
    const auto found = contact_of({share(box({1, 1, 1}))},
                                  {wheel, pose_at({0, 0, 1 + R - 0.004}, turn(0.01 * k, {0, 1, 0}))});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_GE(support::least_gap(found[0]), -0.004 - round_off);
    EXPECT_LE(support::least_gap(found[0]), -0.004 + sagitta + round_off);
  }
}
