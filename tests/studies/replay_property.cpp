// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The page of one run: it holds the run and its figures, and says why there is none.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/run/store/run_logs.h>
#include <drawpoint/studies/say/page/replay_page.h>
#include <drawpoint/studies/say/run_replay.h>
#include <drawpoint/tests/studies/report_cases.hpp>

#include <filesystem>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

const nlohmann::json table_panel = {
    {"type", "table"}, {"title", "t"}, {"caption", "c"}, {"columns", {"a"}}, {"rows", {{1}}}};

ReplayInput replay_input(const nlohmann::json& panels) {
  return {.study = report_cases::nasty,
          .about = "",
          .command = "study replay --run 3",
          .problem = test::two_by_two(),
          .run = {.run = 3,
                  .x = Eigen::Vector2d(1.5, -0.5),
                  .outcome = Eigen::VectorXd(Eigen::Vector2d(100.0, 0.25))},
          .kind = "training",
          .panels = panels,
          .facts = {{"Seed", "7"}}};
}

TEST(ReplayPage, HoldsTheRunAndItsFigures) {
  const test::TestFolder place;
  write_replay(place / "replay.html", replay_input(nlohmann::json::array({table_panel})));
  const std::string page = test::contents(place / "replay.html");
  EXPECT_NE(page.find(", run 3</title>"), std::string::npos);
  EXPECT_NE(page.find("content=\"default-src 'none'"), std::string::npos) << "no network";
  const auto data = report_cases::data_in(page);
  EXPECT_EQ(data.at("replay").at("x"), nlohmann::json({1.5, -0.5}));
  EXPECT_EQ(data.at("replay").at("y"), nlohmann::json({100.0, 0.25}));
  EXPECT_EQ(data.at("illustrations").size(), 1u);
  EXPECT_EQ(data.at("problem").at("responses").at(0).at("name"), "production");
}

/// Of a cycle: a scene with one body, and a table of so many rows.
nlohmann::json panels_of(int cycle, int rows) {
  nlohmann::json table = table_panel, scene = {{"type", "scene"}, {"title", "s"}, {"caption", "c"}};
  for (int k = 1; k < rows; ++k) table["rows"].push_back({1});
  scene["shapes"] = {{{"vertices", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {"faces", {{0, 1, 2}}}}};
  scene["bodies"] = {{{"shape", 0}}};
  scene["frames"] = {{{"t", cycle}, {"poses", {{0, 0, 0, 1, 0, 0, 0}}}}};
  table["cycle"] = scene["cycle"] = cycle;
  return {scene, table};
}

nlohmann::json three_cycles() {
  nlohmann::json panels = nlohmann::json::array({table_panel});
  for (int cycle = 1; cycle <= 3; ++cycle)
    for (const auto& panel : panels_of(cycle, 1000)) panels.push_back(panel);
  return panels;
}

TEST(ReplayPage, HoldsAllCyclesAndTheirBodiesOnce) {
  const auto data = report_cases::data_in(replay_page(replay_input(three_cycles())));
  const auto& panels = data.at("illustrations");
  ASSERT_EQ(panels.size(), 7u);
  EXPECT_TRUE(panels[1].contains("bodies"));
  for (const std::size_t k : {3u, 5u}) {
    EXPECT_EQ(panels[k].at("bodies_of"), 1);
    EXPECT_FALSE(panels[k].contains("bodies") || panels[k].contains("shapes"));
    EXPECT_EQ(panels[k].at("cycle"), k / 2 + 1);
  }
  EXPECT_EQ(data.at("left_out"), "");
}

// A table of 1000 rows of "[1]," takes 4 kB.
TEST(ReplayPage, SaysWhichCyclesItHasNoRoomFor) {
  ReplayInput input = replay_input(three_cycles());
  input.most_bytes = 10'000;
  auto data = report_cases::data_in(replay_page(input));
  EXPECT_EQ(data.at("illustrations").size(), 5u);
  EXPECT_EQ(data.at("left_out"),
            "Cycle 3 is left out, to keep this page below some 0 MB: it has a page of its own with the "
            "command replay --run 3 --cycle 3.");
  input.most_bytes = 0;
  data = report_cases::data_in(replay_page(input));
  EXPECT_EQ(data.at("illustrations").size(), 3u) << "the first cycle is never left out";
  EXPECT_NE(data.at("left_out").get<std::string>().find("Cycles 2 to 3 are left out"), std::string::npos);
}

// What a scene shows too is left out beside one, and only there.
TEST(ReplayPage, ShowsACurveOnce) {
  nlohmann::json curve = table_panel, panels = panels_of(1, 1);
  curve["in_scene"] = true;
  panels.push_back(curve);
  const auto with = report_cases::data_in(replay_page(replay_input(panels)));
  EXPECT_EQ(with.at("illustrations").size(), 2u);
  panels.back()["cycle"] = 2;  // whose scene is not there
  const auto other = report_cases::data_in(replay_page(replay_input(panels)));
  EXPECT_EQ(other.at("illustrations").size(), 3u);
  const auto alone = report_cases::data_in(replay_page(replay_input(nlohmann::json::array({curve}))));
  EXPECT_EQ(alone.at("illustrations").size(), 1u);
}

TEST(ReplayPage, ACycleIsANumberFromOne) {
  for (const nlohmann::json& cycle : {nlohmann::json(0), nlohmann::json(1.5), nlohmann::json("1")}) {
    nlohmann::json panel = table_panel;
    panel["cycle"] = cycle;
    EXPECT_NE(test::complaint([&] {
                replay_page(replay_input(nlohmann::json::array({panel})));
              }).find("\"cycle\" is not a whole number from 1"),
              std::string::npos);
  }
}

TEST(ReplayPage, AFaultyFigureIsNamedAndOneMustBeGood) {
  const test::TestFolder place;
  write_replay(place / "replay.html", replay_input(nlohmann::json::array({table_panel, 7})));
  const auto data = report_cases::data_in(test::contents(place / "replay.html"));
  ASSERT_EQ(data.at("replay").at("cautions").size(), 1u);
  EXPECT_EQ(
      test::complaint([&] { write_replay(place / "none.html", replay_input(nlohmann::json::array({7}))); }),
      "replay: the study draws no figure of the log of run 3: Figure 1 of the simulation was left out: "
      "\"type\" is missing.");
  EXPECT_EQ(
      test::complaint([&] { write_replay(place / "none.html", replay_input(nlohmann::json::array())); }),
      "replay: the study draws no figure of the log of run 3; choose another run");
  EXPECT_FALSE(std::filesystem::exists(place / "none.html"));
}

/// A store with one run, and its log "raw".
class Replay : public testing::Test {
 protected:
  Replay() {
    std::filesystem::create_directories(folder_.logs());
    test::write_file(folder_.log(1), "raw");
    run_.id = 1;
    run_.status = Status::done;
    run_.x = Eigen::Vector2d(1.0, 0.0);
    run_.y = Eigen::Vector2d(100.0, 0.2);
    run_.log = file_checksum(folder_.log(1));
    study_.name = "sample";
    study_.problem = test::two_by_two();
    study_.presentation.illustrate = [](const std::filesystem::path& log) {
      if (test::contents(log) == "mad") throw std::runtime_error("no such signal");
      return nlohmann::json::array({table_panel});
    };
  }
  /// Of two cycles, of which the report would show the first.
  void show_by_cycles() {
    study_.presentation.replay = [](const std::filesystem::path&) {
      nlohmann::json panels = panels_of(1, 1);
      for (const auto& panel : panels_of(2, 1)) panels.push_back(panel);
      panels.push_back(table_panel);
      return panels;
    };
  }
  std::string refusal_of_cycle(int cycle) const {
    return test::complaint([&] { replay(study_, store_, folder_, {run_, cycle}, file(), "command"); });
  }
  std::filesystem::path file() const { return place_ / "page.html"; }
  void make() const { replay(study_, store_, folder_, {run_}, file(), "command"); }
  std::string refusal() const {
    const std::string text = test::complaint([&] { make(); });
    EXPECT_FALSE(std::filesystem::exists(file()));
    return text;
  }

  test::TestFolder place_;
  Folder folder_{place_.path()};
  Store store_ = Store::create(folder_.store(), test::identity());
  studies::Run run_;
  Study study_;
};

TEST_F(Replay, IsOfAnyRunWithALog) {
  make();
  EXPECT_EQ(report_cases::data_in(test::contents(file())).at("replay").at("y"), nlohmann::json({100.0, 0.2}));
  std::filesystem::remove(file());
  run_.status = Status::failed;
  run_.reason = "stuck";
  run_.kind = Kind::validation;
  make();
  const auto data = report_cases::data_in(test::contents(file()));
  EXPECT_EQ(data.at("replay").at("reason"), "stuck");
  EXPECT_TRUE(data.at("replay").at("y").is_null());
}

TEST_F(Replay, IsOfAllCyclesOrOfOne) {
  show_by_cycles();
  make();
  EXPECT_EQ(report_cases::data_in(test::contents(file())).at("illustrations").size(), 5u);
  replay(study_, store_, folder_, {run_, 2}, file(), "command");
  const auto data = report_cases::data_in(test::contents(file()));
  ASSERT_EQ(data.at("illustrations").size(), 3u);
  EXPECT_EQ(data.at("illustrations")[0].at("cycle"), 2);
  EXPECT_FALSE(data.at("illustrations")[2].contains("cycle"));
  EXPECT_EQ(scene_of_run(study_, store_.identity(), folder_, {run_}).at("frames")[0].at("t"), 1);
  EXPECT_EQ(scene_of_run(study_, store_.identity(), folder_, {run_, 2}).at("frames")[0].at("t"), 2);
}

TEST_F(Replay, SaysWhichCyclesThereAre) {
  EXPECT_EQ(refusal_of_cycle(1), "--cycle: this study does not show run 1 by cycles; leave --cycle out");
  show_by_cycles();
  EXPECT_EQ(refusal_of_cycle(3), "--cycle 3: the log of run 1 has cycles 1 to 2; choose one of them");
}

TEST_F(Replay, SaysWhyThereIsNone) {
  run_.status = Status::planned;
  EXPECT_EQ(refusal(), "replay: run 1 has not ended; make it with the command run");
  run_.status = Status::failed;
  run_.reason = "stuck";
  run_.log = "";
  EXPECT_EQ(refusal(), "replay: run 1 wrote no log. It failed: stuck. Choose a run that did");
}

TEST_F(Replay, ALogThatDoesNotFitItsRunIsNotShown) {
  const std::string again = "; make it again with evaluate --run 1 --out '" + folder_.path.string() +
                            "' --log '" + folder_.log(1).string() + "'";
  test::write_file(folder_.log(1), "raw?");
  EXPECT_EQ(refusal(),
            "replay: run 1: " + folder_.log(1).string() + " is damaged, or not what the run wrote" + again);
  std::filesystem::remove(folder_.log(1));
  EXPECT_EQ(refusal(), "replay: run 1: its log " + folder_.log(1).string() + " is gone" + again);
  study_.simulator.name = "throw, model 2";
  EXPECT_EQ(refusal(), "replay: run 1: its log " + folder_.log(1).string() +
                           " is gone; only the program that made this folder, a simulator without a name, "
                           "makes it again");
}

TEST_F(Replay, WhatTheStudyCannotDrawIsSaid) {
  test::write_file(folder_.log(1), "mad");
  run_.log = file_checksum(folder_.log(1));
  EXPECT_EQ(refusal(), "replay: run 1 could not be shown: no such signal");
}

}  // namespace
