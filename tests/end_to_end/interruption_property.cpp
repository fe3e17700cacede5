// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A study that is stopped, however it is stopped, loses at most the runs in flight, and the same command
/// finishes it.

#include <drawpoint/tests/end_to_end/support.hpp>

#include <set>

using namespace drawpoint;
using namespace drawpoint::test;

namespace {

const std::string study_line = TROUBLED_STUDY " --runs 12 --validation 4 --jobs 2";

/// The command, in whose study so many runs end; the next ones are in flight until somebody ends them.
std::string stuck_after(int runs, const std::string& command) {
  return "env TROUBLE=held HELD_FROM=" + std::to_string(runs + 1) + " " + command;
}

class Interruption : public StudyTest {
 protected:
  std::string finished() const {
    return query(
        "SELECT group_concat(id || ' ' || started || ' ' || finished || ' ' || quote(cost)) FROM runs WHERE "
        "status = 'done'");
  }

  /// The processes of the two runs that are in flight, once both are there.
  std::set<pid_t> runs_in_flight() const {
    std::set<pid_t> found;
    for (int i = 0; i < 6000 && found.size() < 2; ++i) {
      for (const auto& process : std::filesystem::directory_iterator("/proc"))
        if (contains(contents(process.path() / "cmdline"), "--log=" + dir().string()))
          found.insert(std::stoi(process.path().filename()));
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return found;
  }
  /// Kept is what was done before; the rest follows.
  void expect_resumes(const std::string& before) {
    const Ended rest = run(study_line + out() + " --json");
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_EQ(rest.json()["runs"], 16);
    EXPECT_EQ(count("status = 'done'"), 16);
    EXPECT_TRUE(contains("," + finished() + ",", before.substr(0, before.find(','))));
    for (std::size_t at = 0; at != std::string::npos && at < before.size();) {
      const std::size_t end = before.find(',', at);
      EXPECT_TRUE(contains(finished(), before.substr(at, end - at)));
      at = end == std::string::npos ? end : end + 1;
    }
  }
};

TEST_F(Interruption, CtrlCKeepsWhatIsDoneAndSaysHowToGoOn) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const int done = signal == SIGINT ? 2 : 5;
    Command study(stuck_after(done, study_line) + out(), place_);
    await_done(done);
    study.send(signal);
    const Ended end = study.wait();
    EXPECT_EQ(end.code, 130);
    EXPECT_TRUE(contains(end.err, "give the same command again to go on"));
    EXPECT_EQ(count("status = 'done'"), done);
    EXPECT_EQ(count("status = 'running'"), 0);
  }
  expect_resumes(finished());
}

// As when the system shuts down: runs may be ended before the command that waits for them, also the last two, after
// which none is waiting.
TEST_F(Interruption, RunsThatAreEndedWithTheirCommandHaveNotFailed) {
  for (const int done : {2, 14}) {
    Command study(stuck_after(done, study_line) + out(), place_);
    await_done(done);
    const std::set<pid_t> runs = runs_in_flight();
    EXPECT_EQ(runs.size(), 2U);
    for (const pid_t process : runs) kill(process, SIGTERM);
    study.send(SIGTERM);
    const Ended end = study.wait();
    EXPECT_EQ(end.code, 130);
    EXPECT_TRUE(contains(end.err, "give the same command again to go on"));
    EXPECT_EQ(count("status = 'failed'"), 0);
    EXPECT_EQ(count("status = 'running'"), 0);
  }
  expect_resumes(finished());
}

TEST_F(Interruption, AKilledStudyGoesOn) {
  Command study(stuck_after(3, study_line) + out(), place_);
  await_done(3);
  study.send(SIGKILL);
  EXPECT_EQ(study.wait().code, 128 + SIGKILL);
  EXPECT_EQ(count("status = 'done'"), 3);
  expect_resumes(finished());
}

TEST_F(Interruption, AKilledBatchGoesOnWithTheSamePoints) {
  const std::string points =
      "SELECT group_concat(kind || quote(x) || quote(y) || seed || quote(cost_predicted)) FROM runs";
  const std::string adaptive = study_line + " --adaptive 6 --batch 6";
  ASSERT_EQ(run(adaptive + out()).code, 0);
  const std::string whole = query(points);
  std::filesystem::remove_all(dir());
  Command study(stuck_after(18, adaptive) + out(), place_);
  await_done(18);  // two of the batch
  study.send(SIGKILL);
  study.wait();
  EXPECT_EQ(count("status = 'done'"), 18);
  ASSERT_EQ(run(study_line + out()).code, 0);
  EXPECT_EQ(count("status = 'done'"), 22);
  EXPECT_EQ(query(points), whole);
}

TEST_F(Interruption, AKilledRoundIsFinishedAndJudged) {
  const std::string points =
      "SELECT group_concat(kind || quote(x) || quote(y) || quote(cost_predicted)) FROM runs";
  const std::string confirm = TROUBLED_STUDY " confirm --points 5 --rounds 1 --jobs 2";
  ASSERT_EQ(run(study_line + out()).code, 0);
  std::filesystem::copy(dir(), place_ / "copy", std::filesystem::copy_options::recursive);
  const Ended whole = run(confirm + out());
  ASSERT_EQ(whole.code, 0) << whole.err;
  const std::string all = query(points);
  std::filesystem::remove_all(dir());
  std::filesystem::rename(place_ / "copy", dir());
  Command command(stuck_after(18, confirm) + out(), place_);
  await_done(18);  // two of the round
  command.send(SIGKILL);
  command.wait();
  EXPECT_EQ(count("status = 'done'"), 18);
  const Ended rest = run(confirm + out());
  EXPECT_EQ(query(points), all);
  const auto verdict = [](const Ended& ended) {
    const auto at = ended.out.find("round 1: 5 points, ");
    return ended.out.substr(at, ended.out.find('\n', at) - at);
  };
  EXPECT_EQ(verdict(rest), verdict(whole));
}

TEST_F(Interruption, OnlyOneProcessWorksInAFolder) {
  Command study(stuck_after(1, study_line) + out(), place_);
  await_done(1);
  const Ended second = run(study_line + out());
  EXPECT_EQ(second.code, 1);
  EXPECT_TRUE(contains(second.err, "is working in " + dir().string()));
  const Ended status = run(TROUBLED_STUDY " status --json" + out());
  EXPECT_EQ(status.code, 0);
  EXPECT_EQ(status.json()["training"]["done"], 1);
  study.send(SIGINT);
  EXPECT_EQ(study.wait().code, 130);
}

}  // namespace
