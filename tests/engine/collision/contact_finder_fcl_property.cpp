// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Touching pairs that FCL gets wrong, on its own and with libccd: the contact finder, which takes its pairs
// of boxes from FCL, gets them right, with FCL's narrow phase too, whose answers it checks. Error budget: the finder prefers a face to edges that
// are better by less than 1e-7 m; bound 1e-6 m.
#include <gtest/gtest.h>

#include <drawpoint/tests/engine/collision/fcl_failures.hpp>
#include <drawpoint/tests/support/rock_pairs.hpp>

using namespace drawpoint;
using engine::ConvexPolyhedron;
using engine::NarrowMethod;
using support::FclFailure;

namespace {

ConvexPolyhedron shape(int number, double size) {
  if (number == 6) return engine::box({4 * size, 4 * size, 0.5 * size});
  return support::rock(number).scaled(size);
}

Eigen::Isometry3d pose(const std::array<double, 4>& turn, const Eigen::Vector3d& at) {
  return support::pose_at(at, {turn[0], turn[1], turn[2], turn[3]});
}

/// The depth by all axes [m], after the finder was held to it both ways round.
double checked_depth(const FclFailure& pair) {
  const ConvexPolyhedron a = shape(pair.shape_a, pair.size_a), b = shape(pair.shape_b, pair.size_b);
  const Eigen::Isometry3d X_WA = pose(pair.turn_a, {0, 0, 0}),
                          X_WB = pose(pair.turn_b, Eigen::Vector3d(pair.position_b.data()));
  const double depth = -support::best_separation(a.transformed(X_WA), b.transformed(X_WB));
  EXPECT_GT(depth, 1e-3) << "they touch";
  const support::Placed first{support::share(a), X_WA}, second{support::share(b), X_WB};
  for (const auto narrow : {NarrowMethod::separating_axes, NarrowMethod::fcl_libccd, NarrowMethod::fcl_indep})
    for (const bool swapped : {false, true}) {
      const auto found =
          support::contact_of(swapped ? second : first, swapped ? first : second, {.narrow = narrow});
      EXPECT_EQ(found.size(), 1u);
      if (!found.empty()) {
        EXPECT_NEAR(support::least_gap(found[0]), -depth, 1e-6);
      }
    }
  return depth;
}

}  // namespace

TEST(FclFailures, DepthsThatLibccdPutsTooDeep) {
  for (const FclFailure& pair : support::wrong_depths)
    EXPECT_GT(pair.fcl_depth, checked_depth(pair) + 0.04) << "the record must show a failure";
}

TEST(FclFailures, TouchingPairsThatTheBuiltInSolverMisses) {
  for (const FclFailure& pair : support::missed_contacts) {
    EXPECT_EQ(pair.fcl_depth, 0) << "the record must show a failure";
    checked_depth(pair);
  }
}
