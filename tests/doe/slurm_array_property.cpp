// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A program as a black box on a Slurm cluster, a real one on the loopback device: outcomes are those of a
/// pool of processes, lost nodes cost time only, and who comes after a dead caller goes on with its tasks.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/process_pool.hpp>
#include <drawpoint/doe/slurm_array.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/support/slurm_cluster.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <thread>

using namespace drawpoint;
using namespace drawpoint::doe;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

constexpr int nodes = 2;

class SlurmArray : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = fs::temp_directory_path() / ("slurm_array_" + std::to_string(::getpid()));
    cluster_ = std::make_unique<support::SlurmCluster>(place_ / "cluster", nodes);
  }
  static void TearDownTestSuite() {
    cluster_.reset();
    fs::remove_all(place_);
  }

  static SlurmOptions options() { return {.folder = place_ / "tasks", .poll = 0.5, .reply_delay = 1.0}; }
  static std::vector<std::string> shell(const std::string& script) {
    return {"sh", "-c", script, "run", "{x}", "{seed}"};
  }
  static std::string reason_of(const std::string& script, SlurmArrayOptions given = {}) {
    given.slurm = options();
    const Eigen::MatrixXd X{{0.25, 0.5}};
    const Evaluations runs = evaluate(slurm_array(shell(script), given), support::unit_problem(2), X);
    EXPECT_TRUE(runs.rows.front().outcome.failed());
    return runs.rows.front().outcome.reason();
  }
  /// A reply is there before Slurm has closed the books on its task.
  static void expect_nothing_left() {
    EXPECT_TRUE(fs::is_empty(place_ / "tasks"));
    cluster_->await([] { return cluster_->tasks() == 0; });
  }
  /// A process that counts its starts in place_/ID.
  static Process counted(int id, const std::string& rest) {
    const std::string file = (place_ / std::to_string(id)).string();
    return {.id = id, .executable = "sh", .arguments = {"-c", "echo start >>" + file + "; " + rest}};
  }
  static int starts(int id) {
    int lines = 0;
    for (const char c : support::contents(place_ / std::to_string(id))) lines += c == '\n';
    return lines;
  }

  static inline fs::path place_;
  static inline std::unique_ptr<support::SlurmCluster> cluster_;
};

TEST_F(SlurmArray, OutcomesAreThoseOfAPoolOfProcesses) {
  const Problem problem = support::unit_problem(2, 3, Goal::record);
  const Eigen::MatrixXd X = uniform_random(problem, 12);
  const std::vector<std::string> command = shell("echo $1, $2 $3 >&3; echo \"it's $1\"");
  const Evaluations here = evaluate(process_pool(command), problem, X);
  const Evaluations there = evaluate(slurm_array(command, {.slurm = options()}), problem, X);
  EXPECT_EQ(there.failed(), 0);
  for (std::size_t k = 0; k < here.rows.size(); ++k)
    EXPECT_EQ(there.rows[k].outcome.values(), here.rows[k].outcome.values());
  expect_nothing_left();
}

TEST_F(SlurmArray, WhateverEndsARunIsItsReason) {
  EXPECT_EQ(reason_of("echo failure the bucket is stuck >&3; exit 1"), "the bucket is stuck");
  EXPECT_EQ(reason_of("exit 3"), "the run's process ended with exit code 3");
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([] { reason_of("echo 1 2 >&3"); }),
      "doe::evaluate: the black box returned 2 values where the problem has 1 responses; return one value "
      "per response, in the order of Problem::responses");
  EXPECT_EQ(reason_of("exit 255"), "the run's process ended with exit code 255");
  EXPECT_EQ(reason_of("kill -SEGV $$"), "the run's process ended by signal SIGSEGV (Segmentation fault)");
  EXPECT_EQ(reason_of("kill -KILL $$"),
            "the run's process ended by signal SIGKILL (Killed), often because memory ran out");
  EXPECT_EQ(reason_of("echo 1 >&3; sleep 30", {.time_limit = 0.5}),
            "the run's process stopped after 0.5 s, its time limit");
  EXPECT_EQ(reason_of("echo before the end; exit 2", {.output = place_ / "printed"}),
            "the run's process ended with exit code 2; it printed " + (place_ / "printed/0001.txt").string());
}

TEST_F(SlurmArray, WhoGoesOnForADeadCallerTakesItsTasksOver) {
  const auto start_all = [&](SlurmJobs& jobs) {
    jobs.start(counted(1, "echo 1 >&3"));
    jobs.start(counted(2, "sleep 6; echo 2 >&3"));
  };
  const pid_t caller = fork();
  if (caller == 0) {
    SlurmJobs jobs(options());
    start_all(jobs);
    while (jobs.wait(100ms).empty()) {
    }
    while (true) std::this_thread::sleep_for(1s);  // with the end of 1 in hand, and nobody told
  }
  cluster_->await([&] { return starts(2) == 1; });
  kill(caller, SIGKILL);
  waitpid(caller, nullptr, 0);
  SlurmJobs jobs(options());
  start_all(jobs);
  std::vector<ProcessEnd> ends;
  while (jobs.running() > 0)
    for (const ProcessEnd& end : jobs.wait(1s)) ends.push_back(end);
  jobs.forget();
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_EQ(ends[0].reply + ends[1].reply, "1\n2\n");
  EXPECT_GE(ends[1].seconds, 6.0);
  EXPECT_EQ(starts(1) + starts(2), 2);
  expect_nothing_left();
}

TEST_F(SlurmArray, WhatWasDealtWithIsMadeAgainForWhoStartsItAgain) {
  {
    SlurmJobs jobs(options());
    jobs.start(counted(21, "echo 21 >&3"));
    jobs.start(counted(22, "sleep 60"));
    while (jobs.wait(1s).empty()) {
    }
    jobs.wait(1ms);
  }
  {
    SlurmJobs jobs(options());
    jobs.start(counted(21, "echo 21 >&3"));
    jobs.start(counted(22, "sleep 60"));
    const std::vector<ProcessEnd> ends = jobs.wait(30s);
    ASSERT_EQ(ends.size(), 1U);
    EXPECT_EQ(starts(21), 2);
    EXPECT_EQ(starts(22), 1);
    jobs.discard(21);
  }
  SlurmJobs jobs(options());
  jobs.start(counted(21, "echo 21 >&3"));
  jobs.start(counted(22, "sleep 60"));
  EXPECT_EQ(jobs.wait(30s).size(), 1U);
  EXPECT_EQ(starts(21), 3);
  jobs.cancel();
  expect_nothing_left();
}

TEST_F(SlurmArray, WhatNobodyGoesOnWithIsCancelled) {
  {
    SlurmJobs jobs(options());
    jobs.start(counted(3, "sleep 60"));
    jobs.wait(100ms);
    cluster_->await([&] { return starts(3) == 1; });
  }
  SlurmJobs jobs(options());
  jobs.start(counted(4, "echo 4 >&3"));
  while (jobs.running() > 0) jobs.wait(1s);
  jobs.forget();
  expect_nothing_left();
}

TEST_F(SlurmArray, AStopCancelsWhatRuns) {
  std::stop_source stop;
  std::jthread soon([&] {
    std::this_thread::sleep_for(1s);
    stop.request_stop();
  });
  const auto f = slurm_array(shell("sleep 60"), {.slurm = options(), .stop = stop.get_token()});
  const Evaluations runs = evaluate(f, support::unit_problem(2), Eigen::MatrixXd::Constant(5, 2, 0.5));
  EXPECT_EQ(runs.rows.back().outcome.reason(), "not run: stopped");
  expect_nothing_left();
}

TEST_F(SlurmArray, ATaskThatSomebodyCancelsHasFailedAndSaysSo) {
  SlurmJobs jobs(options());
  jobs.start(counted(5, "sleep 60"));
  jobs.wait(100ms);
  cluster_->await([&] { return starts(5) == 1; });
  detail::cancel_array(*jobs.arrays().begin());
  std::vector<ProcessEnd> ends;
  while (jobs.running() > 0) ends = jobs.wait(1s);
  jobs.forget();
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(describe(ends[0]),
            "ended without a reply, Slurm's state CANCELLED: somebody cancelled it, as by scancel");
  expect_nothing_left();
}

/// A stand-in for squeue that gives a cancelled task another of Slurm's last words: no memory can run out here, for
/// that takes cgroups, and Slurm's time limits are whole minutes.
TEST_F(SlurmArray, WhatSlurmEndsATaskForIsToldApart) {
  const std::map<std::string, std::string> meanings = {
      {"OUT_OF_MEMORY", ": it needed more memory than Slurm gives it; ask for more with --mem"},
      {"TIMEOUT", ": Slurm's time limit ended it; ask for more with --time"},
      {"DEADLINE", ": its deadline passed"}};
  const std::string path = std::getenv("PATH");
  int id = 80;
  for (const auto& [state, meaning] : meanings) {
    const fs::path bin = place_ / state;
    fs::create_directories(bin);
    std::ofstream(bin / "squeue") << "#!/bin/sh\n/usr/bin/squeue \"$@\" | sed 's/ CANCELLED / " + state +
                                         " /'\n";
    fs::permissions(bin / "squeue", fs::perms::owner_all);
    SlurmJobs jobs(options());
    jobs.start(counted(++id, "sleep 60"));
    jobs.wait(100ms);
    cluster_->await([&] { return starts(id) == 1; });
    setenv("PATH", (bin.string() + ":" + path).c_str(), 1);
    detail::cancel_array(*jobs.arrays().begin());
    std::vector<ProcessEnd> ends;
    while (jobs.running() > 0) ends = jobs.wait(1s);
    jobs.forget();
    setenv("PATH", path.c_str(), 1);
    ASSERT_EQ(ends.size(), 1U);
    EXPECT_EQ(describe(ends[0]), "ended without a reply, Slurm's state " + state + meaning);
    EXPECT_EQ(starts(id), 1) << "it is not tried again";
  }
  expect_nothing_left();
}

// Each of these hid tasks from squeue, had sbatch wait, or held what was submitted.
TEST_F(SlurmArray, TheEnvironmentDoesNotChangeWhatItsCommandsDo) {
  const std::vector<std::pair<const char*, const char*>> variables = {
      {"SQUEUE_PARTITION", "other"}, {"SQUEUE_STATES", "PENDING"}, {"SQUEUE_USERS", "nobody"},
      {"SBATCH_WAIT", "1"},          {"SBATCH_PARTITION", "none"}, {"SBATCH_HOLD", "1"},
      {"SCANCEL_STATE", "PENDING"},  {"SQUEUE_FORMAT", "%i"},      {"SBATCH_CLUSTERS", "far"}};
  for (const auto& [name, value] : variables) setenv(name, value, 1);
  SlurmJobs jobs(options());
  for (int id = 41; id <= 43; ++id) jobs.start(counted(id, "echo " + std::to_string(id) + " >&3"));
  std::map<std::int64_t, std::string> replies;
  while (jobs.running() > 0)
    for (const ProcessEnd& end : jobs.wait(1s)) replies[end.id] = end.reply;
  jobs.forget();
  for (const auto& [name, value] : variables) unsetenv(name);
  EXPECT_EQ(replies, (std::map<std::int64_t, std::string>{{41, "41\n"}, {42, "42\n"}, {43, "43\n"}}));
  EXPECT_EQ(starts(41) + starts(42) + starts(43), 3);
  expect_nothing_left();
}

/// A stand-in for sbatch that takes no more than two tasks at a time, as a limit on submitted jobs does.
TEST_F(SlurmArray, WhereSlurmRefusesAnArrayHalfOfItIsTried) {
  fs::create_directories(place_ / "bin");
  std::ofstream(place_ / "bin" / "sbatch")
      << "#!/bin/sh\nfor word; do case $word in --array=0-*) last=${word#--array=0-}; esac; done\n"
         "if [ \"${last%%%*}\" -gt 1 ]; then echo QOSMaxSubmitJobPerUserLimit >&2; exit 1; fi\n"
         "exec /usr/bin/sbatch \"$@\"\n";
  fs::permissions(place_ / "bin" / "sbatch", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", ((place_ / "bin").string() + ":" + path).c_str(), 1);
  SlurmJobs jobs(options());
  for (int id = 51; id <= 57; ++id) jobs.start(counted(id, "echo done >&3"));
  std::size_t done = 0;
  while (jobs.running() > 0)
    for (const ProcessEnd& end : jobs.wait(1s)) done += end.reply == "done\n";
  jobs.forget();
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(done, 7u);
  expect_nothing_left();
}

/// A stand-in for squeue that knows of no task: each is taken for lost while it is at work.
TEST_F(SlurmArray, AReplyCountsHoweverLateItComes) {
  fs::create_directories(place_ / "blind");
  std::ofstream(place_ / "blind" / "squeue") << "#!/bin/sh\n";
  fs::permissions(place_ / "blind" / "squeue", fs::perms::owner_all);
  SlurmOptions hasty = options();
  hasty.reply_delay = 0.5;
  hasty.submissions = 100;
  SlurmJobs jobs(hasty);
  jobs.start(counted(71, "sleep 4; echo done >&3"));
  std::vector<ProcessEnd> ends;
  while (starts(71) == 0 && jobs.running() > 0)
    for (const ProcessEnd& end : jobs.wait(100ms)) ends.push_back(end);
  const std::string path = std::getenv("PATH");
  setenv("PATH", ((place_ / "blind").string() + ":" + path).c_str(), 1);
  std::size_t arrays = 0;
  while (jobs.running() > 0) {
    for (const ProcessEnd& end : jobs.wait(1s)) ends.push_back(end);
    arrays = std::max(arrays, jobs.arrays().size());
  }
  jobs.forget();
  setenv("PATH", path.c_str(), 1);
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends[0].reply, "done\n") << describe(ends[0]);
  EXPECT_GT(arrays, 1u) << "it was submitted again";
  expect_nothing_left();
}

TEST_F(SlurmArray, ArraysAreAsSmallAsIsAsked) {
  SlurmOptions small = options();
  small.per_array = 2;
  SlurmJobs jobs(small);
  for (int id = 61; id <= 65; ++id) jobs.start(counted(id, "sleep 1; echo done >&3"));
  jobs.wait(100ms);
  EXPECT_EQ(jobs.arrays().size(), 3u);
  while (jobs.running() > 0) jobs.wait(1s);
  jobs.forget();
  expect_nothing_left();
}

// Slurm is to begin in an hour: it says so, and so does whoever asks. Slurm takes in a job first and finds why it
// waits when its scheduler next looks.
TEST_F(SlurmArray, WhatWaitsSaysWhy) {
  SlurmOptions later = options();
  later.options = {"--begin=now+1hour"};
  SlurmJobs jobs(later);
  for (int id = 31; id <= 33; ++id) jobs.start(counted(id, "true"));
  EXPECT_EQ(jobs.standing(), "");
  const auto not_looked_yet = [&] {
    const std::string standing = jobs.standing();
    return standing.empty() || standing == "0 at work, 3 waiting";
  };
  const auto patience = std::chrono::steady_clock::now() + 60s;
  while (not_looked_yet() && std::chrono::steady_clock::now() < patience) jobs.wait(1s);
  EXPECT_EQ(jobs.standing(), "0 at work, 3 waiting (BeginTime)");
  jobs.cancel();
  EXPECT_EQ(jobs.standing(), "");
  expect_nothing_left();
}

// Last, because it takes a node away.
TEST_F(SlurmArray, TasksOfALostNodeAreSubmittedAgain) {
  SlurmJobs jobs(options());
  for (int id = 11; id <= 14; ++id)
    jobs.start(counted(id, "sleep 4; echo $((10 * " + std::to_string(id) + ")) >&3"));
  jobs.wait(100ms);
  cluster_->await([&] { return starts(11) + starts(12) + starts(13) + starts(14) == 4; });
  cluster_->lose(2);
  std::map<std::int64_t, std::string> replies;
  while (jobs.running() > 0)
    for (const ProcessEnd& end : jobs.wait(1s)) replies[end.id] = end.reply;
  jobs.forget();
  EXPECT_EQ(replies, (std::map<std::int64_t, std::string>{
                         {11, "110\n"}, {12, "120\n"}, {13, "130\n"}, {14, "140\n"}}));
  EXPECT_EQ(starts(11) + starts(12) + starts(13) + starts(14), 6);  // two of them were on the lost node
  expect_nothing_left();
}

TEST(SlurmJobs, FaultyOptionsAreRefused) {
  using support::thrown_text;
  EXPECT_EQ(thrown_text<std::invalid_argument>([] { slurm_array({"./simulate"}, {}); }),
            "doe::slurm_array: no word of the command holds {x}; say where the point goes, such as --x={x}");
  EXPECT_EQ(thrown_text<std::invalid_argument>([] { SlurmJobs jobs({}); }),
            "doe::SlurmJobs: no folder; name one that all nodes reach");
  EXPECT_EQ(thrown_text<std::invalid_argument>([] { SlurmJobs jobs({.folder = "f", .submissions = 0}); }),
            "doe::SlurmJobs: submissions is 0; allowed is 1 or more");
  EXPECT_EQ(
      thrown_text<std::invalid_argument>([] { SlurmJobs jobs({.folder = "f", .options = {"-Mfar"}}); }),
      "doe::SlurmJobs: -Mfar is for sbatch alone, and squeue would not find the tasks; set SLURM_CLUSTERS, "
      "which all commands of Slurm follow");
}

}  // namespace
