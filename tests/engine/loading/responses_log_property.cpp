// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A log survives the disk bit for bit, and so do its responses.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <drawpoint/engine/loading/responses.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("drawpoint_log_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

CycleRecord example_cycle(std::mt19937& bits, int number) {
  std::uniform_real_distribution<double> value(0, 10);
  CycleRecord cycle;
  cycle.t_start = 30.0 * number;
  cycle.t_end = cycle.t_start + 20 + value(bits);
  cycle.loaded_mass = 1000 * value(bits);
  cycle.spilled_mass = 100 * value(bits);
  for (int k = 0; k < 5; ++k) cycle.loaded_rock_masses.push_back(value(bits));
  cycle.plan.feasible = true;
  cycle.plan.message = "as planned";
  cycle.plan.row = number;
  cycle.plan.depth = value(bits);
  cycle.plan.height = value(bits);
  cycle.plan.height_limit = std::numeric_limits<double>::infinity();
  cycle.plan.limited = number == 1;
  cycle.plan.curl = CurlMode::tip_fixed;
  for (TipPose& corner : cycle.plan.corners) corner = {value(bits), value(bits), value(bits)};
  cycle.stages = {{Stage::drive_in, StageEnd::timeout, 1, 2, 0.7, {1, 2, 3}, {4, 5, 6}},
                  {Stage::curl, StageEnd::slow_actuator, 2, 3, 0.2, {4, 5, 6}, {7, 8, 9}}};
  for (int k = 0; k < 4; ++k) {
    cycle.planned_x.push_back(value(bits));
    cycle.planned_z.push_back(value(bits));
    cycle.contour_x.push_back(value(bits));
    cycle.contour_z.push_back(value(bits));
  }
  cycle.columns_x = 3;
  cycle.columns_y = 2;
  for (int k = 0; k < 6; ++k) cycle.column_heights.push_back(value(bits));
  return cycle;
}

LoadingLog example_log() {
  std::mt19937 bits(8);
  std::uniform_real_distribution<double> torque(-400e3, 400e3);
  LoadingLog log;
  log.completed = true;
  log.message = "ein Satz mit Ä und ρ";
  log.numbers = {{"alpha", 0.1}, {"density", 4500}, {"nothing", std::nan("")}};
  log.texts = {{"machine", "LH621 class"}, {"empty", ""}};
  log.signals.columns = {{"time", "s"},
                         {"cycle", "1"},
                         {"hinge_G_torque_x", "N m"},
                         {"hinge_G_torque_y", "N m"},
                         {"hinge_G_torque_z", "N m"}};
  for (int k = 1; k < 8000; ++k)
    log.signals.append_row(
        std::vector<double>{0.01 * k, k < 3000 ? 1.0 : 2.0, torque(bits), torque(bits), torque(bits)});
  log.cycles = {example_cycle(bits, 0), example_cycle(bits, 1)};
  log.scene.shapes = {engine::box({1, 2, 3}), engine::prism(1, 0.5, 8)};
  log.scene.bodies = {{0, "#e0b040", 1.0, "boom"}, {1, "#303030", 0.5, "front left wheel"}};
  for (int k = 0; k < 3; ++k) {
    SceneFrame frame{0.5 * k, 1, "lift", std::vector<float>(14, 0.25f * static_cast<float>(k))};
    frame.poses[13] = std::numeric_limits<float>::quiet_NaN();
    log.scene.frames.push_back(frame);
  }
  return log;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same(const CycleRecord& a, const CycleRecord& b) {
  EXPECT_EQ(a.t_start, b.t_start);
  EXPECT_EQ(a.t_end, b.t_end);
  EXPECT_EQ(a.loaded_mass, b.loaded_mass);
  EXPECT_EQ(a.spilled_mass, b.spilled_mass);
  EXPECT_EQ(a.loaded_rock_masses, b.loaded_rock_masses);
  EXPECT_EQ(a.planned_x, b.planned_x);
  EXPECT_EQ(a.planned_z, b.planned_z);
  EXPECT_EQ(a.contour_x, b.contour_x);
  EXPECT_EQ(a.contour_z, b.contour_z);
  EXPECT_EQ(a.columns_x, b.columns_x);
  EXPECT_EQ(a.columns_y, b.columns_y);
  EXPECT_EQ(a.column_heights, b.column_heights);
  EXPECT_EQ(a.plan.feasible, b.plan.feasible);
  EXPECT_EQ(a.plan.message, b.plan.message);
  EXPECT_EQ(a.plan.row, b.plan.row);
  EXPECT_EQ(a.plan.depth, b.plan.depth);
  EXPECT_EQ(a.plan.height, b.plan.height);
  EXPECT_EQ(a.plan.height_limit, b.plan.height_limit);
  EXPECT_EQ(a.plan.limited, b.plan.limited);
  EXPECT_EQ(a.plan.curl, b.plan.curl);
  for (std::size_t k = 0; k < a.plan.corners.size(); ++k) {
    EXPECT_EQ(a.plan.corners[k].x, b.plan.corners[k].x);
    EXPECT_EQ(a.plan.corners[k].phi, b.plan.corners[k].phi);
  }
  ASSERT_EQ(a.stages.size(), b.stages.size());
  for (std::size_t k = 0; k < a.stages.size(); ++k) {
    EXPECT_EQ(a.stages[k].stage, b.stages[k].stage);
    EXPECT_EQ(a.stages[k].reason, b.stages[k].reason);
    EXPECT_EQ(a.stages[k].progress, b.stages[k].progress);
    EXPECT_EQ(a.stages[k].start.x, b.stages[k].start.x);
    EXPECT_EQ(a.stages[k].end.phi, b.stages[k].end.phi);
  }
}

TEST(LoadingLog, AnOldNameOfThePilesProvenanceIsRead) {
  const Folder folder;
  LoadingLog log = example_log();
  log.texts["pile_recipe"] = "length 30";
  write_log(folder.path / "run.h5", log);
  const LoadingLog back = read_log(folder.path / "run.h5");
  EXPECT_EQ(back.texts.at("pile_provenance"), "length 30");
  EXPECT_FALSE(back.texts.count("pile_recipe"));
}

TEST(LoadingLog, SurvivesTheDisk) {
  const Folder folder;
  const LoadingLog log = example_log();
  write_log(folder.path / "run.h5", log);
  const LoadingLog back = read_log(folder.path / "run.h5");
  EXPECT_EQ(back.completed, log.completed);
  EXPECT_EQ(back.message, log.message);
  EXPECT_EQ(back.texts, log.texts);
  EXPECT_EQ(back.numbers.size(), 3u);
  EXPECT_EQ(back.numbers.at("alpha"), 0.1);
  EXPECT_TRUE(std::isnan(back.numbers.at("nothing")));
  EXPECT_TRUE(same_bits(back.signals.values, log.signals.values));
  EXPECT_EQ(back.signals.columns[3].name, "hinge_G_torque_y");
  EXPECT_EQ(back.signals.columns[3].unit, "N m");
  ASSERT_EQ(back.cycles.size(), 2u);
  for (int k = 0; k < 2; ++k) expect_same(back.cycles[k], log.cycles[k]);
  EXPECT_EQ(production(back), production(log));
  EXPECT_EQ(joint_damage(back), joint_damage(log));
  EXPECT_EQ(rock_spill(back), rock_spill(log));
}

TEST(LoadingLog, KeepsTheScene) {
  const Folder folder;
  const LoadingLog log = example_log();
  write_log(folder.path / "run.h5", log);
  const SceneRecord scene = read_log(folder.path / "run.h5").scene;
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_NEAR(scene.shapes[0].volume(), 48, 1e-12);
  EXPECT_EQ(scene.shapes[1].faces().size(), 10u);
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[1].name, "front left wheel");
  EXPECT_EQ(scene.bodies[1].color, "#303030");
  EXPECT_EQ(scene.bodies[1].opacity, 0.5);
  ASSERT_EQ(scene.frames.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(scene.frames[k].t, 0.5 * k);
    EXPECT_EQ(scene.frames[k].label, "lift");
    EXPECT_TRUE(same_bits(scene.frames[k].poses, log.scene.frames[k].poses));
  }
}

TEST(LoadingLog, AnEmptyLogIsALog) {
  const Folder folder;
  LoadingLog log;
  log.message = "the pile did not come to rest";
  write_log(folder.path / "failed.h5", log);
  const LoadingLog back = read_log(folder.path / "failed.h5");
  EXPECT_FALSE(back.completed);
  EXPECT_EQ(back.message, log.message);
  EXPECT_TRUE(back.cycles.empty() && back.scene.bodies.empty() && back.signals.values.empty());
}

TEST(LoadingLog, EqualLogsAreEqualFiles) {
  const Folder folder;
  write_log(folder.path / "a.h5", example_log());
  write_log(folder.path / "b.h5", example_log());
  const auto bytes = [&](const char* name) {
    std::ifstream in(folder.path / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes("a.h5"), bytes("b.h5"));
}

TEST(LoadingLog, AContradictionIsNotWritten) {
  const Folder folder;
  LoadingLog log = example_log();
  log.scene.frames[1].poses.pop_back();
  EXPECT_THROW(write_log(folder.path / "run.h5", log), std::invalid_argument);
  log = example_log();
  log.scene.bodies[0].shape = 7;
  EXPECT_THROW(write_log(folder.path / "run.h5", log), std::invalid_argument);
  log = example_log();
  log.cycles[0].columns_x = 5;
  EXPECT_THROW(write_log(folder.path / "run.h5", log), std::invalid_argument);
  EXPECT_TRUE(fs::is_empty(folder.path));
}

}  // namespace
