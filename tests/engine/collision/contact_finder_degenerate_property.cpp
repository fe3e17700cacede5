// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/feature_pairs.hpp>
#include <drawpoint/tests/support/narrow_methods.hpp>
#include <drawpoint/tests/support/rock_pairs.hpp>

// Slivers, needles, flat plates, very different sizes, shapes in one place: right answers, or a refusal where
// the shape is made.
//
// Error budget. Depth: the finder prefers a face by up to 1e-7 m and takes edges within 1e-7 rad for
// parallel, which on edges of up to 7 m is another 7e-7 m: below 1e-6 m. Touching or not, near or not:
// undecided within 1e-6 m of zero and of the margin for the same reasons.
using namespace drawpoint;
using Eigen::Vector3d;
using engine::box;
using engine::ConvexPolyhedron;
using support::pose_at;
using support::share;

namespace {

constexpr double margin = 0.01, depth_error = 1e-6, doubt = 1e-6;

ConvexPolyhedron hull(const std::vector<Vector3d>& points) { return ConvexPolyhedron::hull_of(points); }

class ContactFinderDegenerateBy : public support::ByNarrowMethod {
 protected:
  static void expect_truth(const ConvexPolyhedron& a, const Eigen::Isometry3d& X_WA,
                           const ConvexPolyhedron& b, const Eigen::Isometry3d& X_WB);
};

void ContactFinderDegenerateBy::expect_truth(const ConvexPolyhedron& a, const Eigen::Isometry3d& X_WA,
                                             const ConvexPolyhedron& b, const Eigen::Isometry3d& X_WB) {
  const auto found = support::contact_of({share(a), X_WA}, {share(b), X_WB}, options());
  const ConvexPolyhedron in_world_a = a.transformed(X_WA), in_world_b = b.transformed(X_WB);
  const double separation = support::best_separation(in_world_a, in_world_b);
  for (const auto& m : found) {
    ASSERT_NEAR(m.normal.norm(), 1, 1e-12);
    for (int k = 0; k < m.count; ++k) ASSERT_TRUE(m.points[k].position.allFinite());
  }
  if (separation < -doubt) {
    ASSERT_EQ(found.size(), 1u) << "overlap " << -separation;
    ASSERT_NEAR(support::least_gap(found[0]), separation, depth_error);
    return;
  }
  const double distance = support::distance(in_world_a, in_world_b, separation);
  if (distance < margin - doubt) {
    ASSERT_EQ(found.size(), 1u) << "distance " << distance;
  } else if (distance > margin + doubt) {
    ASSERT_TRUE(found.empty()) << "distance " << distance;
  }
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(Narrow, ContactFinderDegenerateBy, support::every_narrow_method,
                         support::narrow_method_name);

TEST_P(ContactFinderDegenerateBy, FeaturesOfSliversMeetFeaturesOfRocks) {
  const std::vector<ConvexPolyhedron> shapes{
      box({0.5, 0.5, 1e-4}),                                             // a plate of 0.2 mm
      box({1, 1e-4, 1e-4}),                                              // a needle
      hull({{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 1e-5}, {0.5, 1e-4, 0.3}}),  // a tetrahedron with a flat corner
      hull({{-0.3, 0, 0}, {0.3, 0, 0}, {0, 0.3, 0}, {0, -0.3, 0}, {0, 0, 1e-3}, {0, 0, -1e-3}}),  // nearly
                                                                                                  // flat
      support::rock(2).scaled(0.05),                                                              // a pebble
      box({3.5, 3.5, 0.5}),                                                                       // on a slab
      support::rock(4).scaled(0.8)};
  support::FeaturePairs pairs(41, margin);
  for (int trial = 0; trial < 8000; ++trial) {
    const ConvexPolyhedron &a = shapes[pairs.rng()() % shapes.size()],
                           &b = shapes[pairs.rng()() % shapes.size()];
    const Eigen::Isometry3d X_WA = pose_at({1, -2, 3}, support::random_rotation(pairs.rng()));
    expect_truth(a, X_WA, b, pairs.place(a, X_WA, b));
    ASSERT_FALSE(HasFatalFailure()) << "trial " << trial;
  }
}

TEST_P(ContactFinderDegenerateBy, EqualShapesInOnePlaceOverlapByTheirWidth) {
  for (int shape = 0; shape < 6; ++shape) {
    const ConvexPolyhedron rock = support::rock(shape).scaled(0.6);
    const Eigen::Isometry3d X = pose_at({5, 6, 7}, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5));
    expect_truth(rock, X, rock, X);
  }
  const ConvexPolyhedron cube = box({0.5, 0.5, 0.5});
  const auto found = support::contact_of({share(cube)}, {share(cube)}, options());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(support::least_gap(found[0]), -1, depth_error);
}

TEST_P(ContactFinderDegenerateBy, APebbleInsideASlabGoesOutTheNearestWay) {
  const ConvexPolyhedron pebble = support::rock(0).scaled(0.05), slab = box({3.5, 3.5, 3.5});
  for (const Vector3d& at : {Vector3d(0, 0, 3.45), Vector3d(3.4, 0, 0), Vector3d(0.1, -3.48, 0.2)})
    expect_truth(slab, pose_at({0, 0, 0}), pebble, pose_at(at));
}

TEST(ContactFinderDegenerate, WhatHasNoInsideIsRefusedWhereItIsMade) {
  const auto refused = [](const std::vector<Vector3d>& points) {
    try {
      hull(points);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), "");
  EXPECT_NE(refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-10}}), "");
  EXPECT_NE(refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}), "");
  EXPECT_NE(refused({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), "");
}

// A needle or a sheet is taken down to a millionth of its extent, and refused below with that limit.
TEST(ContactFinderDegenerate, ThicknessHasALimitThatTheRefusalNames) {
  for (const double thin : {1e-2, 1e-4, 2e-6}) {
    EXPECT_EQ(box({1, thin, thin}).faces().size(), 6u) << thin;
    EXPECT_EQ(box({1, 0.7, thin}).faces().size(), 6u) << thin;
    EXPECT_NEAR(box({1, thin, thin}).volume(), 8 * thin * thin, 1e-9 * thin * thin);
  }
  try {
    box({2, 1e-7, 1e-7});
    FAIL() << "a needle of 0.2 micrometres was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "engine::ConvexPolyhedron: the points lie in one plane or nearly so: their least width is "
                 "2e-07 m; allowed: at least 1e-06 of the extent, here 4e-06 m; give at least four finite "
                 "points that span a volume");
  }
}
