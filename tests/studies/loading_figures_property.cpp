// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The figures of one loading run show all that its log has.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/loading/loading_figures.h>
#include <drawpoint/engine/loading/log/loading_log.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

using engine::loading::CycleRecord;
using engine::loading::LoadingLog;

constexpr int samples = 101;

/// One cycle of 10 s in which the torque of hinge G peaks at one sample, the 42nd.
LoadingLog log_with_a_peak() {
  LoadingLog log;
  log.completed = true;
  log.texts["arm_drive"] = "cylinders";
  for (const char* name : {"time", "cycle", "stage", "tip_x", "tip_y", "tip_z", "lift_force", "tilt_force",
                           "wheel_torque", "hinge_G_torque_x", "hinge_G_torque_y", "hinge_G_torque_z"})
    log.signals.columns.push_back({name, "1"});
  for (int i = 0; i < samples; ++i) {
    const double peak = i == 41 ? 300e3 : 10e3;
    log.signals.append_row(std::vector<double>{0.1 * i, 1.0, 1.0 + i / 26, 0.01 * i, 0.0, 0.0, 0.0, 0.0, 0.0,
                                               peak, 2 * peak, -peak});
  }
  CycleRecord cycle;
  cycle.number = 1;
  cycle.t_end = 10.0;
  log.cycles = {cycle};
  return log;
}

TEST(LoadingFigures, DrawEverySampleOfTorqueAndItsYieldLine) {
  const test::TestFolder place;
  write_log(place / "run.h5", log_with_a_peak());
  const auto figures = loading_figures(place / "run.h5");
  const auto forces =
      std::find_if(figures.begin(), figures.end(), [](const auto& f) { return f["type"] == "lines"; });
  ASSERT_NE(forces, figures.end());
  const auto& series = (*forces)["series"];
  ASSERT_EQ(series.size(), 6u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(series[k]["y"].size(), static_cast<std::size_t>(samples));
  EXPECT_NEAR(series[3]["y"][41].get<double>(), 300 * std::sqrt(6.0), 5e-4) << "(1, 2, -1) times 300 kN m";
  EXPECT_NEAR(series[4]["y"][41].get<double>(), 300 * std::sqrt(2.0), 5e-4)
      << "without the part about the pin";
  EXPECT_EQ(series[5]["y"], nlohmann::json({145.0, 145.0}));
  EXPECT_EQ(series[5]["x"], nlohmann::json({0.0, 10.0}));
}

// What damages a joint is the study's to say, and the line stands where damage begins.
TEST(LoadingFigures, DrawTheYieldTorqueOfTheStudy) {
  const test::TestFolder place;
  write_log(place / "run.h5", log_with_a_peak());
  const auto figures = loading_figures(place / "run.h5", {{"yield-torque", "450"}});
  const auto forces =
      std::find_if(figures.begin(), figures.end(), [](const auto& f) { return f["type"] == "lines"; });
  ASSERT_NE(forces, figures.end());
  EXPECT_EQ((*forces)["series"][5]["y"], nlohmann::json({450.0, 450.0}));
  EXPECT_NE((*forces)["caption"].get<std::string>().find("450 kN m"), std::string::npos);
}

TEST(LoadingFigures, TheSceneTellsTheStageAndTheRockInTheBucket) {
  const test::TestFolder place;
  LoadingLog log = log_with_a_peak();
  log.scene.frames = {{0.0, 1, "drive in", std::nan("")}, {0.5, 1, "curl", 3240.0}};
  write_log(place / "run.h5", log);
  for (const auto& figure : loading_figures(place / "run.h5")) {
    if (figure["type"] != "scene") continue;
    ASSERT_EQ(figure["frames"].size(), 2u);
    EXPECT_EQ(figure["frames"][0]["label"], "drive in") << "logs of version 4 do not know the mass";
    EXPECT_EQ(figure["frames"][1]["label"], "curl, 3.2 t in the bucket");
    EXPECT_EQ(figure["poster_frame"], 1);
    return;
  }
  FAIL() << "no scene";
}

// Frames of another cycle are left out, numbers of frames begin with the cycle's.
TEST(LoadingFigures, TheSceneHasTheMotionOfItsCycle) {
  const test::TestFolder place;
  LoadingLog log = log_with_a_peak();
  log.cycles[0].number = 2;
  for (std::size_t row = 0; row < log.signals.rows(); ++row) log.signals.values[row * 11 + 1] = 2;
  log.scene.shapes = {engine::box({1, 1, 1})};
  log.scene.bodies = {
      {0, "#aaaaaa", 1.0, "front unit"}, {0, "#bbbbbb", 1.0, "front unit"}, {0, "#808080", 1.0, ""}};
  log.scene.bodies[1].with = 0;
  log.scene.frames = {
      {0.0, 1, "lift"}, {0.0, 2, "lift"}, {0.05, 2, "curl"}, {0.1, 2, "curl"}, {0.15, 2, "curl"}};
  const float gone = std::nanf("");
  log.scene.knots = {{0, 0, {9, 9, 9, 1, 0, 0, 0}},
                     {0, 1, {1, 2, 3, 1, 0, 0, 0}},
                     {0, 4, {2, 2, 3, 1, 0, 0, 0}},
                     {2, 2, {0, 0, 0.5f, 0, 1, 0, 0}},
                     {2, 3, {gone, gone, gone, gone, gone, gone, gone}}};
  write_log(place / "run.h5", log);
  const auto figures = loading_figures(place / "run.h5");
  const auto scene =
      std::find_if(figures.begin(), figures.end(), [](const auto& f) { return f["type"] == "scene"; });
  ASSERT_NE(scene, figures.end());
  EXPECT_EQ((*scene)["frames"].size(), 4u);
  EXPECT_EQ((*scene)["follow"], 0);
  const auto& bodies = (*scene)["bodies"];
  EXPECT_EQ(bodies[0]["track"], nlohmann::json::parse("[[0,1,2,3,1,0,0,0],[3,2,2,3,1,0,0,0]]"));
  EXPECT_EQ(bodies[1]["with"], 0);
  EXPECT_FALSE(bodies[1].contains("track"));
  EXPECT_EQ(bodies[2]["track"], nlohmann::json::parse("[[1,0,0,0.5,0,1,0,0],[2]]"));
  EXPECT_NE((*scene)["note"].get<std::string>().find("20 pictures per second"), std::string::npos)
      << (*scene)["note"];
}

// A floor of 18 m by 6 m under a roof 5 m high that ends 4.7 m before the back wall: the raise has a radius of
// (20 - 0.3 - 15.3) / 2 m.
TEST(LoadingFigures, TheSceneSaysWhatThingsAreMadeOfAndWhereTheDriftIs) {
  const test::TestFolder place;
  LoadingLog log = log_with_a_peak();
  const auto block = [](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    return engine::box((high - low) / 2)
        .transformed(Eigen::Isometry3d(Eigen::Translation3d((low + high) / 2)));
  };
  log.scene.shapes = {block({2, -3, -0.1}, {20, 3, 0}), block({2, -3, 5}, {15.3, 3, 5.1}),
                      engine::box({1, 1, 1})};
  log.scene.bodies = {{0, "#9b958c", 1.0, "floor"},
                      {1, "#a39d94", 0.12, "roof"},
                      {2, "#2a2a2c", 1.0, "rear left wheel"},
                      {2, "#d9a21b", 1.0, "rear left wheel"},
                      {2, "#fff3cf", 1.0, "front unit"},
                      {2, "#5b5e63", 1.0, "bucket"},
                      {2, "#6b6f76", 1.0, "rock"}};
  log.scene.bodies[3].with = 2;
  log.scene.frames = {{0.0, 1, "curl", 0.0}};
  write_log(place / "run.h5", log);
  for (const auto& figure : loading_figures(place / "run.h5")) {
    if (figure["type"] != "scene") continue;
    std::vector<std::string> looks;
    for (const auto& body : figure["bodies"]) looks.push_back(body["look"]);
    EXPECT_EQ(looks, (std::vector<std::string>{"drift", "drift", "tyre", "paint", "lamp", "steel", "rock"}));
    const auto& drift = figure.at("drift");
    EXPECT_EQ(drift["from"], 2.0);
    EXPECT_EQ(drift["length"], 20.0);
    EXPECT_EQ(drift["width"], 6.0);
    EXPECT_EQ(drift["height"], 5.0);
    EXPECT_NEAR(drift["raise"]["radius"].get<double>(), 2.2, 1e-12);
    EXPECT_NEAR(drift["raise"]["x"].get<double>(), 17.5, 1e-12);
    return;
  }
  FAIL() << "no scene";
}

// Six columns along and four strips of 1 m: a body 1 m high from x = 2 m in the outer strips and from x = 1 m in
// the two inner ones. A strip's share of 4 m³ over 2 m of bucket is 2 m³, two columns, whose centre lies 1 m
// behind the front.
TEST(LoadingFigures, ShowThePileFromAbove) {
  const test::TestFolder place;
  LoadingLog log = log_with_a_peak();
  log.numbers = {{"drift_width", 4.0}, {"bucket_width", 2.0}, {"bucket_heaped_volume", 4.0}};
  CycleRecord& cycle = log.cycles[0];
  cycle.columns_x = 6;
  cycle.columns_y = 4;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 6; ++i) cycle.column_heights.push_back(i >= (j == 0 || j == 3 ? 2 : 1) ? 1.0 : 0.0);
  for (int i = 0; i < 6; ++i) {
    cycle.contour_x.push_back(i + 0.5);
    cycle.contour_z.push_back(i > 1 ? 1.0 : 0.5);
  }
  cycle.plan.feasible = true;
  cycle.plan.y = 0.5;
  cycle.plan.toe = 1.2;
  cycle.plan.depth = 1.5;
  write_log(place / "run.h5", log);
  const auto figures = loading_figures(place / "run.h5");
  const auto plan =
      std::find_if(figures.begin(), figures.end(), [](const auto& f) { return f["type"] == "plan"; });
  ASSERT_NE(plan, figures.end());
  EXPECT_EQ((*plan)["x"], nlohmann::json({0.5, 1.5, 2.5, 3.5, 4.5, 5.5}));
  EXPECT_EQ((*plan)["y"], nlohmann::json({-1.5, -0.5, 0.5, 1.5}));
  EXPECT_EQ((*plan)["heights"][1], nlohmann::json({0.0, 1.0, 1.0, 1.0, 1.0, 1.0}));
  EXPECT_EQ((*plan)["walls"], nlohmann::json({-2.0, 2.0}));
  EXPECT_EQ((*plan)["curves"][0]["x"], nlohmann::json({2.0, 1.0, 1.0, 2.0}));
  EXPECT_EQ((*plan)["curves"][1]["x"], nlohmann::json({3.0, 2.0, 2.0, 3.0}));
  EXPECT_EQ((*plan)["curves"][1]["y"], (*plan)["y"]);
  EXPECT_EQ((*plan)["place"]["x"], nlohmann::json({1.2, 2.7}));
  EXPECT_EQ((*plan)["place"]["y"], nlohmann::json({-0.5, 1.5}));
}

// The tip goes 0.01 m in 0.1 s; 300 kN m about two axes are 424.264, with 600 kN m about the pin 734.847.
TEST(LoadingFigures, TheSceneHasSignalsOfAllSamples) {
  const test::TestFolder place;
  LoadingLog log = log_with_a_peak();
  log.scene.frames = {{0.0, 1, "drive in", 0.0}, {0.5, 1, "curl", 3240.0}};
  write_log(place / "run.h5", log);
  const auto figures = loading_figures(place / "run.h5", {{"yield-torque", "450"}});
  const auto scene =
      std::find_if(figures.begin(), figures.end(), [](const auto& f) { return f["type"] == "scene"; });
  ASSERT_NE(scene, figures.end());
  const auto& signals = (*scene)["signals"];
  ASSERT_EQ(signals.size(), 3u);
  EXPECT_EQ(signals[0]["y"].size(), static_cast<std::size_t>(samples));
  EXPECT_EQ(signals[0]["y"][5], 0.1);
  EXPECT_EQ(signals[1]["name"], "Torque in hinge G");
  EXPECT_EQ(signals[1]["y"][41], 734.847);
  EXPECT_EQ(signals[1]["t"][41], 4.1);
  EXPECT_EQ(signals[1]["lines"][0]["y"], 450.0);
  EXPECT_EQ(signals[2]["y"], nlohmann::json({0.0, 3.24}));
  const auto twisting = loading_figures(place / "run.h5", {{"damage", "twisting"}});
  const auto other =
      std::find_if(twisting.begin(), twisting.end(), [](const auto& f) { return f["type"] == "scene"; });
  EXPECT_EQ((*other)["signals"][1]["name"], "Torque that twists hinge G");
  EXPECT_EQ((*other)["signals"][1]["y"][41], 424.264);
}

/// Of the same, the second cycle of which begins at 10 s.
LoadingLog log_of_two_cycles() {
  LoadingLog log = log_with_a_peak();
  for (int i = 0; i < samples; ++i)
    log.signals.append_row(
        std::vector<double>{10.1 + 0.1 * i, 2.0, 1.0, 0.01 * i, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  CycleRecord second = log.cycles[0];
  second.number = 2;
  second.t_start = 10.0;
  second.t_end = 20.0;
  log.cycles.push_back(second);
  log.scene.frames = {
      {0.0, 1, "lift", 0.0}, {0.5, 1, "curl", 3240.0}, {10.0, 2, "lift", 0.0}, {12.0, 2, "curl", 50.0}};
  return log;
}

// The report has the first cycle and says how to see the others; the replay has each on its own clock.
TEST(LoadingFigures, TheReplayHasEveryCycle) {
  const test::TestFolder place;
  write_log(place / "run.h5", log_of_two_cycles());
  const auto scenes_of = [](const nlohmann::json& figures) {
    std::vector<nlohmann::json> scenes;
    for (const auto& figure : figures)
      if (figure["type"] == "scene") scenes.push_back(figure);
    return scenes;
  };
  const auto report = scenes_of(loading_figures(place / "run.h5"));
  ASSERT_EQ(report.size(), 1u);
  EXPECT_EQ(report[0]["caption"], "Cycle 1 of the run shown. The command replay shows all 2 cycles.");
  EXPECT_FALSE(report[0].contains("cycle"));

  const auto replay = loading_replay(place / "run.h5");
  EXPECT_EQ(replay[0]["type"], "table") << "all cycles come before one of them";
  EXPECT_FALSE(replay[0].contains("cycle"));
  const auto scenes = scenes_of(replay);
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes[0]["caption"], "Cycle 1 of the run shown.");
  EXPECT_EQ(scenes[1]["cycle"], 2);
  EXPECT_EQ(scenes[1]["frames"][1]["t"], 2.0);
  EXPECT_EQ(scenes[1]["signals"][2]["y"], nlohmann::json({0.0, 0.05}));
  const auto of_second =
      std::count_if(replay.begin(), replay.end(), [](const auto& f) { return f.value("cycle", 0) == 2; });
  EXPECT_EQ(of_second, 4) << "path, scene, forces, rock in the bucket";
}

// How to read a scene is its note, which a page says once; the rock in the bucket is a curve of the scene.
TEST(LoadingFigures, WhatScenesShareIsANote) {
  const test::TestFolder place;
  write_log(place / "run.h5", log_of_two_cycles());
  std::vector<nlohmann::json> notes, in_scene;
  for (const auto& figure : loading_replay(place / "run.h5")) {
    if (figure.contains("note")) notes.push_back(figure["note"]);
    if (figure.value("in_scene", false)) in_scene.push_back(figure["title"]);
  }
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], notes[1]);
  EXPECT_EQ(in_scene, std::vector<nlohmann::json>(2, "Rock in the bucket"));
}

TEST(LoadingFigures, ARunWithoutACycleHasNone) {
  const test::TestFolder place;
  LoadingLog log = log_with_a_peak();
  log.cycles.clear();
  write_log(place / "run.h5", log);
  EXPECT_TRUE(loading_figures(place / "run.h5").empty());
}

}  // namespace
