// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Rock that lies where it should not, in a scene of cubes whose masses are counted by hand.
#include <gtest/gtest.h>

#include <drawpoint/engine/loading/lhd.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/log/rock_left.hpp>
#include <stdexcept>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

constexpr double mass = 125;

struct CubeScene {
  LoadingLog log;

  CubeScene() {
    log.numbers = {{"bucket_width", BucketOptions{}.width},
                   {"bucket_heaped_volume", heaped_volume({})},
                   {"drift_length", 20},
                   {"drift_width", 6}};
    log.cycles.resize(1);
    log.cycles[0].number = 1;
    log.cycles[0].plan.y = 0;
    log.scene.shapes = {box({0.25, 0.25, 0.25})};
    log.scene.frames = {{.t = 1, .cycle = 1, .label = "end of cycle", .bucket_mass = 0}};
  }
  void add(const char* name, const Eigen::Vector3d& p, double of_rock) {
    log.scene.knots.push_back(
        {static_cast<int>(log.scene.bodies.size()),
         0,
         {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 1}});
    log.scene.bodies.push_back({.shape = 0, .name = name, .mass = of_rock});
  }
  void add_rock(double x, double y, double z = 0.25) { add("rock", {x, y, z}, mass); }
  /// From x = 14 to the back wall at 20, over the whole breadth; without one cube.
  void add_pile(double gap_x, double gap_y) {
    for (double x = 14.25; x < 20; x += 0.5)
      for (double y = -2.75; y < 3; y += 0.5)
        if (x != gap_x || y != gap_y) add_rock(x, y);
  }
};

}  // namespace

// Two strays lie before the pile, one of them in the lane of 3.2 m about y = 0. Read literally, the front of the strips
// with a gap at x = 16 to 16.5 is there: the four cubes before it count too. What the bucket holds counts for nothing.
TEST(RockLeft, IsCountedInTheLaneAndBeforeTheLiteralFront) {
  CubeScene scene;
  scene.add_pile(16.25, 0.75);
  scene.add_rock(10, 0);
  scene.add_rock(10, 2.5);
  const Lhd lhd = sandvik_lh621();
  const Eigen::Vector3d carried(5, 0, 0);
  scene.add("bucket", lhd.spec.bodies[static_cast<std::size_t>(lhd.bucket)].centre + carried, std::nan(""));
  scene.add_rock(3.0 + carried.x(), 0, 0.5);
  EXPECT_DOUBLE_EQ(rock_left(scene.log).in_lane, mass);
  EXPECT_DOUBLE_EQ(rock_left(scene.log).before_front, 6 * mass);
  const SpillOptions as_printed{.m_max = 1000, .law = SpillLaw::before_front};
  EXPECT_DOUBLE_EQ(rock_spill(scene.log, as_printed), rock_left(scene.log).before_front / 1000);
}

TEST(RockLeft, OfAWholePileIsNone) {
  CubeScene scene;
  scene.add_pile(0, 0);
  scene.add("bucket", {0, 0, 1}, std::nan(""));
  EXPECT_EQ(rock_left(scene.log).in_lane, 0);
  EXPECT_EQ(rock_left(scene.log).before_front, 0);
}

TEST(RockLeft, NeedsPictures) {
  CubeScene scene;
  scene.add("bucket", {0, 0, 1}, std::nan(""));
  scene.log.scene.knots.clear();
  try {
    rock_left_by_cycle(scene.log);
    FAIL() << "taken without pictures";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "loading::rock_left: the log has no pictures of cycle 1; read it with its scene");
  }
}
