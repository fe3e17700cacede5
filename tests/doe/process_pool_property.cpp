// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A program as a black box: points and seeds reach it to the bit, its values come back, and whatever goes wrong is
/// a failed run with a reason. The programs are lines for the shell.

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/process_pool.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

/// What the shell does with the point as $1, $2, ... and the seed as the last.
ProcessFunction shell(const std::string& script, ProcessPoolOptions options = {}) {
  return process_pool({"sh", "-c", script, "run", "{x}", "{seed}"}, std::move(options));
}

std::string reason_of(const std::string& script, ProcessPoolOptions options = {}) {
  const Eigen::MatrixXd X{{0.25, 0.5}};
  const Evaluations runs = evaluate(shell(script, std::move(options)), support::unit_problem(2), X);
  EXPECT_TRUE(runs.rows.front().outcome.failed());
  return runs.rows.front().outcome.reason();
}

TEST(ProcessPool, PointsAndSeedsGoOutAndValuesComeBackToTheBit) {
  const Problem problem = support::unit_problem(2, 3, Goal::record);
  const Eigen::MatrixXd X = uniform_random(problem, 12);
  for (const int jobs : {1, 3}) {
    const Evaluations runs = evaluate(shell("echo $1, $2 $3 >&3", {.jobs = jobs}), problem, X);
    for (const Evaluation& row : runs.rows) {
      ASSERT_FALSE(row.outcome.failed()) << row.outcome.reason();
      EXPECT_EQ(row.outcome.values().head(2), row.x);
      EXPECT_EQ(row.outcome.values()[2], static_cast<double>(row.seed));
    }
  }
}

TEST(ProcessPool, WordsOfTheCommandTakeThePointWhereTheySayIt) {
  const std::vector<std::string> words =
      detail::filled_in({"simulate", "--x={x}", "{x}", "--seed={seed}"}, Eigen::Vector2d(0.1, -2.0), 7);
  EXPECT_EQ(words, (std::vector<std::string>{"simulate", "--x=0.1,-2", "0.1", "-2", "--seed=7"}));
}

TEST(ProcessPool, WhateverEndsARunIsItsReason) {
  EXPECT_EQ(reason_of("echo failure the bucket is stuck >&3; exit 1"), "the bucket is stuck");
  EXPECT_EQ(reason_of("exit 3"), "the run's process ended with exit code 3");
  EXPECT_EQ(reason_of("echo 1 >&3; exit 3"), "the run's process ended with exit code 3");
  EXPECT_EQ(reason_of("echo 1"),
            "the run's process ended with exit code 0 without values on file descriptor 3");
  EXPECT_EQ(reason_of("echo one >&3"),
            "the run's process ended with exit code 0 and wrote what are no numbers");
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([] { reason_of("echo 1 2 >&3"); }),
      "doe::evaluate: the black box returned 2 values where the problem has 1 responses; return one value "
      "per response, in the order of Problem::responses");
  EXPECT_EQ(reason_of("kill -SEGV $$"), "the run's process ended by signal SIGSEGV (Segmentation fault)");
  EXPECT_EQ(reason_of("echo 1 >&3; sleep 30", {.time_limit = 0.1}),
            "the run's process stopped after 0.1 s, its time limit");
  const Eigen::MatrixXd X{{0.5}};
  const Evaluations none = evaluate(process_pool({"/no/such/program", "{x}"}), support::unit_problem(1), X);
  EXPECT_EQ(none.rows.front().outcome.reason(),
            "the run's process could not be started: No such file or directory");
}

// One response of 3.14 or two of 3 and 14: nobody can tell.
TEST(ProcessPool, ADecimalCommaFailsTheRun) {
  for (const char* text : {"3,14", "1 2,5", "10,20,30", "1,5e-05"})
    EXPECT_NE(reason_of("echo " + std::string(text) + " >&3").find("decimal comma"), std::string::npos)
        << text;
  for (const char* text : {"3,", "3.0", "3e0", "3"}) {
    const Eigen::MatrixXd X{{0.5}};
    const Evaluations runs =
        evaluate(shell("echo " + std::string(text) + " >&3"), support::unit_problem(1), X);
    EXPECT_EQ(runs.rows.front().outcome.values()[0], 3.0) << text;
  }
}

TEST(ProcessPool, WhatARunPrintsIsKept) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("process_pool_" + std::to_string(::getpid()));
  EXPECT_EQ(reason_of("echo before the end; exit 2", {.output = folder}),
            "the run's process ended with exit code 2; it printed " + (folder / "0001.txt").string());
  std::ifstream file(folder / "0001.txt");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "before the end\n");
  std::filesystem::remove_all(folder);
}

TEST(ProcessPool, AStopEndsWhatRuns) {
  std::stop_source stop;
  const auto start = std::chrono::steady_clock::now();
  std::jthread soon([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop.request_stop();
  });
  const ProcessFunction f = shell("sleep 60", {.jobs = 2, .stop = stop.get_token()});
  const Evaluations runs = evaluate(f, support::unit_problem(2), Eigen::MatrixXd::Constant(5, 2, 0.5));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(runs.failed(), 5);
  EXPECT_EQ(runs.rows.back().outcome.reason(), "not run: stopped");
}

TEST(ProcessPool, AFaultyCommandIsRefused) {
  using support::thrown_text;
  EXPECT_EQ(thrown_text<std::invalid_argument>([] { process_pool({}); }),
            "doe::process_pool: the command is empty; name a program");
  EXPECT_EQ(thrown_text<std::invalid_argument>([] { process_pool({"./simulate"}); }),
            "doe::process_pool: no word of the command holds {x}; say where the point goes, such as --x={x}");
  EXPECT_EQ(thrown_text<std::invalid_argument>([] {
              process_pool({"f", "{x}"}, {.jobs = -1});
            }),
            "doe::process_pool: jobs is -1; allowed is 0 or more; 0 means all cores");
  EXPECT_EQ(thrown_text<std::invalid_argument>([] {
              process_pool({"f", "{x}"}, {.time_limit = 0.0});
            }),
            "doe::process_pool: time_limit is 0 s; allowed is a time above 0 s");
}

}  // namespace
