// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What a log keeps of the motion in a scene shows every sample within the tolerance, and a log of thirty cycles
// with four thousand rocks is small.
#include <gtest/gtest.h>
#include <unistd.h>
#include <drawpoint/engine/loading/log/scene_motion.hpp>

#include <cmath>
#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <filesystem>
#include <random>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

constexpr MotionTolerance rocks{0.02, 0.02};

ScenePose pose_of(const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  const Eigen::Vector3f f = p.cast<float>();
  const Eigen::Quaternionf r = q.cast<float>();
  return {f.x(), f.y(), f.z(), r.w(), r.x(), r.y(), r.z()};
}

// Rests, is pushed along with a turn, falls, rolls, trembles at rest.
ScenePose rock_at(double t) {
  const double push = std::clamp(t - 2, 0.0, 3.0), fall = std::clamp(t - 5, 0.0, 0.5);
  const double tremble = t > 6 ? 1e-3 * std::sin(40 * t) : 0;
  const Eigen::Vector3d place(5 + 0.4 * push + tremble, 0.1 * push * push, 2 - 4.905 * fall * fall);
  const Eigen::AngleAxisd turn(0.9 * push + 6 * fall, Eigen::Vector3d(1, 2, 0.5).normalized());
  return pose_of(place, Eigen::Quaterniond(turn));
}

double dot(const ScenePose& a, const ScenePose& b) {
  return double(a[3]) * b[3] + double(a[4]) * b[4] + double(a[5]) * b[5] + double(a[6]) * b[6];
}

TEST(SceneMotion, EverySampleIsShownWithinTheTolerance) {
  SceneRecord scene;
  scene.bodies.resize(2);
  MotionRecorder motion(scene.knots);
  constexpr int frames = 200;
  for (int f = 0; f < frames; ++f) {
    scene.frames.push_back({0.05 * f, 1, "lift"});
    ScenePose pose = rock_at(0.05 * f);
    if (f % 2)
      for (std::size_t k = 3; k < 7; ++k) pose[k] = -pose[k];  // the same turn
    motion.add({0, f, pose}, 0.05 * f, rocks);
    motion.add({1, f, f < 50 ? hidden_pose : rock_at(0.05 * f)}, 0.05 * f, rocks);
  }
  motion.end();
  for (int f = 0; f < frames; ++f) {
    const ScenePose there = rock_at(0.05 * f);
    const auto shown = pose_in(scene, 0, f);
    ASSERT_TRUE(shown) << f;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((*shown)[k], there[k], rocks.place + 1e-6) << f;
    // Four components within 0.02 are within 0.04 of the quaternion, which is an arc of 2 asin(0.02), 0.0401,
    // and cos(0.0401) > 1 - 8.1e-4.
    EXPECT_GT(std::abs(dot(*shown, there)), 1 - 8.1e-4) << f;
    EXPECT_EQ(pose_in(scene, 1, f).has_value(), f >= 50) << f;
  }
  std::size_t of_first = 0;
  for (const SceneKnot& knot : scene.knots) of_first += knot.body == 0;
  EXPECT_LT(of_first, 60u);
}

TEST(SceneMotion, WhatTremblesWithinTheToleranceHasOnePosePerCycle) {
  SceneRecord scene;
  MotionRecorder motion(scene.knots);
  for (int cycle = 1; cycle <= 2; ++cycle) {
    for (int f = 0; f < 100; ++f)
      motion.add({0, 100 * (cycle - 1) + f, rock_at(6.5 + 0.05 * f)}, 20 * cycle + 0.05 * f, rocks);
    motion.end();
  }
  ASSERT_EQ(scene.knots.size(), 2u);
  EXPECT_EQ(scene.knots[1].frame, 100);
}

TEST(SceneMotion, WithoutAToleranceNothingIsLost) {
  SceneRecord scene;
  scene.bodies.resize(1);
  MotionRecorder motion(scene.knots);
  std::mt19937 bits(3);
  std::uniform_real_distribution<float> value(-1, 1);
  std::vector<ScenePose> all;
  for (int f = 0; f < 100; ++f) {
    scene.frames.push_back({0.05 * f, 1, "lift"});
    ScenePose pose = f % 10 < 5 && f > 0 ? all.back() : ScenePose{value(bits), value(bits), value(bits), 1};
    all.push_back(pose);
    motion.add({0, f, pose}, 0.05 * f, {});
  }
  motion.end();
  for (int f = 0; f < 100; ++f) EXPECT_EQ(pose_in(scene, 0, f), all[static_cast<std::size_t>(f)]) << f;
  EXPECT_LT(scene.knots.size(), 80u);
}

// A cycle of 12 s, of which half of the rocks move for 4 s, on a path with turns that shakes by a centimetre;
// in runs half of them leave their place by a hand's breadth. The machine's 16 bodies never go straight.
class BusyScene {
 public:
  BusyScene() {
    log.scene.shapes = {box({0.2, 0.2, 0.2})};
    log.scene.bodies.resize(bodies);
    std::mt19937 bits(5);
    std::uniform_real_distribution<double> share(0, 1);
    for (int b = 0; b < bodies; ++b) start_.push_back(8 * share(bits)), x_.push_back(20 * share(bits));
  }

  void add_cycle(int cycle) {
    for (int f = 0; f < 240; ++f) {
      const int number = static_cast<int>(log.scene.frames.size());
      const double t = 20.0 * cycle + 0.05 * f;
      log.scene.frames.push_back({t, cycle, "lift", 1.0 * f});
      for (int b = 0; b < bodies; ++b)
        motion_.add({b, number, rounded(pose(b, 0.05 * f, cycle), b >= machine)}, t,
                    b < machine ? fine : rocks);
    }
    motion_.end();
  }

  LoadingLog log;

 private:
  static constexpr int machine = 16, bodies = machine + 4000;
  static constexpr MotionTolerance fine{0.002, 0.002};

  ScenePose pose(int b, double t, int cycle) const {
    const auto k = static_cast<std::size_t>(b);
    const bool moves = b < machine || b % 2 == 0;
    const double s = b < machine ? t : moves ? std::clamp(t - start_[k], 0.0, 4.0) : 0;
    const double shake = s > 0 && s < 4 ? 0.01 * std::sin(37.0 * (t + b)) : 0;
    const Eigen::Vector3d place(x_[k] + 0.3 * s + (b < machine ? 0 : shake), cycle + 0.1 * std::sin(2 * s),
                                1 + 0.2 * std::sin(s + b) * s);
    const Eigen::AngleAxisd turn(b + 0.7 * s + 0.2 * std::sin(3 * s),
                                 Eigen::Vector3d(1, b % 7, 2).normalized());
    return pose_of(place, Eigen::Quaterniond(turn));
  }
  // As the recorder of a run does.
  static ScenePose rounded(ScenePose pose, bool is_rock) {
    for (std::size_t k = 0; k < pose.size(); ++k) {
      const float parts = is_rock ? 128 : k < 3 ? 1024 : 4096;
      pose[k] = std::round(pose[k] * parts) / parts;
    }
    return pose;
  }

  std::vector<double> start_, x_;
  MotionRecorder motion_{log.scene.knots};
};

double size_of(const LoadingLog& log) {
  const auto path =
      std::filesystem::temp_directory_path() / ("drawpoint_motion_" + std::to_string(::getpid()));
  write_log(path, log);
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::remove(path);
  return size;
}

// Of the 20 MB that a log of thirty cycles may take, signals at full rate take 0.13 MB per cycle: half a
// megabyte per cycle is left for the scene.
TEST(SceneMotion, ACycleWithFourThousandRocksTakesLessThanHalfAMegabyte) {
  BusyScene scene;
  scene.add_cycle(1);
  const double one = size_of(scene.log);
  scene.add_cycle(2);
  const double per_cycle = size_of(scene.log) - one;
  RecordProperty("bytes_per_cycle", std::to_string(per_cycle));
  RecordProperty("knots_per_cycle", std::to_string(scene.log.scene.knots.size() / 2));
  EXPECT_LT(per_cycle, 0.5e6);
}

}  // namespace
