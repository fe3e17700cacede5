// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The page of one run: it holds the run and its figures, and says why there is none.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/analysis/replay.h>
#include <drawpoint/studies/report/replay.h>
#include <drawpoint/studies/store/run_logs.h>
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
    study_.illustrate = [](const std::filesystem::path& log) {
      if (test::contents(log) == "mad") throw std::runtime_error("no such signal");
      return nlohmann::json::array({table_panel});
    };
  }
  std::filesystem::path file() const { return place_ / "page.html"; }
  void make() const { replay(study_, store_, folder_, run_, file(), "command"); }
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
  study_.simulator = "throw, model 2";
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
