// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <set>
#include <thread>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

using std::chrono::milliseconds;

double sum(const Eigen::VectorXd& x) { return x.sum(); }

/// Works for up to a minute, and looks at the token each millisecond.
Outcome patient(const Eigen::VectorXd& x, Seed, std::stop_token stop) {
  if (x[0] < 0.5) return x[0];
  for (int k = 0; k < 60000 && !stop.stop_requested(); ++k) std::this_thread::sleep_for(milliseconds(1));
  return 1e9;
}

static_assert(StoppableFunction<decltype(&patient)> && BlackBox<decltype(&patient)>);

TEST(EvaluateControl, CommonRandomNumbersDependOnTheReplicateAlone) {
  const Problem problem = support::unit_problem(1);
  const Evaluations table = evaluate(sum, problem, uniform_random(problem, 20),
                                     {.replicates = 3, .first_run = 5, .common_random_numbers = true});
  std::set<Seed> seeds;
  for (const Evaluation& row : table.rows) {
    seeds.insert(row.seed);
    EXPECT_EQ(row.seed, table.rows[static_cast<std::size_t>(row.replicate)].seed);
  }
  EXPECT_EQ(seeds.size(), 3U);
}

TEST(EvaluateControl, BatchesAreOfTheSizeAskedFor) {
  const Problem problem = support::unit_problem(2);
  const Eigen::MatrixXd X = uniform_random(problem, 25);
  std::vector<Eigen::Index> sizes;
  const auto batch = [&sizes](const Eigen::MatrixXd& points, std::span<const Seed>) {
    sizes.push_back(points.rows());
    std::vector<Outcome> outcomes;
    for (const auto& x : points.rowwise()) outcomes.emplace_back(x.sum());
    return outcomes;
  };
  const Evaluations table = evaluate(batch, problem, X, {.batch_size = 10});
  EXPECT_EQ(sizes, (std::vector<Eigen::Index>{10, 10, 5}));
  EXPECT_EQ(table.y("f0"), X.rowwise().sum());
}

TEST(EvaluateControl, ProgressCountsEveryRunOnce) {
  const Problem problem = support::unit_problem(2);
  const auto f = [](const Eigen::VectorXd& x) -> Outcome {
    if (x[0] < 0.3) return Failure{"stuck"};
    return x[0];
  };
  std::vector<EvaluateProgress> seen;
  EvaluateOptions options{.threads = 4, .replicates = 2};
  options.progress = [&seen](const EvaluateProgress& p) { seen.push_back(p); };
  const Evaluations table = evaluate(f, problem, uniform_random(problem, 30), options);
  ASSERT_EQ(seen.size(), 60U);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_EQ(seen[k].done, static_cast<std::int64_t>(k + 1));
    EXPECT_EQ(seen[k].total, 60);
    EXPECT_GE(seen[k].seconds, k ? seen[k - 1].seconds : 0.0);
    EXPECT_GE(seen[k].seconds_left, 0.0);
  }
  EXPECT_EQ(seen.back().failed, table.failed());
  EXPECT_EQ(seen.back().seconds_left, 0.0);
}

// The limit is 0.2 s and the function would work for a minute: it ends early only because it is asked to.
TEST(EvaluateControl, AStoppableRunIsAskedToEndAtTheLimit) {
  const Problem problem = support::unit_problem(1);
  const auto start = std::chrono::steady_clock::now();
  const Evaluations table =
      evaluate(patient, problem, Eigen::Vector3d(0.1, 0.9, 0.8), {.threads = 2, .time_limit = 0.2});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_EQ(table.rows[0].outcome.values()[0], 0.1);
  for (const std::size_t i : {1U, 2U}) {
    const std::string& reason = table.rows[i].outcome.reason();
    ASSERT_TRUE(reason.starts_with("took ")) << reason;
    // Said with three digits, so it may round to the limit itself.
    EXPECT_GE(std::stod(reason.substr(5)), 0.2) << reason;
    EXPECT_TRUE(reason.ends_with(" s, over the time limit of 0.2 s")) << reason;
    EXPECT_GT(table.rows[i].seconds, 0.2);
  }
}

TEST(EvaluateControl, ALateRunOfAnyFunctionIsAFailure) {
  const Problem problem = support::unit_problem(1);
  const auto slow = [](const Eigen::VectorXd& x) {
    std::this_thread::sleep_for(milliseconds(x[0] > 0.5 ? 60 : 0));
    return x[0];
  };
  const Evaluations table = evaluate(slow, problem, Eigen::Vector2d(0.1, 0.9), {.time_limit = 0.05});
  EXPECT_TRUE(table.rows[1].outcome.failed());
  EXPECT_TRUE(table.rows[1].outcome.reason().ends_with("over the time limit of 0.05 s"));
  // The other run is late only where a thread is put off for 50 ms; then it must say so.
  EXPECT_EQ(table.rows[0].outcome.failed(), table.rows[0].seconds > 0.05);
}

TEST(EvaluateControl, CancellingKeepsWhatIsDoneAndAsksWhatRuns) {
  const Problem problem = support::unit_problem(1);
  std::stop_source cancel;
  EvaluateOptions options{.threads = 2, .stop = cancel.get_token()};
  options.on_result = [&cancel](const Evaluation& row) {
    if (row.x[0] == 0.2) cancel.request_stop();
  };
  Eigen::MatrixXd X(6, 1);
  X << 0.9, 0.1, 0.2, 0.95, 0.3, 0.4;  // the first blocks a thread until the third has cancelled
  const auto stuck_is_failed = [](const Eigen::VectorXd& x, Seed seed, std::stop_token stop) -> Outcome {
    Outcome outcome = patient(x, seed, stop);
    if (stop.stop_requested()) return Failure{"asked to stop"};
    return outcome;
  };
  const Evaluations table = evaluate(stuck_is_failed, problem, X, options);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].x[0], 0.1);
  EXPECT_EQ(table.rows[1].x[0], 0.2);
}

TEST(EvaluateControl, AStudyCancelledBeforeItBeginsMakesNoRun) {
  const Problem problem = support::unit_problem(1);
  std::stop_source cancel;
  cancel.request_stop();
  EXPECT_TRUE(evaluate(sum, problem, uniform_random(problem, 5), {.stop = cancel.get_token()}).rows.empty());
  EXPECT_TRUE(
      evaluate(patient, problem, uniform_random(problem, 5), {.stop = cancel.get_token()}).rows.empty());
}

TEST(EvaluateControl, BadInputIsNamed) {
  const Problem problem = support::unit_problem(1);
  const auto text = [&](const EvaluateOptions& options) {
    return support::thrown_text<std::invalid_argument>(
        [&] { evaluate(sum, problem, uniform_random(problem, 2), options); });
  };
  EXPECT_EQ(text({.time_limit = 0.0}),
            "doe::evaluate: time_limit is 0 s; allowed is a time above 0 s; leave it out for no limit");
  EXPECT_EQ(text({.batch_size = 0}), "doe::evaluate: batch_size is 0; allowed is 1 or more");
}

}  // namespace
