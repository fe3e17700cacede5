// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Rocks come low over what already lies there, clear of it, at rest, and never above the top.
#include <gtest/gtest.h>

#include <drawpoint/engine/granular/pile.hpp>
#include <drawpoint/tests/support/rocks.hpp>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::granular;

namespace {

double radius(const engine::Rock& rock) {
  return std::get<engine::ConvexPolyhedron>(*rock.body.shape).radius();
}

struct Heap {
  explicit Heap(const EmitterOptions& o, std::uint64_t seed = 1)
      : options(o),
        world({}, support::one_material({.friction = 0.9, .rolling = 0.1})),
        emitter(o, 4500, seed) {
    world.add_static(support::shared(engine::HalfSpace{Eigen::Vector3d::UnitZ(), 0}),
                     Eigen::Isometry3d::Identity(), 0);
  }
  std::vector<int> emit(double mass) { return emitter.emit(world, library, specs, mass); }

  EmitterOptions options;
  engine::World world;
  Emitter emitter;
  RockLibrary library;
  std::vector<RockSpec> specs;
};

// The gap between the spheres of a rock and of the nearest of the others, or the floor [m].
double room_about(const engine::World& world, int k) {
  const engine::Rock& rock = world.rocks()[static_cast<std::size_t>(k)];
  double room = rock.pose.translation().z() - radius(rock);
  for (const engine::Rock& other : world.rocks())
    if (&other != &rock)
      room = std::min(
          room, (rock.pose.translation() - other.pose.translation()).norm() - radius(rock) - radius(other));
  return room;
}

}  // namespace

// A place's height leaves the clearance above the highest sphere below it; measured between spheres, which is
// along the line of centres and not straight down, the room is at most that, and above 0.
TEST(Emitter, LetsRocksGoLowAndClear) {
  Heap heap({.top = {0, 0, 6}, .radius = 1.8});
  std::size_t births = 0;
  for (int step = 0; step < 400; ++step) {
    for (int k : heap.emit(1e9)) {
      ++births;
      const engine::Rock& rock = heap.world.rocks()[static_cast<std::size_t>(k)];
      EXPECT_GT(room_about(heap.world, k), 0) << k;
      EXPECT_LE(room_about(heap.world, k), heap.options.clearance + 1e-12) << k;
      EXPECT_EQ(rock.velocity.norm(), 0) << k;
      EXPECT_LE(rock.pose.translation().head<2>().norm(), heap.options.radius + 1e-12) << k;
    }
    heap.world.step();
  }
  // Nine places (-1, 0, 1 along both axes), a layer every half second of the 4 s, from the first step on.
  EXPECT_EQ(births, 9u * 8u);
}

TEST(Emitter, StopsAtTheTop) {
  Heap heap({.top = {0, 0, 1.0}, .radius = 0.5, .interval = 0.2});
  for (int step = 0; step < 400; ++step) {
    for (int k : heap.emit(1e9))
      EXPECT_LE(heap.world.rocks()[static_cast<std::size_t>(k)].pose.translation().z(), 1.0);
    heap.world.step();
  }
  EXPECT_GT(heap.specs.size(), 1u);
}

// The mass asked for, and at most the last rock more; nothing when none is asked for.
TEST(Emitter, KeepsToTheMass) {
  Heap heap({.top = {0, 0, 6}, .radius = 1.8});
  EXPECT_TRUE(heap.emit(0).empty());
  const std::vector<int> born = heap.emit(300);
  double mass = 0, last = 0;
  for (int k : born) mass += last = heap.world.rocks()[static_cast<std::size_t>(k)].body.mass;
  EXPECT_GE(mass, 300);
  EXPECT_LT(mass - last, 300);
}

TEST(Emitter, SameSeedSameRocks) {
  Heap a({.top = {0, 0, 6}}, 5), b({.top = {0, 0, 6}}, 5), c({.top = {0, 0, 6}}, 6);
  const auto poses = [](Heap& heap) {
    heap.emit(1e9);
    std::vector<Eigen::Matrix4d> all;
    for (const engine::Rock& rock : heap.world.rocks()) all.push_back(rock.pose.matrix());
    return all;
  };
  const auto first = poses(a);
  EXPECT_EQ(first, poses(b));
  EXPECT_NE(first, poses(c));
}
