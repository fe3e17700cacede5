// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A log survives the disk bit for bit, and so do its responses.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/log/scene_motion.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <drawpoint/tests/support/told.hpp>
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
  cycle.number = 1;  // that of the pictures
  cycle.t_start = 30.0 * number;
  cycle.t_end = cycle.t_start + 20 + value(bits);
  cycle.loaded_mass = 1000 * value(bits);
  cycle.left_out_time = 0.1 * number;
  cycle.left_out_energy = 10.0 * number;
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
                         {"hinge_G_torque_y", "N m", "about the pin"},
                         {"hinge_G_torque_z", "N m"}};
  for (int k = 1; k < 8000; ++k)
    log.signals.append_row(
        std::vector<double>{0.01 * k, k < 3000 ? 1.0 : 2.0, torque(bits), torque(bits), torque(bits)});
  log.cycles = {example_cycle(bits, 0), example_cycle(bits, 1)};
  log.scene.shapes = {engine::box({1, 2, 3}), engine::prism(1, 0.5, 8)};
  log.scene.bodies = {{0, "#e0b040", 1.0, "boom"}, {1, "#303030", 0.5, "front left wheel", 42.5}};
  for (int k = 0; k < 3; ++k) {
    log.scene.frames.push_back({0.5 * k, 1, "lift", 1000.5 * k});
    log.scene.knots.push_back({0, k, {0.25f * static_cast<float>(k), 1, 2, 1, 0, 0, 0}});
  }
  log.scene.bodies.push_back({0, "#ffffff", 1.0, "pin of the boom"});
  log.scene.bodies.back().with = 0;
  log.scene.knots.push_back({1, 0, {1, 2, 3, 0.6f, 0.8f, 0, 0}});
  log.scene.knots.push_back({1, 2, hidden_pose});
  return log;
}

// Paths of all arrays: what has no children, but for the two groups of numbers and texts, which each log names
// as it likes.
std::vector<std::string> arrays_below(const record::Reader& file, const std::string& group) {
  std::vector<std::string> paths;
  for (const std::string& name : file.children(group)) {
    const std::string path = group.empty() ? name : group + "/" + name;
    if (path == "numbers" || path == "texts") continue;
    const std::vector<std::string> below = arrays_below(file, path);
    paths.insert(paths.end(), below.begin(), below.end());
    if (below.empty()) paths.push_back(path);
  }
  return paths;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same(const CycleRecord& a, const CycleRecord& b) {
  EXPECT_EQ(a.t_start, b.t_start);
  EXPECT_EQ(a.t_end, b.t_end);
  EXPECT_EQ(a.left_out_time, b.left_out_time);
  EXPECT_EQ(a.left_out_energy, b.left_out_energy);
  EXPECT_EQ(a.loaded_mass, b.loaded_mass);
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
  EXPECT_EQ(back.signals.columns[3].description, "about the pin");
  ASSERT_EQ(back.cycles.size(), 2u);
  for (int k = 0; k < 2; ++k) expect_same(back.cycles[k], log.cycles[k]);
  EXPECT_EQ(production(back), production(log));
  EXPECT_EQ(joint_damage(back), joint_damage(log));
  EXPECT_EQ(rock_spill(back), rock_spill(log));
}

TEST(LoadingLog, IsReadWithoutItsScene) {
  const Folder folder;
  const LoadingLog log = example_log();
  write_log(folder.path / "run.h5", log);
  const LoadingLog back = read_log(folder.path / "run.h5", LogContent::without_scene);
  EXPECT_TRUE(same_bits(back.signals.values, log.signals.values));
  ASSERT_EQ(back.cycles.size(), 2u);
  for (int k = 0; k < 2; ++k) expect_same(back.cycles[k], log.cycles[k]);
  EXPECT_EQ(joint_damage(back), joint_damage(log));
  EXPECT_TRUE(back.scene.bodies.empty() && back.scene.shapes.empty() && back.scene.knots.empty());
  EXPECT_EQ(back.scene.frames.size(), log.scene.frames.size());
}

TEST(LoadingLog, KeepsTheScene) {
  const Folder folder;
  const LoadingLog log = example_log();
  write_log(folder.path / "run.h5", log);
  const SceneRecord scene = read_log(folder.path / "run.h5").scene;
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_NEAR(scene.shapes[0].volume(), 48, 1e-12);
  EXPECT_EQ(scene.shapes[1].faces().size(), 10u);
  ASSERT_EQ(scene.bodies.size(), 3u);
  EXPECT_EQ(scene.bodies[1].with, -1);
  EXPECT_EQ(scene.bodies[2].with, 0);
  EXPECT_EQ(scene.bodies[1].name, "front left wheel");
  EXPECT_EQ(scene.bodies[1].color, "#303030");
  EXPECT_EQ(scene.bodies[1].opacity, 0.5);
  EXPECT_EQ(scene.bodies[1].mass, 42.5);
  EXPECT_TRUE(std::isnan(scene.bodies[0].mass));
  ASSERT_EQ(scene.frames.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(scene.frames[k].t, 0.5 * k);
    EXPECT_EQ(scene.frames[k].label, "lift");
    EXPECT_EQ(scene.frames[k].bucket_mass, 1000.5 * k);
  }
  ASSERT_EQ(scene.knots.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(scene.knots[k].body, log.scene.knots[k].body);
    EXPECT_EQ(scene.knots[k].frame, log.scene.knots[k].frame);
    EXPECT_EQ(std::memcmp(&scene.knots[k].pose, &log.scene.knots[k].pose, sizeof(ScenePose)), 0);
  }
}

// Who opens the file in another program finds at every array what it is; a table's lists of names, units and
// descriptions are that themselves.
TEST(LoadingLog, EveryArraySaysWhatItIs) {
  const Folder folder;
  write_log(folder.path / "run.h5", example_log());
  const record::Reader file(folder.path / "run.h5", {"drawpoint loading log", 9});
  const std::vector<std::string> arrays = arrays_below(file, "");
  EXPECT_EQ(arrays.size(), 4u + 2 * (11 + 3 + 13) + 2 + 6 + 4 + 3)
      << "signals, two cycles, shapes, bodies, frames, motion";
  for (const std::string& path : arrays) {
    const std::string name = path.substr(path.rfind('/') + 1);
    if (name == "columns" || name == "units" || name == "descriptions") continue;
    const std::vector<std::string> said = file.attributes(path);
    ASSERT_GE(said.size(), 2u) << path;
    EXPECT_NE(file.text(path, "unit"), "") << path;
    EXPECT_NE(file.text(path, "description"), "") << path;
  }
  EXPECT_EQ(file.text("scene/motion/pose", "frame"),
            "world: x from the machine into the drift, y to the left, z up, floor at z = 0");
  EXPECT_EQ(file.text("cycles/0001/column_heights_m", "unit"), "m");
  EXPECT_EQ(file.text("cycles/0001/loaded_mass_kg", "unit"), "kg");
  EXPECT_EQ(file.text("numbers/density", "unit"), "kg/m³");
  EXPECT_EQ(file.doubles("numbers/density").values, std::vector<double>{4500});
  EXPECT_EQ(file.texts("texts/machine"), std::vector<std::string>{"LH621 class"});
}

// As version 4 wrote it: numbers and texts as attributes, no descriptions, no masses. What is missing is not a
// number.
TEST(LoadingLog, OfTheVersionBeforeIsRead) {
  const Folder folder;
  record::Writer file(folder.path / "old.h5", {"drawpoint loading log", 4});
  file.integer("/", "completed", 1);
  file.text("/", "message", "");
  file.number("numbers", "density", 4500);
  file.text("texts", "machine", "LH621 class");
  file.number("cycles/0000", "loaded_mass_kg", 3000);
  for (const char* name : {"t_start_s", "t_end_s"}) file.number("cycles/0000", name, 1);
  file.integer("cycles/0000", "number", 1);
  for (const char* name :
       {"loaded_rock_masses_kg", "planned_x_m", "planned_z_m", "contour_x_m", "contour_z_m"})
    file.array("cycles/0000/" + std::string(name), std::span<const double>());
  file.array("cycles/0000/column_heights_m", std::span<const double>(), {0, 0});
  file.table("cycles/0000/stages", {});
  for (const char* name : {"y_m", "depth_m", "height_m", "tilt_rad", "slope_rad", "toe_m", "volume_centre_m",
                           "crest_m", "height_limit_m", "area_m2", "phi_max_rad"})
    file.number("cycles/0000/plan", name, 0.5);
  file.text("cycles/0000/plan", "message", "");
  for (const char* name : {"feasible", "limited", "row", "curl", "lift"})
    file.integer("cycles/0000/plan", name, 0);
  file.array("cycles/0000/plan/corners_x_z_phi", std::span<const double>(std::vector<double>(15)), {5, 3});
  file.texts("signals/columns", {"time"});
  file.texts("signals/units", {"s"});
  file.array("signals/values", std::span<const double>(std::vector<double>{0.01, 0.02}), {2, 1});
  file.array("scene/shapes/0000",
             std::span<const double>(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}), {4, 3});
  file.array("scene/bodies/shape", std::span<const std::int32_t>(std::vector<std::int32_t>{0}));
  file.array("scene/bodies/opacity", std::span<const double>(std::vector<double>{1}));
  file.texts("scene/bodies/color", {"#808080"});
  file.texts("scene/bodies/name", {"rock"});
  file.array("scene/frames/t_s", std::span<const double>(std::vector<double>{0.5}));
  file.array("scene/frames/cycle", std::span<const std::int32_t>(std::vector<std::int32_t>{1}));
  file.texts("scene/frames/label", {"lift"});
  file.array("scene/frames/poses", std::span<const float>(std::vector<float>{1, 2, 3, 1, 0, 0, 0}),
             {1, 7, 1});
  file.commit();
  const LoadingLog log = read_log(folder.path / "old.h5");
  EXPECT_EQ(log.signals.columns.front().name, "time");
  EXPECT_EQ(log.signals.columns.front().description, "");
  EXPECT_EQ(log.numbers.at("density"), 4500);
  EXPECT_EQ(log.texts.at("machine"), "LH621 class");
  ASSERT_EQ(log.cycles.size(), 1u);
  EXPECT_EQ(log.cycles.front().loaded_mass, 3000);
  EXPECT_EQ(log.cycles.front().plan.depth, 0.5);
  EXPECT_EQ(log.signals.values, (std::vector<double>{0.01, 0.02}));
  ASSERT_EQ(log.scene.bodies.size(), 1u);
  EXPECT_TRUE(std::isnan(log.scene.bodies.front().mass));
  ASSERT_EQ(log.scene.frames.size(), 1u);
  EXPECT_TRUE(std::isnan(log.scene.frames.front().bucket_mass));
  ASSERT_EQ(log.scene.knots.size(), 1u);
  EXPECT_EQ(log.scene.knots.front().pose, (ScenePose{1, 2, 3, 1, 0, 0, 0}));
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
  log.scene.knots[1].frame = 3;
  EXPECT_THROW(write_log(folder.path / "run.h5", log), std::invalid_argument);
  log = example_log();
  log.scene.bodies[2].with = 3;
  EXPECT_THROW(write_log(folder.path / "run.h5", log), std::invalid_argument);
  log = example_log();
  log.scene.bodies[0].shape = 7;
  EXPECT_THROW(write_log(folder.path / "run.h5", log), std::invalid_argument);
  log = example_log();
  log.cycles[0].columns_x = 5;
  EXPECT_THROW(write_log(folder.path / "run.h5", log), std::invalid_argument);
  EXPECT_TRUE(fs::is_empty(folder.path));
}

// A log of one body and one frame without cycles, as another program might write it: sound but for what
// `spoil` changes.
struct ForeignLog {
  std::vector<std::int32_t> shape{0}, cycle{1};
  std::vector<double> opacity{1}, t{0.5}, vertices{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::vector<std::string> color{"#808080"}, name{"boom"}, label{"lift"};
  std::vector<float> poses = std::vector<float>(7);
  std::vector<std::size_t> extents{1, 7, 1};

  void write(const fs::path& path) const {
    record::Writer file(path, {"drawpoint loading log", 4});
    file.integer("/", "completed", 1);
    file.text("/", "message", "");
    for (const char* group : {"numbers", "texts", "cycles"}) file.group(group);
    file.table("signals", {});
    file.array("scene/shapes/0000", std::span<const double>(vertices));
    file.array("scene/bodies/shape", std::span<const std::int32_t>(shape));
    file.array("scene/bodies/opacity", std::span<const double>(opacity));
    file.texts("scene/bodies/color", color);
    file.texts("scene/bodies/name", name);
    file.array("scene/frames/t_s", std::span<const double>(t));
    file.array("scene/frames/cycle", std::span<const std::int32_t>(cycle));
    file.texts("scene/frames/label", label);
    file.array("scene/frames/poses", std::span<const float>(poses), extents);
    file.commit();
  }
};

TEST(LoadingLog, FramesThatDoNotFitTheBodiesAreRefused) {
  const Folder folder;
  const fs::path path = folder.path / "foreign.h5";
  ForeignLog().write(path);
  ASSERT_EQ(read_log(path).scene.frames.size(), 1u);
  struct Case {
    std::string words;
    void (*spoil)(ForeignLog&);
  };
  const std::vector<Case> cases{{"scene/frames/poses",
                                 [](ForeignLog& l) {
                                   l.poses.resize(6), l.extents = {1, 6, 1};
                                 }},
                                {"scene/frames/poses",
                                 [](ForeignLog& l) {
                                   l.poses.clear(), l.extents = {0, 7, 1};
                                 }},
                                {"scene/frames/poses",
                                 [](ForeignLog& l) {
                                   l.poses.resize(14), l.extents = {2, 7, 1};
                                 }},
                                {"scene/frames/cycle", [](ForeignLog& l) { l.cycle.clear(); }},
                                {"scene/frames/label", [](ForeignLog& l) { l.label.push_back("more"); }},
                                {"scene/bodies/opacity", [](ForeignLog& l) { l.opacity.clear(); }},
                                {"scene/bodies/color", [](ForeignLog& l) { l.color.clear(); }},
                                {"scene/bodies/name", [](ForeignLog& l) { l.name.push_back("more"); }},
                                {"scene/bodies/shape", [](ForeignLog& l) { l.shape[0] = 1; }},
                                {"scene/bodies/shape", [](ForeignLog& l) { l.shape[0] = -1; }},
                                {"scene/shapes/0000", [](ForeignLog& l) { l.vertices.resize(11); }}};
  for (const Case& c : cases) {
    ForeignLog log;
    c.spoil(log);
    log.write(path);
    support::expect_told<std::runtime_error>([&] { read_log(path); }, {"foreign.h5", c.words});
  }
}

// The plan's corners, the column heights and the stages of a cycle.
TEST(LoadingLog, CyclesThatDoNotFitAreRefused) {
  const Folder folder;
  const fs::path path = folder.path / "foreign.h5";
  const auto write_cycle = [&](std::size_t corners, const std::vector<std::size_t>& columns, double stage) {
    record::Writer file(path, {"drawpoint loading log", 4});
    file.integer("/", "completed", 1);
    file.text("/", "message", "");
    for (const char* group : {"numbers", "texts", "scene/shapes"}) file.group(group);
    file.table("signals", {});
    const std::string cycle = "cycles/0000", plan = cycle + "/plan";
    file.integer(cycle, "number", 1);
    for (const char* name : {"t_start_s", "t_end_s", "loaded_mass_kg"}) file.number(cycle, name, 1);
    for (const char* name :
         {"loaded_rock_masses_kg", "planned_x_m", "planned_z_m", "contour_x_m", "contour_z_m"})
      file.array(cycle + "/" + name, std::span<const double>());
    const std::vector<double> heights(6), poses(corners);
    file.array(cycle + "/column_heights_m", std::span(heights), columns);
    record::Table stages;
    for (const char* name : {"stage", "reason", "t_start", "t_end", "progress", "start_x", "start_z",
                             "start_phi", "end_x", "end_z", "end_phi"})
      stages.columns.push_back({name, "1"});
    stages.values.assign(11, 0);
    stages.values[0] = stage;
    file.table(cycle + "/stages", stages);
    for (const char* name : {"y_m", "depth_m", "height_m", "tilt_rad", "slope_rad", "toe_m",
                             "volume_centre_m", "crest_m", "height_limit_m", "area_m2", "phi_max_rad"})
      file.number(plan, name, 1);
    file.text(plan, "message", "");
    for (const char* name : {"feasible", "limited", "row", "curl", "lift"}) file.integer(plan, name, 0);
    file.array(plan + "/corners_x_z_phi", std::span<const double>(poses));
    for (const char* name : {"shape", "cycle"})
      file.array(std::string(name[0] == 's' ? "scene/bodies/" : "scene/frames/") + name,
                 std::span<const std::int32_t>());
    for (const char* name : {"scene/bodies/opacity", "scene/frames/t_s"})
      file.array(name, std::span<const double>());
    for (const char* name : {"scene/bodies/color", "scene/bodies/name", "scene/frames/label"})
      file.texts(name, {});
    file.array("scene/frames/poses", std::span<const float>(), {0, 0, 7});
    file.commit();
  };
  const std::size_t corners = 3 * Plan().corners.size();
  write_cycle(corners, {2, 3}, 1);
  ASSERT_EQ(read_log(path).cycles.at(0).columns_x, 3);
  const auto expect_refused = [&](const std::string& words) {
    support::expect_told<std::runtime_error>([&] { read_log(path); }, {"foreign.h5", words});
  };
  write_cycle(corners - 1, {2, 3}, 1);
  expect_refused("corners_x_z_phi");
  write_cycle(corners + 3, {2, 3}, 1);
  expect_refused("corners_x_z_phi");
  write_cycle(corners, {6}, 1);
  expect_refused("column_heights_m");
}

}  // namespace
