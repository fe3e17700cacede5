// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What the live page is told of a study that another process works on: figures against those counted by
/// hand, rows that come once, and no trace left in the folder.

#include <drawpoint/tests/studies/support.hpp>

#include <SQLiteCpp/SQLiteCpp.h>
#include <drawpoint/studies/run/store/times.h>
#include <drawpoint/studies/say/live/site.h>
#include <drawpoint/studies/say/live/standing.h>
#include <drawpoint/studies/say/live/state.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;
using nlohmann::json;

namespace {

studies::Run planned(std::int64_t id) {
  studies::Run run;
  run.id = run.point = id;
  run.seed = 7;
  run.x = Eigen::Vector2d(0.2 + 0.01 * static_cast<double>(id), 0.5);
  run.y = run.predicted = run.lower = run.upper = Eigen::Vector2d::Constant(std::nan(""));
  return run;
}

/// A store with six runs planned, and what follows it.
class Live : public testing::Test {
 protected:
  Live() {
    study_.name = "sample";
    study_.problem = test::two_by_two();  // production to maximize, spill at most 0.25
    study_.black_box = [](const Eigen::VectorXd&) {
      return doe::Outcome(Eigen::VectorXd(Eigen::Vector2d(1.0, 0.0)));
    };
    std::vector<studies::Run> runs;
    for (std::int64_t id = 1; id <= 6; ++id) runs.push_back(planned(id));
    store_.add(runs);
  }
  void done(std::int64_t id, double production, double spill) {
    store_.mark_running(id);
    store_.save_done(id, Eigen::Vector2d(production, spill), 2.0);
  }
  void failed(std::int64_t id, const std::string& reason) {
    store_.mark_running(id);
    store_.save_failed(id, reason, 1.0);
  }
  json ask(Follower& follower, const Kept& kept = {}) const {
    return json::parse(state_of({study_, folder_, "sample"}, follower.look(), kept, std::time(nullptr))
                           .dump(-1, ' ', false, json::error_handler_t::replace));
  }

  test::TestFolder place_;
  Folder folder_{place_.path()};
  Store store_ = Store::create(folder_.store(), test::identity());
  Study study_;
};

// Counted by hand: of six runs three are done, one failed, one runs, one is planned. Run 2 is better than run
// 4, but breaks the limit of spill.
TEST_F(Live, TellsCountsBestRunsAndFailures) {
  done(1, 100.0, 0.2);
  done(2, 150.0, 0.3);
  failed(3, "stuck");
  done(4, 120.0, 0.1);
  store_.mark_running(5);
  Follower follower(study_, folder_, 1.0);
  const json state = ask(follower);
  EXPECT_EQ(state.at("standing").at("kind"), "stopped") << "nobody holds the folder";
  EXPECT_EQ(state.at("standing").at("next"), "run --out '" + folder_.path.string() + "'");
  EXPECT_EQ(state.at("total"), 6);
  EXPECT_EQ(state.at("counts").at("training"),
            (json{{"planned", 1}, {"running", 1}, {"done", 3}, {"failed", 1}}));
  EXPECT_EQ(state.at("progress"), "4/6 runs, 1 failed");
  EXPECT_TRUE(state.at("runs_per_hour").is_null()) << "nobody is at work";
  EXPECT_EQ(state.at("seconds"), 7.0);
  const json& production = state.at("responses").at(0);
  EXPECT_EQ(production.at("improvements"), (json{{1, 1, 100.0}, {4, 4, 120.0}}));
  EXPECT_EQ(production.at("best").at(0), 4);
  EXPECT_EQ(production.at("best").at(3), (json{120.0, 0.1}));
  EXPECT_TRUE(production.at("best_error").is_null()) << "these runs do not say what they scatter by";
  EXPECT_EQ(production.at("highest"), 150.0);
  EXPECT_EQ(state.at("responses").at(1).at("within"), 2) << "0.3 is above 0.25";
  EXPECT_EQ(state.at("failures"), (json{{{"reason", "stuck"}, {"times", 1}, {"run", 3}}}));
  EXPECT_EQ(state.at("last").at("run"), 4);
  ASSERT_EQ(state.at("running").size(), 1u);
  EXPECT_EQ(state.at("running").at(0).at("run"), 5);
  EXPECT_TRUE(state.at("logged").is_null());
}

std::vector<int> runs_of(const json& state) {
  std::vector<int> runs;
  for (const json& row : state.at("rows")) runs.push_back(row.at(0));
  return runs;
}

TEST_F(Live, RowsComeOnceInTheOrderInWhichRunsEnd) {
  done(1, 1.0, 0.0);
  failed(2, "stuck");
  Follower follower(study_, folder_, 1.0);
  const json first = ask(follower);
  EXPECT_EQ(runs_of(first), (std::vector<int>{1, 2}));
  EXPECT_TRUE(first.at("rows").at(1).at(3).is_null());
  const std::string epoch = first.at("epoch");
  done(5, 2.0, 0.0);
  EXPECT_EQ(runs_of(ask(follower, {epoch, 2})), (std::vector<int>{5}));
  done(3, 3.0, 0.0);  // may end in the same second, and has the lower number
  const json third = ask(follower, {epoch, 3});
  EXPECT_EQ(runs_of(third), (std::vector<int>{3}));
  EXPECT_EQ(third.at("from"), 3);
  EXPECT_EQ(third.at("ended"), 4);
  EXPECT_EQ(runs_of(ask(follower, {epoch, 4})), (std::vector<int>{}));
  EXPECT_EQ(runs_of(ask(follower, {"other", 4})), (std::vector<int>{1, 2, 5, 3})) << "another epoch's page";
  EXPECT_EQ(runs_of(ask(follower, {epoch, 99})), (std::vector<int>{}));
}

TEST_F(Live, ARunThatIsMadeAgainBeginsAnEpoch) {
  done(1, 1.0, 0.0);
  failed(2, "stuck");
  Follower follower(study_, folder_, 1.0);
  const std::string epoch = ask(follower).at("epoch");
  store_.plan_again(true);
  const json state = ask(follower, {epoch, 2});
  EXPECT_NE(state.at("epoch"), epoch);
  EXPECT_EQ(runs_of(state), (std::vector<int>{1}));
}

TEST_F(Live, ManyRunsComeInParts) {
  std::vector<studies::Run> runs;
  for (std::int64_t id = 7; id <= 2506; ++id) {
    studies::Run run = planned(id);
    run.kind = Kind::imported;
    run.status = id % 2 == 0 ? Status::failed : Status::done;
    run.reason = id % 2 == 0 ? "reason " + std::to_string(id) + std::string(5000, '!') : "";
    run.y = id % 2 == 0 ? run.y : Eigen::VectorXd(Eigen::Vector2d(1.0, 0.0));
    run.started = run.finished = "2020-01-01T00:00:00Z";
    runs.push_back(run);
  }
  store_.add(runs);
  Follower follower(study_, folder_, 1.0);
  Kept kept;
  std::vector<std::size_t> parts;
  for (int i = 0; i < 3; ++i) {
    const json state = ask(follower, kept);
    EXPECT_EQ(state.at("from"), kept.since);
    EXPECT_LT(state.dump().size(), 200'000u) << "some 80 bytes per row, and 20 messages";
    parts.push_back(state.at("rows").size());
    kept = {state.at("epoch"), kept.since + parts.back()};
    EXPECT_EQ(state.at("failures").size(), most_failures);
    EXPECT_EQ(state.at("more_failures"), 1250 - most_failures);
  }
  EXPECT_EQ(parts, (std::vector<std::size_t>{1000, 1000, 500}));
}

TEST_F(Live, TextsOfProgramsStayTexts) {
  failed(1, "<script>\"\xff\n");
  Follower follower(study_, folder_, 1.0);
  EXPECT_EQ(ask(follower).at("failures").at(0).at("reason"), "<script>\"\xEF\xBF\xBD\n");
}

TEST_F(Live, LeavesTheFolderAsItIs) {
  done(1, 1.0, 0.0);
  const std::string before = test::contents(folder_.store());
  const auto changed = std::filesystem::last_write_time(folder_.store());
  Follower follower(study_, folder_, 1.0);
  ask(follower);
  EXPECT_EQ(test::contents(folder_.store()), before);
  EXPECT_EQ(std::filesystem::last_write_time(folder_.store()), changed);
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path))
    files.push_back(entry.path().filename());
  EXPECT_EQ(files, std::vector<std::string>{"study.db"});
}

TEST_F(Live, AStoreThatIsHeldIsSaidAndWhatWasReadStays) {
  done(1, 1.0, 0.0);
  Follower follower(study_, folder_, 1.0);
  ask(follower);
  {
    SQLite::Database other(folder_.store().string(), SQLite::OPEN_READWRITE);
    other.exec("BEGIN EXCLUSIVE");
    const json state = ask(follower);
    EXPECT_EQ(state.at("standing").at("kind"), "unreadable");
    EXPECT_NE(state.at("standing").at("text").get<std::string>().find("database is locked"),
              std::string::npos);
    EXPECT_EQ(state.at("ended"), 1);
    EXPECT_EQ(Follower(study_, folder_, 1.0).look().contents, nullptr) << "and to begin with it is no crash";
  }
  EXPECT_EQ(ask(follower).at("standing").at("kind"), "stopped");
}

TEST_F(Live, AStudyMayComeAndGo) {
  const Folder later{place_ / "later"};
  Follower follower(study_, later, 1.0);
  EXPECT_EQ(standing_of(study_, later, follower.look()).kind, StandingKind::absent);
  std::filesystem::create_directory(later.path);
  { Store::create(later.store(), test::identity()).add({planned(1)}); }
  EXPECT_EQ(standing_of(study_, later, follower.look()).kind, StandingKind::stopped);
  std::filesystem::remove_all(later.path);
  EXPECT_EQ(standing_of(study_, later, follower.look()).kind, StandingKind::absent);
}

TEST_F(Live, AnotherStudyIsRefused) {
  study_.name = "other";
  EXPECT_EQ(
      test::complaint([&] { Follower(study_, folder_, 1.0); }),
      "studies: " + folder_.path.string() +
          " holds another study: name \"sample\" there, \"other\" here; choose another folder with --out, or "
          "move this one away");
}

TEST_F(Live, KnowsWhoIsAtWorkWithoutTakingTheFolder) {
  EXPECT_FALSE(holder_of(folder_));
  {
    const FolderLock lock(folder_);
    const auto holder = holder_of(folder_);
    ASSERT_TRUE(holder);
    EXPECT_EQ(holder->process, getpid());
    EXPECT_NEAR(std::difftime(holder->since, std::time(nullptr)), 0.0, 5.0);
    Follower follower(study_, folder_, 1.0);
    EXPECT_EQ(standing_of(study_, folder_, follower.look()).kind, StandingKind::working);
  }
  EXPECT_FALSE(holder_of(folder_)) << "its number is still in the file";
}

TEST_F(Live, AFinishedStudyNamesTheNextCommand) {
  const auto next = [&] {
    Follower follower(study_, folder_, 1.0);
    return ask(follower).at("standing").at("next").get<std::string>();
  };
  const std::string out = " --out '" + folder_.path.string() + "'";
  for (int id = 1; id <= 6; ++id) failed(id, "stuck");
  EXPECT_EQ(next(), "run --retry-failed" + out);
  store_.plan_again(true);
  for (int id = 1; id <= 6; ++id) done(id, 1.0, 0.0);
  EXPECT_EQ(next(), "confirm" + out);
  study_.black_box = {};
  EXPECT_EQ(next(), "ask --confirm" + out) << "whoever makes the runs is asked";
  Sampling sampling = store_.sampling();
  sampling.points = 4;
  store_.set_sampling(sampling);
  EXPECT_EQ(next(), "ask" + out) << "four adaptive points are wanted";
  sampling.points = 0;
  store_.set_sampling(sampling);
  studies::Run confirmation = planned(7);
  confirmation.kind = Kind::confirmation;
  store_.add({confirmation});
  done(7, 1.0, 0.0);
  EXPECT_EQ(next(), "front" + out);
}

// Two runs of an earlier command, one made elsewhere; three of this one, whose first began at 1000 s. At 1060
// s that is 3 per minute, and for the two that are missing 40 s.
TEST(LiveProgress, CountsTheRunsOfTheCommandAtWork) {
  auto contents = std::make_shared<Contents>();
  contents->identity = test::identity();
  const auto add = [&](Kind kind, Status status, std::time_t started) {
    studies::Run run = planned(static_cast<std::int64_t>(contents->runs.size()) + 1);
    run.kind = kind;
    run.status = status;
    run.started = started == 0 ? "" : utc_text(started);
    contents->runs.push_back(run);
  };
  add(Kind::training, Status::done, 100);
  add(Kind::training, Status::failed, 200);
  add(Kind::imported, Status::done, 1005);
  add(Kind::training, Status::done, 1000);
  add(Kind::adaptive, Status::done, 1020);
  add(Kind::validation, Status::failed, 1030);
  add(Kind::training, Status::running, 1050);
  add(Kind::training, Status::planned, 0);
  View view{.contents = contents, .trouble = "", .there = true, .holder = FolderHolder{1, 990}};
  const ProgressState state = progress_of(view, 1060);
  EXPECT_EQ(state.done, 6);
  EXPECT_EQ(state.session, 3);
  EXPECT_DOUBLE_EQ(rate_of(state), 3.0 / 60.0);
  EXPECT_DOUBLE_EQ(seconds_left(state), 40.0);
  view.holder.reset();
  EXPECT_EQ(rate_of(progress_of(view, 1060)), 0.0);
}

TEST(LiveProgress, TimesReadBack) {
  for (const std::time_t time : {std::time_t{0}, std::time_t{951782400}, std::time_t{1795689000}})
    EXPECT_EQ(time_of(utc_text(time)), time);
  EXPECT_EQ(utc_text(951782400), "2000-02-29T00:00:00Z");
  EXPECT_EQ(time_of("yesterday"), 0);
}

}  // namespace
