// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The command live as a user gives it: before the study is there, while it runs, to its end; and what it
/// refuses.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <drawpoint/tests/support/loopback_client.hpp>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study = "env TROUBLE=slow " TROUBLED_STUDY;

class LiveCommand : public StudyTest {
 protected:
  /// Waits until the command has said where its page is, at most a minute.
  void start(const std::string& program = study) {
    const std::filesystem::path told = place_ / "told";
    live_.emplace(program + " live" + out() + " >" + told.string(), place_);
    const std::string before = "http://127.0.0.1:";
    for (int i = 0; i < 6000 && !contents(told).ends_with("/\n"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(contents(told).starts_with(before)) << contents(told);
    port_ = std::stoi(contents(told).substr(before.size()));
  }
  nlohmann::json state() const { return nlohmann::json::parse(support::get(port_, "/state.json").body); }
  /// The first state that knows a rate, within a minute: times are kept in whole seconds, and runs that ended
  /// in the second in which the first began tell none.
  nlohmann::json state_with_rate() const {
    nlohmann::json now = state();
    for (int i = 0; i < 1200 && now.at("runs_per_hour").is_null(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      now = state();
    }
    return now;
  }
  std::string kind() const { return state().at("standing").at("kind"); }
  Ended stop() {
    live_->send(SIGINT);
    const Ended end = live_->wait();
    live_.reset();
    return end;
  }

  std::optional<Command> live_;
  int port_ = 0;
};

TEST_F(LiveCommand, FollowsAStudyFromBeforeItsBeginningToItsEnd) {
  start();
  EXPECT_EQ(kind(), "absent");
  {
    Command run(study + " run --runs 12 --validation 4 --jobs 1" + out(), place_);
    await_done(2);
    const nlohmann::json during = state();
    EXPECT_EQ(during.at("standing").at("kind"), "working");
    EXPECT_EQ(during.at("total"), 16);
    EXPECT_GE(during.at("ended"), 2);
    EXPECT_GT(state_with_rate().at("runs_per_hour"), 0.0);
    EXPECT_EQ(run.wait().code, 0);
  }
  const nlohmann::json after = state();
  EXPECT_EQ(after.at("standing").at("kind"), "ended");
  EXPECT_EQ(after.at("program"), "troubled_study");
  EXPECT_EQ(after.at("ended"), 16);
  EXPECT_EQ(after.at("counts").at("validation").at("done"), 4);
  EXPECT_EQ(after.at("responses").at(0).at("best").at(0),
            std::stoi(query("SELECT id FROM runs ORDER BY cost LIMIT 1")));
  const Ended end = stop();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(contains(end.err, "There is no study in " + dir().string() + " yet."));
}

// A browser watches the page, from before the study is there.
TEST_F(LiveCommand, IsWatchedInABrowser) {
  const std::string program = "env TROUBLE=cycles " TROUBLED_STUDY;
  start(program);
  const std::filesystem::path seen = place_ / "seen";
  Command watching("node " LIVE_SESSION " http://127.0.0.1:" + std::to_string(port_) + "/ >" + seen.string(),
                   place_);
  for (int i = 0; i < 4800 && !contents(seen).ends_with("waiting\n"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_TRUE(contains(contents(seen), "before the study: waiting\n"));
  ASSERT_EQ(run(program + " run --runs 12 --validation 4" + out()).code, 0);
  const Ended end = watching.wait();
  EXPECT_EQ(end.code, 0) << end.err;
  const std::string all = contents(seen);
  for (const char* line :
       {"at the end: 16/16 troubled, live\n", "axes: cost [EUR], wear, x [m], y [deg], run\n",
        "last run: measured\n", "page of the best run: troubled, run ",
        "console errors: 0, requests elsewhere: 0\n"})
    EXPECT_TRUE(contains(all, line)) << all;
  EXPECT_EQ(stop().code, 0);
}

TEST_F(LiveCommand, SaysThatARunWasStopped) {
  Command run(study + " run --runs 40 --validation 0 --jobs 1" + out(), place_);
  await_done(1);
  run.send(SIGINT);
  EXPECT_EQ(run.wait().code, 130);
  start();
  EXPECT_EQ(kind(), "stopped");
  EXPECT_EQ(stop().code, 0);
}

TEST_F(LiveCommand, RefusesPortsThatItCannotHave) {
  start();
  expect_refused(
      study + " live --port " + std::to_string(port_) + out(), 1,
      "live: port " + std::to_string(port_) + " of 127.0.0.1 cannot be had: another program listens there");
  for (const char* port : {"65536", "-1", "http"})
    expect_refused(study + " live --port " + port + out(), 2, "--port");
  EXPECT_EQ(stop().code, 0);
}

TEST_F(LiveCommand, RefusesWhatIsNoStudyOfItsOwn) {
  std::filesystem::create_directories(dir());
  std::ofstream(database()) << "not a database, but long enough to be looked at as one .....................";
  expect_refused(study + " live" + out(), 1, "study.db: file is not a database");
  std::filesystem::remove(database());
  ASSERT_EQ(run("env TROUBLE=changed " TROUBLED_STUDY " --runs 4 --validation 0" + out()).code, 0);
  expect_refused(study + " live" + out(), 2, "holds another study");
}

}  // namespace

// A client that drips its question holds a thread, not the end.
TEST_F(LiveCommand, EndsAlthoughAClientDrips) {
  start();
  std::atomic<bool> over = false;
  std::thread client([&] {
    const int slow = support::connected("127.0.0.1", port_);
    const std::string head = "GET / HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) + "\r\nX: ";
    for (std::string part = head; !over && ::send(slow, part.data(), part.size(), MSG_NOSIGNAL) > 0;
         part = "x")
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
    ::close(slow);
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(stop().code, 0);
  over = true;
  client.join();
}
