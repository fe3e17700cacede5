// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/world/world_impl.h>
#include <cmath>
#include <drawpoint/tests/support/scenes.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

// Scenes of 0.3 m cubes (67.5 kg): their statics is known and they come to rest within a second.
using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;
using engine::WorldOptions;

namespace {

constexpr double side = 0.3, g = 9.81;

WorldOptions freezing_options() {
  WorldOptions options;
  options.freezing.on = true;
  return options;
}

World floor_world(const WorldOptions& options, double friction = 0.8) {
  World world(options, support::one_material({friction, 0.3, 1e9, 0}));
  support::add_floor(world);
  return world;
}

int add_cube(World& world, double x, double y, double z, const Vector3d& velocity = Vector3d::Zero()) {
  return world.add_rock(support::box_body(Vector3d::Constant(side / 2)), support::at(x, y, z), velocity);
}

void add_stack(World& world, int count, double x = 0) {
  for (int k = 0; k < count; ++k) add_cube(world, x, 0, side * (k + 0.5));
}

int frozen_count(const World& world) {
  int count = 0;
  for (std::size_t k = 0; k < world.rocks().size(); ++k) count += world.frozen(static_cast<int>(k));
  return count;
}

// Steps until all rocks are frozen; false after 5 s.
bool freeze_all(World& world) {
  for (int k = 0; k < 500; ++k) {
    world.step();
    if (frozen_count(world) == static_cast<int>(world.rocks().size())) return true;
  }
  return false;
}

bool same_bits(const World& a, const World& b) {
  for (std::size_t k = 0; k < a.rocks().size(); ++k) {
    const auto &p = a.rocks()[k], &q = b.rocks()[k];
    if (p.pose.matrix() != q.pose.matrix() || p.velocity != q.velocity ||
        p.angular_velocity != q.angular_velocity)
      return false;
  }
  return true;
}

std::string refusal(const engine::FreezingOptions& freezing) {
  WorldOptions options;
  options.freezing = freezing;
  try {
    World(options, support::one_material({.friction = 0.5}));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(Freezing, TakesRestingRocksOutOfTheProblem) {
  World world = floor_world(freezing_options());
  add_stack(world, 3);
  ASSERT_TRUE(freeze_all(world));
  const auto report = world.step();
  EXPECT_EQ(report.awake, 0);
  EXPECT_EQ(report.points, 0);
  EXPECT_EQ(world.problem().bodies.size(), 1u);  // the world
  EXPECT_EQ(world.kinetic_energy(), 0);
}

// A rock is frozen after `hold` at the earliest: the stack falls 1 mm first, so it cannot be still before.
TEST(Freezing, WaitsUntilTheRockHasStoodStill) {
  World world = floor_world(freezing_options());
  add_cube(world, 0, 0, side / 2 + 1e-3);
  while (frozen_count(world) == 0 && world.time() < 5) world.step();
  EXPECT_GE(world.time(), world.options().freezing.hold);
  EXPECT_LT(world.time(), 1);
}

// The impulses that are held balance every rock's weight: vertical force within `tolerance` of the load, at
// most the weight of the three cubes.
TEST(Freezing, HoldsImpulsesThatBalanceEveryRock) {
  World world = floor_world(freezing_options());
  add_stack(world, 3);
  ASSERT_TRUE(freeze_all(world));
  const double weight = world.rocks()[0].body.mass * g * world.options().step;
  std::vector<Vector3d> sum(3, Vector3d::Zero());
  const engine::detail::PairMemory& memory = engine::detail::WorldAccess::memory(world);
  for (const int slot : memory.held())
    for (int k = 0; k < 3; ++k) {
      if (world.rocks()[k].collider == memory.pair(slot).b) sum[k] += memory.load(slot).impulse;
      if (world.rocks()[k].collider == memory.pair(slot).a) sum[k] -= memory.load(slot).impulse;
    }
  for (const Vector3d& f : sum)
    EXPECT_LT((f - weight * Vector3d::UnitZ()).norm(), world.options().freezing.tolerance * 3 * weight);
}

// While nothing is frozen a world with freezing goes through the same bits as one without.
TEST(Freezing, ChangesNoBitUntilARockFreezes) {
  World on = floor_world(freezing_options()), off = floor_world({});
  for (World* world : {&on, &off}) {
    add_stack(*world, 2);
    add_cube(*world, 0.1, 0.05, 1.5);
  }
  int steps = 0;
  for (; frozen_count(on) == 0 && steps < 500; ++steps) {
    ASSERT_TRUE(same_bits(on, off)) << "step " << steps;
    on.step();
    off.step();
  }
  EXPECT_GT(steps, 20);
  EXPECT_GT(frozen_count(on), 0);
}

// Two steps: the cubes above a removed one fall in the very step that follows, v = -g h each, since the step
// that leaves one without support is solved again. Single precision of the solver: 1e-6 of 0.1 m/s, and the
// relaxation of overlaps below 1e-5 m over 20 ms: 5e-4 m/s.
TEST(Freezing, LetsRocksFallWhenTheirSupportGoes) {
  World world = floor_world(freezing_options());
  add_stack(world, 3);
  ASSERT_TRUE(freeze_all(world));
  world.remove_rock(0);
  world.step();
  for (int k : {1, 2}) {
    EXPECT_FALSE(world.frozen(k));
    EXPECT_NEAR(world.rocks()[k].velocity.z(), -g * world.options().step, 1e-3);
  }
}

// A throw's top: speed is near zero for some steps, but the rock carries no load and moves on.
TEST(Freezing, NeverFreezesInTheAir) {
  World world = floor_world(freezing_options());
  const int rock = add_cube(world, 0, 0, 0.5, Vector3d(0, 0, 2));
  bool landed = false;
  for (int k = 0; k < 300; ++k) {
    const double height = world.rocks()[rock].pose.translation().z();
    landed |= k > 50 && height < side / 2 + 1e-3;
    world.step();
    ASSERT_TRUE(landed || !world.frozen(rock)) << "at " << height << " m";
  }
  EXPECT_TRUE(landed);
  EXPECT_TRUE(world.frozen(rock));
}

// Without friction the floor takes no horizontal momentum. A cube of 1 m/s runs into a frozen one; the step
// of the impact is solved with both awake, so momentum stays to single precision and the far row of cubes
// stays frozen. An iteration rounds a velocity some twelve times at 6e-8 of it; 16 substeps of at most 20 000
// / 8 iterations make √(16 · 2500 · 12) · 6e-8 = 4e-5 in a step that does not converge; all 40 steps may: √40
// times that.
TEST(Freezing, WakesWhatIsHitAndKeepsMomentum) {
  World world = floor_world(freezing_options(), 0);
  const int target = add_cube(world, 0, 0, side / 2);
  for (int k = 0; k < 5; ++k) add_cube(world, 2.0 + 2 * side * k, 3, side / 2);
  ASSERT_TRUE(freeze_all(world));
  const int hammer = add_cube(world, -0.5, 0, side / 2, Vector3d(1, 0, 0));
  const double before = world.rocks()[hammer].body.mass;
  for (int k = 0; k < 40; ++k) world.step();
  EXPECT_FALSE(world.frozen(target));
  EXPECT_GT(world.rocks()[target].velocity.x(), 0.4);
  const double after = world.rocks()[target].body.mass *
                       (world.rocks()[target].velocity.x() + world.rocks()[hammer].velocity.x());
  EXPECT_NEAR(after, before, std::sqrt(40) * 4e-5 * before);
  EXPECT_EQ(frozen_count(world), 5);
}

// Thawed all at once, the pyramid starts from the impulses that it held: each cube off balance by at most
// `tolerance` of its load, at most 3 weights, in a step: v <= 0.1 * 3 * g h = 0.03 m/s.
TEST(Freezing, ThawsAWholePileWithoutAJump) {
  World world = floor_world(freezing_options());
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k < 3 - row; ++k) add_cube(world, 1.1 * side * (k + 0.5 * row), 0, side * (row + 0.5));
  ASSERT_TRUE(freeze_all(world));
  const auto before = world.rocks();
  world.thaw_all();
  EXPECT_EQ(frozen_count(world), 0);
  const double v = world.options().freezing.tolerance * 3 * g * world.options().step;
  for (int k = 0; k < 10; ++k) {
    world.step();
    EXPECT_LT(world.kinetic_energy(), 6 * 0.5 * before[0].body.mass * v * v);
  }
  EXPECT_GT(world.problem().points.size(), 0u);
}

// tan 40 deg is above the friction of 0.5: the cube slides and is not to be held.
TEST(Freezing, DoesNotHoldARockThatMustSlide) {
  WorldOptions options = freezing_options();
  options.gravity = support::tilted_gravity(40 * std::numbers::pi / 180);
  World world = floor_world(options, 0.5);
  add_cube(world, 0, 0, side / 2);
  for (int k = 0; k < 100; ++k) world.step();
  const double a = g * (std::sin(40 * std::numbers::pi / 180) - 0.5 * std::cos(40 * std::numbers::pi / 180));
  EXPECT_NEAR(world.rocks()[0].velocity.x(), a * 1.0, 0.02 * a);
}

TEST(Freezing, GivesTheSameBitsForAnyNumberOfThreads) {
  WorldOptions one = freezing_options(), three = freezing_options();
  three.threads = 3;
  World a = floor_world(one), b = floor_world(three);
  for (World* world : {&a, &b}) {
    add_stack(*world, 3);
    for (int k = 0; k < 4; ++k) add_cube(*world, 0.2 * k, 0.1 * k, 1.2 + 0.6 * k);
  }
  for (int k = 0; k < 200; ++k) {
    a.step();
    b.step();
    ASSERT_TRUE(same_bits(a, b)) << "step " << k;
    ASSERT_EQ(frozen_count(a), frozen_count(b));
  }
  EXPECT_GT(frozen_count(a), 0);
}

// Saved while some rocks are frozen and one is about to hit them.
TEST(Freezing, GoesOnFromASnapshotWithTheSameBits) {
  World a = floor_world(freezing_options()), b = floor_world(freezing_options());
  for (World* world : {&a, &b}) {
    add_stack(*world, 2);
    add_cube(*world, 0.05, 0.02, 2);
  }
  while (a.time() < 0.5) a.step();
  ASSERT_EQ(frozen_count(a), 2);
  b.restore(a.save());
  for (int k = 0; k < 100; ++k) {
    a.step();
    b.step();
    ASSERT_TRUE(same_bits(a, b)) << "step " << k;
    ASSERT_EQ(frozen_count(a), frozen_count(b)) << "step " << k;
  }
}

TEST(Freezing, RefusesOptionsOutOfRange) {
  EXPECT_EQ(refusal({.tolerance = 0}),
            "engine::Freezing: tolerance is 0.000000; allowed: above 0, at most 1 of the load that a rock "
            "carries");
  EXPECT_EQ(refusal({.hold = -1}), "engine::Freezing: hold [s] is -1.000000; allowed: above 0 s");
  EXPECT_NE(refusal({.distance = 0}), "");
  EXPECT_NE(refusal({.average = 0}), "");
  EXPECT_NE(refusal({.impact = 0.01}), "");
  EXPECT_EQ(refusal({.nudge = 0}), "engine::Freezing: nudge [m/s] is 0.000000; allowed: above 0 m/s");
  EXPECT_NE(refusal({.spread = -1}), "");
}

TEST(Freezing, RefusesTheStateOfAnotherWorld) {
  World three = floor_world(freezing_options());
  add_stack(three, 3);
  ASSERT_TRUE(freeze_all(three));
  const auto state = engine::detail::WorldAccess::freezing(three).state();
  engine::Freezing other = engine::detail::WorldAccess::freezing(three);
  const engine::detail::PairMemory& memory = engine::detail::WorldAccess::memory(three);
  EXPECT_EQ(memory.held().size(), 3u);
  EXPECT_NO_THROW(other.restore(state, memory));
  auto awake = state;
  awake.rocks[1].frozen = false;  // its contacts are held all the same
  EXPECT_THROW(other.restore(awake, memory), std::runtime_error);
  awake.rocks.pop_back();
  EXPECT_THROW(other.restore(awake, memory), std::runtime_error);
  for (int rock : {0, 1, 2}) EXPECT_TRUE(other.frozen(rock));
}
