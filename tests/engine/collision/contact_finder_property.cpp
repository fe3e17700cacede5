// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/contact_pairs.hpp>
#include <drawpoint/tests/support/narrow_methods.hpp>
#include <drawpoint/tests/support/rock_heap.hpp>
#include <drawpoint/tests/support/rock_pairs.hpp>
#include <functional>
#include <set>

using namespace drawpoint;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using engine::box;
using engine::Collider;
using engine::ContactFinder;
using engine::ContactFinderOptions;
using engine::ConvexPolyhedron;
using engine::Cylinder;
using engine::HalfSpace;
using engine::Manifold;
using support::collider_of;
using support::moved;
using support::same_bits;
using Heap = support::RockHeap;
using support::pose_at;
using support::share;

namespace {

constexpr double margin = 0.01;  // the finder's default

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

class ContactFinding : public support::ByNarrowMethod {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Narrow, ContactFinding, support::every_narrow_method, support::narrow_method_name);

TEST_P(ContactFinding, ReportsExactlyThePairsThatTouch) {
  const ContactFinderOptions exact =
      options({.margin = margin, .reuse_distance = 0, .reuse_angle = 0, .hysteresis = 0});
  Heap heap(40, 8, exact);
  for (int step = 0; step < 15; ++step) {
    // From small motions, looked up one by one, to large ones, for which the trees are queried as a whole.
    heap.shake(step % 3 == 0 ? 0.1 : 0.004, 0.02);
    std::set<std::pair<int, int>> found, expected;
    for (const Manifold& m : heap.finder().find())
      if (m.collider_a > 0) found.insert({m.collider_a - 1, m.collider_b - 1});
    for (int a = 0; a < 40; ++a)
      for (int b = a + 1; b < 40; ++b)
        if (!support::contact_of({heap.shapes()[a], heap.poses()[a]}, {heap.shapes()[b], heap.poses()[b]},
                                 exact)
                 .empty())
          expected.insert({a, b});
    EXPECT_EQ(found, expected) << "step " << step;
    EXPECT_GT(found.size(), 20u);
  }
}

TEST_P(ContactFinding, ReusedManifoldsStayWithinTheStatedError) {
  std::mt19937 rng(9);
  const ContactFinderOptions given = options();
  int reused = 0;
  for (int trial = 0; trial < 600; ++trial) {
    support::RockPair pair = support::random_rock_pair(rng);
    ContactFinder finder(given);
    const int a = finder.add(collider_of(pair.placed_a.shape, 0)),
              b = finder.add(collider_of(pair.placed_b.shape, 1));
    finder.set_pose(a, pair.placed_a.pose);
    for (int step = 0; step < 10; ++step) {
      const Isometry3d X_WB = moved(pair.placed_b.pose, rng, 0.9e-3, 1.9e-3);
      finder.set_pose(b, step == 0 ? pair.placed_b.pose : X_WB);
      const auto& found = finder.find();
      if (step == 0 && found.empty()) break;
      if (step == 0 || finder.times().computed > 0) continue;
      ++reused;
      const ConvexPolyhedron& small = std::get<ConvexPolyhedron>(*pair.placed_b.shape);
      const double exact = support::best_separation(pair.a, small.transformed(X_WB));
      const double bound = 2 * (given.reuse_distance + given.reuse_angle * small.radius());
      if (exact <= 0) {
        ASSERT_EQ(found.size(), 1u);
        ASSERT_NEAR(support::least_gap(found[0]), exact, bound) << "trial " << trial;
      }
    }
  }
  EXPECT_GT(reused, 1000);
}

TEST_P(ContactFinding, CarriesAManifoldWithACommonMotionExactly) {
  std::mt19937 rng(10);
  const support::RockPair pair = support::random_rock_pair(rng);
  ContactFinder finder(options());
  const int a = finder.add(collider_of(pair.placed_a.shape, 0)),
            b = finder.add(collider_of(pair.placed_b.shape, 1));
  finder.set_pose(a, pair.placed_a.pose);
  finder.set_pose(b, pair.placed_b.pose);
  const std::vector<Manifold> before = finder.find();
  ASSERT_EQ(before.size(), 1u);
  const Isometry3d X = moved(Isometry3d::Identity(), rng, 3.0, 1.0);
  finder.set_pose(a, X * pair.placed_a.pose);
  finder.set_pose(b, X * pair.placed_b.pose);
  const auto& after = finder.find();
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(finder.times().computed, 0);
  for (int k = 0; k < before[0].count; ++k) {
    EXPECT_LT((after[0].points[k].position - X * before[0].points[k].position).norm(), 1e-13);
    EXPECT_NEAR(after[0].points[k].gap, before[0].points[k].gap, 1e-13);
    EXPECT_EQ(after[0].points[k].feature, before[0].points[k].feature);
  }
}

// A cube 60 mm over the ground, or over another cube: the margin of 10 mm does not see it, a reach of 55 mm
// of either side does.
TEST_P(ContactFinding, LooksAsFarAsTheReachOfEitherSide) {
  for (const bool over_plane : {true, false})
    for (const bool upper : {true, false}) {
      ContactFinder finder(options());
      const int below = over_plane
                            ? finder.add(collider_of(share(HalfSpace{Vector3d::UnitZ(), 0.5}), -1, false))
                            : finder.add(collider_of(share(box(0.5 * Vector3d::Ones())), 1, false));
      const int above = finder.add(collider_of(share(box(0.5 * Vector3d::Ones())), 0));
      finder.set_pose(above, Isometry3d(Eigen::Translation3d(0, 0, 1.06)));
      EXPECT_TRUE(finder.find().empty());
      finder.set_speculative_margin(upper ? above : below, 0.055);
      ASSERT_EQ(finder.find().size(), 1u) << "over a plane " << over_plane << ", upper " << upper;
      EXPECT_NEAR(finder.find()[0].points[0].gap, 0.06, 1e-12);
    }
}

TEST_P(ContactFinding, SameCallsGiveSameBits) {
  Heap first(60, 12, options()), second(60, 12, options());
  for (int step = 0; step < 40; ++step) {
    const double distance = step % 5 == 0 ? 0.01 : 2e-4;
    first.shake(distance, distance), second.shake(distance, distance);
    ASSERT_TRUE(same_bits(first.finder().find(), second.finder().find())) << "step " << step;
  }
}

TEST_P(ContactFinding, AfterForgettingOnlyThePosesCount) {
  Heap old(60, 13, options());
  for (int step = 0; step < 20; ++step) {
    old.shake(1e-3, 1e-3);
    old.finder().find();
  }
  ContactFinder fresh(options());
  fresh.add(collider_of(share(HalfSpace{Vector3d::UnitZ(), 0}), -1, false));
  for (int k = 0; k < 60; ++k) fresh.set_pose(fresh.add(collider_of(old.shapes()[k], k)), old.poses()[k]);
  old.finder().forget();
  EXPECT_TRUE(same_bits(old.finder().find(), fresh.find()));
}

TEST_P(ContactFinding, KeepsItsAxisWhenTwoAreNearlyAsGood) {
  // A cube on the corner of another, in both directions 5 mm deep: which face wins would change with every
  // nudge.
  const auto cube = share(box({0.5, 0.5, 0.5}));
  ContactFinder finder(options({.reuse_distance = 0, .reuse_angle = 0}));
  finder.add(collider_of(cube, 0));
  const int b = finder.add(collider_of(cube, 1));
  finder.set_pose(b, pose_at({0.995 + 1e-5, 0, 0.995}));
  const Vector3d normal = finder.find().at(0).normal;
  for (double nudge : {-2e-5, 3e-5, -4e-5, 5e-5}) {
    finder.set_pose(b, pose_at({0.995 + nudge, 0, 0.995}));
    EXPECT_LT((finder.find().at(0).normal - normal).norm(), 1e-12);
  }
  finder.set_pose(b, pose_at({0.995 - 2e-4, 0, 0.995}));  // beyond the hysteresis of 0.1 mm
  EXPECT_GT((finder.find().at(0).normal - normal).norm(), 1);
}

TEST_P(ContactFinding, SkipsPairsThatMustNotTouch) {
  const auto cube = share(box({0.5, 0.5, 0.5}));
  const auto pairs = [&](Collider a, Collider b) {
    ContactFinder finder(options());
    finder.add(a);
    finder.add(b);
    return finder.find().size();
  };
  Collider a = collider_of(cube, 0), b = collider_of(cube, 1);
  EXPECT_EQ(pairs(a, b), 1u);
  EXPECT_EQ(pairs(a, collider_of(cube, 0)), 0u);
  EXPECT_EQ(pairs(collider_of(cube, 0, false), collider_of(cube, 1, false)), 0u);
  EXPECT_EQ(pairs(collider_of(cube, 0, false), b), 1u);
  a.family = b.family = 2;
  EXPECT_EQ(pairs(a, b), 0u);
  b.family = 3;
  EXPECT_EQ(pairs(a, b), 1u);
}

TEST_P(ContactFinding, FollowsAddingAndRemoving) {
  const auto cube = share(box({0.5, 0.5, 0.5}));
  ContactFinder finder(options());
  finder.add(collider_of(share(HalfSpace{Vector3d::UnitZ(), 0}), -1, false));
  const int low = finder.add(collider_of(cube, 0)), high = finder.add(collider_of(cube, 1));
  finder.set_pose(low, pose_at({0, 0, 0.5}));
  finder.set_pose(high, pose_at({0, 0, 1.5}));
  const auto pairs = [&] {
    std::vector<std::pair<int, int>> result;
    for (const Manifold& m : finder.find()) result.emplace_back(m.collider_a, m.collider_b);
    return result;
  };
  using Pairs = std::vector<std::pair<int, int>>;
  EXPECT_EQ(pairs(), (Pairs{{0, low}, {low, high}}));
  finder.remove(high);
  EXPECT_EQ(pairs(), (Pairs{{0, low}}));
  const int again = finder.add(collider_of(cube, 2));
  EXPECT_EQ(again, 3);
  finder.set_pose(again, pose_at({0.2, 0, 1.5}));
  EXPECT_EQ(pairs(), (Pairs{{0, low}, {low, again}}));
  EXPECT_EQ(finder.collider(again).body, 2);
}

TEST(ContactFinder, NamesItsNarrowMethods) {
  for (const char* name : {"separating_axes", "fcl_libccd", "fcl_indep"})
    EXPECT_EQ(to_string(engine::narrow_method_named(name)), name);
  EXPECT_EQ(message_of([] { engine::narrow_method_named("gjk"); }),
            "engine::narrow_method_named: no method \"gjk\"; known: separating_axes, fcl_libccd, fcl_indep");
}

TEST(ContactFinder, RefusesBadInput) {
  ContactFinder finder;
  EXPECT_EQ(message_of([] { ContactFinder{ContactFinderOptions{.margin = -1}}; }),
            "engine::ContactFinder: margin is -1.000000 m; give a finite value of at least 0");
  EXPECT_EQ(message_of([&] { finder.add(Collider{}); }),
            "engine::ContactFinder: a collider has no shape; set Collider::shape");
  EXPECT_NE(message_of([&] {
              finder.add(collider_of(share(Cylinder{-1, 1}), 0));
            }).find("positive sizes"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              finder.add(collider_of(share(HalfSpace{{0, 0, 2}, 0}), 0));
            }).find("unit normal"),
            std::string::npos);
  EXPECT_EQ(message_of([&] { finder.remove(7); }),
            "engine::ContactFinder: there is no collider 7; use a number that add() gave and remove() has "
            "not taken");
  const int id = finder.add(collider_of(share(box({1, 1, 1})), 0));
  EXPECT_NE(message_of([&] {
              finder.set_pose(id, pose_at({std::nan(""), 0, 0}));
            }).find("translation (nan, 0, 0) m, which is not finite"),
            std::string::npos);
  Isometry3d skew = Isometry3d::Identity();
  skew.linear()(0, 1) = 1e-3;
  EXPECT_NE(
      message_of([&] { finder.set_pose(id, skew); }).find("collider 0 has axes that are off orthonormal"),
      std::string::npos);
  skew.linear()(0, 1) = std::numeric_limits<double>::infinity();
  EXPECT_NE(message_of([&] { finder.set_pose(id, skew); }).find("collider 0 has axes"), std::string::npos);
}

// What find() gave is read while colliders are moved, added and removed for the next step: it stays,
// bit for bit, until the next find().
TEST(ContactFinder, ManifoldsStayUntilTheNextSearch) {
  Heap heap(40, 8);
  ContactFinder& finder = heap.finder();
  const std::vector<Manifold>& found = finder.find();
  const std::vector<Manifold> kept = found;
  ASSERT_GT(kept.size(), 20u);
  const std::vector<std::pair<const char*, std::function<void()>>> calls{
      {"set_pose",
       [&] {
         finder.set_pose(4, pose_at({0, 0, 50}));
       }},
      {"set_speculative_margin", [&] { finder.set_speculative_margin(5, 1); }},
      {"move", [&] { heap.shake(0.5, 0.5); }},
      {"add",
       [&] {
         for (int k = 0; k < 1000; ++k) finder.add(collider_of(share(box({1, 1, 1})), 100 + k));
       }},
      {"remove",
       [&] {
         for (int k = 1; k < 20; ++k) finder.remove(k);
       }},
      {"save", [&] { finder.save(); }},
      {"forget", [&] { finder.forget(); }}};
  for (const auto& [name, call] : calls) {
    call();
    EXPECT_TRUE(same_bits(found, kept)) << name;
  }
  finder.find();
  EXPECT_FALSE(same_bits(found, kept));
}
