// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Freezing in piles of rocks that a blade has dug through: they come to rest for good, waking moves nothing
// that stood, and the bits depend on nothing but the calls.
#include <gtest/gtest.h>

#include <drawpoint/engine/collision/contact_finder.hpp>
#include <drawpoint/engine/world/state_hash.hpp>
#include <drawpoint/tests/support/blade_pile.hpp>
#include <drawpoint/tests/support/pile_world.hpp>

using namespace drawpoint;
using engine::World;
using engine::WorldOptions;

namespace {

WorldOptions freezing_options(int threads = 1) {
  WorldOptions options;
  options.freezing.on = true;
  options.threads = threads;
  return options;
}

std::vector<bool> frozen(const World& world) {
  std::vector<bool> result;
  for (std::size_t k = 0; k < world.rocks().size(); ++k)
    result.push_back(world.rocks()[k].present && world.frozen(static_cast<int>(k)));
  return result;
}

bool all_frozen(const World& world) {
  const std::vector<bool> f = frozen(world);
  return std::find(f.begin(), f.end(), false) == f.end();
}

void run(World& world, double seconds) {
  for (const double end = world.time() + seconds - 1e-9; world.time() < end;) world.step();
}

// These tests need piles that come to rest. With as much rolling and spinning resistance as this, rocks stop
// ticking in their seats; with 0.1 and none some never do (docs/measurements/freezing.md), and stay awake.
support::PileMaterial that_holds_still() {
  support::PileMaterial material;
  material.rolling = material.spinning = 0.5;
  return material;
}

// Soon at rest here, still on the move there.
constexpr engine::Material pushed_about{.friction = 0.6, .rolling = 0.05, .stiffness = 1e8};
constexpr std::uint64_t turns = 7;

// Settled for 3 s, dug for 1 s; then the blade is taken away.
void disturb(support::PileWorld& pile) {
  run(pile.world(), 3);
  pile.dig();
  run(pile.world(), 1);
  pile.world().attach(nullptr);
}

class DisturbedPile : public testing::TestWithParam<int> {};

}  // namespace

// What is left when the blade has gone falls by less than the pile's height and has stopped after 1 s; rocks
// that rattle in their seats make it longer, so 6 s are given. From then on nothing wakes: a frozen rock
// wakes by the loads of awake neighbours alone, and there are none.
TEST_P(DisturbedPile, ComesToFullRestAndStaysThere) {
  support::PileWorld pile(support::rock_pile(300, static_cast<std::uint64_t>(GetParam()), that_holds_still()),
                          freezing_options());
  disturb(pile);
  World& world = pile.world();
  const double start = world.time();
  while (!all_frozen(world) && world.time() < start + 6) world.step();
  const auto f = frozen(world);
  ASSERT_TRUE(all_frozen(world)) << std::count(f.begin(), f.end(), false) << " rocks are awake after 6 s";
  const std::uint64_t at_rest = engine::state_hash(world);
  for (int k = 0; k < 300; ++k) {
    const auto report = world.step();
    ASSERT_EQ(report.awake, 0) << "step " << k;
    ASSERT_EQ(report.points, 0);
    ASSERT_TRUE(all_frozen(world)) << "step " << k;
  }
  for (const auto& rock : world.rocks()) EXPECT_EQ(rock.velocity.norm() + rock.angular_velocity.norm(), 0);
  EXPECT_NE(engine::state_hash(world), at_rest) << "time goes on";
}

// Thawed all at once, a settled pile stands on the same contacts and impulses as when it froze. A rock froze
// at distance / hold = 1 mm/s at the most, and its neighbours take up within the step what it lacks in
// balance: so the measure is the speed that freezing may have taken away. Contacts computed anew would differ
// in gap by up to the 1 mm of their reuse, which the solve takes back in two steps: tens of mm/s.
TEST(FreezingPile, IsNotMovedByWaking) {
  for (const std::uint64_t seed : {1, 3}) {
    support::PileWorld pile(support::rock_pile(300, seed, that_holds_still()), freezing_options());
    World& world = pile.world();
    run(world, 5);
    const auto f = frozen(world);
    EXPECT_GT(std::count(f.begin(), f.end(), true), 280);
    world.thaw_all();
    for (int k = 0; k < 5; ++k) {
      world.step();
      EXPECT_LT(world.fastest_rock(), world.options().freezing.distance / world.options().freezing.hold)
          << "seed " << seed << ", step " << k;
    }
  }
}

// A pair that stood still comes back as it was: its contact is carried along, not searched anew, which gives
// other points (forget() does just that).
TEST(FreezingPile, StandingPairsComeBackWithTheSameContact) {
  const auto cube = std::make_shared<const engine::Shape>(engine::box(Eigen::Vector3d::Constant(0.15)));
  engine::ContactFinder finder;
  const int low = finder.add({cube, 1}), high = finder.add({cube, 2});
  Eigen::Isometry3d pose(Eigen::Translation3d(0.05, 0.03, 0.2999));
  finder.set_pose(high, pose);
  finder.find();
  pose.rotate(Eigen::AngleAxisd(1e-3, Eigen::Vector3d(1, 2, 3).normalized()));  // less than reuse_angle
  finder.set_pose(high, pose);
  const auto gaps_and_points = [&] {
    std::vector<double> numbers;
    for (const auto& m : finder.find())
      for (int k = 0; k < m.count; ++k) {
        numbers.push_back(m.points[static_cast<std::size_t>(k)].gap);
        for (int i = 0; i < 3; ++i) numbers.push_back(m.points[static_cast<std::size_t>(k)].position[i]);
      }
    return numbers;
  };
  const auto before = gaps_and_points();
  ASSERT_FALSE(before.empty());
  for (const int id : {low, high}) finder.set_moves(id, false);
  EXPECT_TRUE(gaps_and_points().empty());
  finder.set_moves(low, true);
  EXPECT_EQ(gaps_and_points(), before);
  finder.forget();
  EXPECT_NE(gaps_and_points(), before);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DisturbedPile, testing::Values(1, 2, 4));

TEST(FreezingPile, GivesTheSameBitsOnAnyNumberOfThreads) {
  constexpr int rocks = 60, steps = 400;
  support::BladePile one(rocks, freezing_options(), turns, pushed_about);
  one.run(steps);
  const auto expected = frozen(one.world());
  const auto count = std::count(expected.begin(), expected.end(), true);
  EXPECT_GT(count, 5);
  EXPECT_LT(count, rocks - 5);
  for (const int threads : {2, 3}) {
    support::BladePile other(rocks, freezing_options(threads), turns, pushed_about);
    other.run(steps);
    EXPECT_EQ(engine::state_hash(other.world()), engine::state_hash(one.world()));
    EXPECT_EQ(frozen(other.world()), expected) << threads << " threads";
  }
}

// Saved while some are frozen, some awake and some about to be thawed by a removal. The contacts that the
// frozen ones will stand on when they wake are part of the state.
TEST(FreezingPile, GoesOnFromAStateInMidRunWithTheSameBits) {
  constexpr int rocks = 60, steps = 300;
  support::BladePile original(rocks, freezing_options(), turns, pushed_about);
  original.run(steps);
  const auto before = frozen(original.world());
  int removed = 0;  // three, so that others that stood on them wake
  for (int rock = 0; rock < rocks && removed < 3; ++rock)
    if (before[static_cast<std::size_t>(rock)]) original.world().remove_rock(rock), ++removed;
  const std::vector<std::byte> saved = original.world().save();
  support::BladePile fresh(rocks, freezing_options(2), turns, pushed_about);
  fresh.world().restore(saved);
  EXPECT_EQ(fresh.world().save(), saved);
  bool woke = false, froze = false;
  for (int k = 0; k < steps; ++k) {
    const auto was = frozen(original.world());
    original.run(1);
    fresh.run(1);
    const auto is = frozen(original.world());
    for (int r = 0; r < rocks; ++r) woke |= was[r] && !is[r], froze |= !was[r] && is[r];
    ASSERT_EQ(engine::state_hash(fresh.world()), engine::state_hash(original.world())) << "step " << k;
    ASSERT_EQ(frozen(fresh.world()), is) << "step " << k;
  }
  EXPECT_TRUE(woke && froze);
  original.world().thaw_all();
  fresh.world().thaw_all();
  original.run(5);
  fresh.run(5);
  EXPECT_EQ(engine::state_hash(fresh.world()), engine::state_hash(original.world()));
}
