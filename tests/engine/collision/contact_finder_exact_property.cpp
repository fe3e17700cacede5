// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/rock_pairs.hpp>
#include <numbers>

using namespace drawpoint;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using engine::box;
using engine::ConvexPolyhedron;
using engine::Manifold;
using engine::prism;
using support::pose_at;
using support::share;

namespace {

constexpr double margin = 0.01;  // the finder's default

}  // namespace

// The finder and the reference do the same arithmetic in different orders: 1e-12 m is ample. A pair that
// touches or is nearer than the margin must be found, one that is farther must not.
TEST(ContactFinderExactness, AgreesWithAnExhaustiveSearchOnRandomRocks) {
  std::mt19937 rng(5);
  int overlapping = 0, near = 0, apart = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const support::RockPair pair = support::random_rock_pair(rng);
    const auto found = support::contact_of(pair.placed_a, pair.placed_b);
    const double separation = support::best_separation(pair.a, pair.b);
    if (separation <= 0) {
      ++overlapping;
      ASSERT_EQ(found.size(), 1u) << "trial " << trial << ", overlap " << -separation;
      ASSERT_NEAR(support::least_gap(found[0]), separation, 1e-12) << "trial " << trial;
    } else if (separation > margin || support::distance(pair.a, pair.b) > margin) {
      ++apart;
      ASSERT_TRUE(found.empty()) << "trial " << trial << ", separation " << separation;
    } else {
      ++near;
      ASSERT_EQ(found.size(), 1u) << "trial " << trial << ", separation " << separation;
    }
    for (const Manifold& m : found) {
      ASSERT_NEAR(m.normal.norm(), 1, 1e-12);
      // Along the normal the surfaces are nowhere nearer than their extents say.
      const double extents = support::separation_along(pair.a, pair.b, m.normal);
      for (int k = 0; k < m.count; ++k) ASSERT_GE(m.points[k].gap, extents - 1e-12);
    }
  }
  // The sample must hold enough of each kind to mean something.
  EXPECT_GT(overlapping, 5000);
  EXPECT_GT(near, 500);
  EXPECT_GT(apart, 1000);
}

// Boxes, plates and prisms at right and half-right angles, some off by a millionth, faces and edges parallel,
// gaps of exactly zero: where axes tie, edges are parallel and polygons degenerate.
TEST(ContactFinderExactness, AgreesWithAnExhaustiveSearchInSpecialPositions) {
  std::mt19937 rng(77);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any_gap(-0.04, 0.012);
  const std::vector<ConvexPolyhedron> shapes{box({0.5, 0.5, 0.5}), box({2, 1, 0.02}),
                                             box({0.3, 0.2, 0.1}), prism(0.5, 0.5, 6),
                                             prism(0.3, 0.1, 3),   support::rock(1).scaled(0.5)};
  const auto special_turn = [&] {
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    for (int k = 0; k < 3; ++k) {
      const double nudge = rng() % 4 == 0 ? 1e-6 * normal(rng) : 0;
      const double angle = std::numbers::pi / 4 * static_cast<double>(rng() % 8) + nudge;
      q = q * Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::Unit(rng() % 3)));
    }
    return q.normalized();
  };
  for (int trial = 0; trial < 6000; ++trial) {
    const ConvexPolyhedron &a = shapes[rng() % shapes.size()], &b = shapes[rng() % shapes.size()];
    const Isometry3d X_WA = pose_at({0, 0, 0}, special_turn());
    Isometry3d X_WB = pose_at({0, 0, 0}, special_turn());
    const Vector3d n = X_WA.linear() * a.face_normals()[rng() % a.face_normals().size()];
    const double gap = rng() % 4 == 0 ? 0 : any_gap(rng), aside = 0.1 * static_cast<double>(rng() % 5);
    X_WB.translation() = (gap - support::separation_along(a.transformed(X_WA), b.transformed(X_WB), n)) * n +
                         aside * n.unitOrthogonal();
    const ConvexPolyhedron in_world_a = a.transformed(X_WA), in_world_b = b.transformed(X_WB);
    const double separation = support::best_separation(in_world_a, in_world_b);
    const auto found = support::contact_of({share(a), X_WA}, {share(b), X_WB});
    // Parallel edges and repeated axes leave 1e-12 of doubt about zero and about the margin.
    constexpr double doubt = 1e-9;
    if (separation < -doubt) {
      ASSERT_EQ(found.size(), 1u) << "trial " << trial << ", overlap " << -separation;
      // The axis of a face is preferred to one of edges that is better by less than 1e-7 m.
      ASSERT_NEAR(support::least_gap(found[0]), separation, 1.1e-7) << "trial " << trial;
      continue;
    }
    const double distance = support::distance(in_world_a, in_world_b, separation);
    if (distance < margin - doubt) {
      ASSERT_EQ(found.size(), 1u) << "trial " << trial << ", distance " << distance;
    } else if (distance > margin + doubt) {
      ASSERT_TRUE(found.empty()) << "trial " << trial << ", distance " << distance;
    }
  }
}

TEST(ContactFinderExactness, DoesNotCareWhichShapeComesFirst) {
  std::mt19937 rng(6);
  for (int trial = 0; trial < 2000; ++trial) {
    const support::RockPair pair = support::random_rock_pair(rng);
    const auto ab = support::contact_of(pair.placed_a, pair.placed_b);
    const auto ba = support::contact_of(pair.placed_b, pair.placed_a);
    ASSERT_EQ(ab.size(), ba.size()) << "trial " << trial;
    if (ab.empty()) continue;
    ASSERT_EQ(ab[0].count, ba[0].count) << "trial " << trial;
    ASSERT_NEAR(support::least_gap(ab[0]), support::least_gap(ba[0]), 1e-12);
    ASSERT_LT((ab[0].normal + ba[0].normal).norm(), 1e-9);
  }
}
