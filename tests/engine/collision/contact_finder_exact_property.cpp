// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/narrow_methods.hpp>
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

class ContactFinderExactness : public support::ByNarrowMethod {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Narrow, ContactFinderExactness, support::every_narrow_method,
                         support::narrow_method_name);

// The finder and the reference do the same arithmetic in different orders: 1e-12 m is ample. A pair that
// touches or is nearer than the margin must be found, one that is farther must not.
TEST_P(ContactFinderExactness, AgreesWithAnExhaustiveSearchOnRandomRocks) {
  std::mt19937 rng(5);
  int overlapping = 0, near = 0, apart = 0;
  const int trials = GetParam() == engine::NarrowMethod::separating_axes ? 20000 : 4000;  // FCL is slow
  for (int trial = 0; trial < trials; ++trial) {
    const support::RockPair pair = support::random_rock_pair(rng);
    const auto found = support::contact_of(pair.placed_a, pair.placed_b, options());
    const double separation = support::best_separation(pair.a, pair.b);
    if (separation <= 0) {
      ++overlapping;
      ASSERT_EQ(found.size(), 1u) << "trial " << trial << ", overlap " << -separation;
      ASSERT_NEAR(support::least_gap(found[0]), separation, 1e-12 + claim_error()) << "trial " << trial;
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
  EXPECT_GT(overlapping, trials / 4);
  EXPECT_GT(near, trials / 40);
  EXPECT_GT(apart, trials / 20);
}

// Boxes, plates and prisms at right and half-right angles, some off by a millionth, faces and edges parallel,
// gaps of exactly zero: where axes tie, edges are parallel and polygons degenerate.
TEST_P(ContactFinderExactness, AgreesWithAnExhaustiveSearchInSpecialPositions) {
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
    const auto found = support::contact_of({share(a), X_WA}, {share(b), X_WB}, options());
    // Parallel edges and repeated axes leave 1e-12 of doubt about zero and about the margin.
    constexpr double doubt = 1e-9;
    if (separation < -doubt) {
      ASSERT_EQ(found.size(), 1u) << "trial " << trial << ", overlap " << -separation;
      // The axis of a face is preferred to one of edges that is better by less than 1e-7 m.
      ASSERT_NEAR(support::least_gap(found[0]), separation, 1.1e-7 + claim_error()) << "trial " << trial;
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

// Tetrahedra and cubes with corners on integers, half-integers apart: where a corner, an edge or a face of one lies in
// a face of the other, or the origin of the Minkowski difference in a face of GJK's simplex. FCL is wrong here most
// often, and its EPA may not end.
TEST_P(ContactFinderExactness, AgreesWithAnExhaustiveSearchOnALattice) {
  std::mt19937 rng(5);
  const auto corner = [&] {
    return Vector3d(static_cast<double>(rng() % 3), static_cast<double>(rng() % 3),
                    static_cast<double>(rng() % 3));
  };
  const auto tetrahedron = [&] {
    for (;;) {
      const std::vector<Vector3d> p{corner(), corner(), corner(), corner()};
      if (std::abs((p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0])) > 0.5)
        return ConvexPolyhedron::hull_of(p);
    }
  };
  int overlapping = 0;
  constexpr double doubt = 1e-9;
  for (int trial = 0; trial < 6000; ++trial) {
    const ConvexPolyhedron a = trial % 3 == 0 ? box({1, 1, 1}) : tetrahedron(),
                           b = trial % 3 == 1 ? tetrahedron() : box({1, 1, 1});
    const Isometry3d X = pose_at(0.5 * (corner() + corner() - corner() - corner()));
    const double separation = support::best_separation(a, b.transformed(X));
    const auto found = support::contact_of({share(a)}, {share(b), X}, options());
    if (separation < -doubt) {
      ++overlapping;
      ASSERT_EQ(found.size(), 1u) << "trial " << trial << ", overlap " << -separation;
      ASSERT_NEAR(support::least_gap(found[0]), separation, 1.1e-7 + claim_error()) << "trial " << trial;
    } else if (separation <= margin) {  // they touch, or their distances are not that small
      const double distance = support::distance(a, b.transformed(X), separation);
      ASSERT_EQ(found.size(), distance < margin ? 1u : 0u) << "trial " << trial << ", distance " << distance;
    } else {
      ASSERT_TRUE(found.empty()) << "trial " << trial;
    }
  }
  EXPECT_GT(overlapping, 1000);
}

TEST_P(ContactFinderExactness, DoesNotCareWhichShapeComesFirst) {
  std::mt19937 rng(6);
  for (int trial = 0; trial < 2000; ++trial) {
    const support::RockPair pair = support::random_rock_pair(rng);
    const auto ab = support::contact_of(pair.placed_a, pair.placed_b, options());
    const auto ba = support::contact_of(pair.placed_b, pair.placed_a, options());
    ASSERT_EQ(ab.size(), ba.size()) << "trial " << trial;
    if (ab.empty()) continue;
    ASSERT_EQ(ab[0].count, ba[0].count) << "trial " << trial;
    ASSERT_NEAR(support::least_gap(ab[0]), support::least_gap(ba[0]), 1e-12);
    ASSERT_LT((ab[0].normal + ba[0].normal).norm(), 1e-9);
  }
}
