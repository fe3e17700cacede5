// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <limits>
#include <new>
#include <set>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

/// A noisy formula that fails in every way that a run can fail, depending on the point.
Outcome troubled(const Eigen::VectorXd& x, Seed seed) {
  RandomStream random(seed);
  const double y = x.squaredNorm() + 0.1 * random.normal();
  if (x[0] < 0.1) return Failure{"stuck at the \"toe\", twice"};
  if (x[0] < 0.2) throw std::runtime_error("diverged");
  if (x[0] < 0.3) throw 42;
  if (x[0] < 0.4) return {y, std::numeric_limits<double>::quiet_NaN()};
  if (x[0] < 0.5) return {y, -std::numeric_limits<double>::infinity()};
  if (x[0] < 0.6) return {y, 1.0, 2.0};
  return {y, x[1]};
}

void expect_equal(const Evaluation& a, const Evaluation& b) {
  EXPECT_EQ(a.run, b.run);
  EXPECT_EQ(a.replicate, b.replicate);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.outcome.failed(), b.outcome.failed());
  EXPECT_EQ(a.outcome.reason(), b.outcome.reason());
  EXPECT_TRUE(a.outcome.values().size() == b.outcome.values().size() &&
              a.outcome.values() == b.outcome.values());
}

TEST(Evaluate, OneTwoAndEightThreadsGiveTheSameTable) {
  const Problem problem = support::unit_problem(2, 2);
  const Eigen::MatrixXd X = uniform_random(problem, 100, {.seed = 5});
  const Evaluations one = evaluate(troubled, problem, X, {.seed = 9, .threads = 1, .replicates = 3});
  ASSERT_EQ(one.rows.size(), 300U);
  for (const int threads : {0, 2, 8}) {  // 0: all cores
    const Evaluations many = evaluate(troubled, problem, X, {.seed = 9, .threads = threads, .replicates = 3});
    ASSERT_EQ(many.rows.size(), one.rows.size());
    for (std::size_t i = 0; i < one.rows.size(); ++i) expect_equal(one.rows[i], many.rows[i]);
  }
}

/// Bounds of 0 and 1, 0 alone, and 100 alone: the tolerance is 2.3e-13 of the larger bound, or of one unit.
TEST(Evaluate, ABoundIsMissedByMoreThanRoundOff) {
  const auto one = [](double lower, double upper, double value) {
    Problem problem = support::unit_problem(1, 1);
    problem.responses[0].lower = lower;
    problem.responses[0].upper = upper;
    return evaluate([=](const Eigen::VectorXd&) { return value; }, problem, Eigen::MatrixXd{{0.5}})
        .rows.front()
        .outcome;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(one(0, 1, -1.1e-16).values()[0], 0.0);
  EXPECT_EQ(one(0, infinity, 1 - 0.9 - 0.1).values()[0], 0.0);
  EXPECT_EQ(one(0, 1, 1 + 2e-16).values()[0], 1.0);
  EXPECT_EQ(one(0, 1, 0.3).values()[0], 0.3);
  EXPECT_EQ(one(-infinity, 100, 100 + 2e-11).values()[0], 100.0);
  EXPECT_TRUE(one(0, 1, -1e-12).failed());
  EXPECT_TRUE(one(0, 1e-6, -1e-16).failed()) << "the scale is that of the bounds";
  EXPECT_TRUE(one(-infinity, 100, 100 + 1e-9).failed());
}

TEST(Evaluate, WordsOfTheStandardLibraryAreNoReason) {
  const auto reason = [](auto f) {
    return evaluate(f, support::unit_problem(1, 1), Eigen::MatrixXd{{0.5}}).rows.front().outcome.reason();
  };
  EXPECT_EQ(reason([](const Eigen::VectorXd&) -> double { throw std::bad_alloc(); }),
            "memory ran out; make the run need less, or run fewer at a time");
  EXPECT_EQ(reason([](const Eigen::VectorXd&) -> double {
              return std::vector<double>(3).at(5);
            }).find("the black box reached beyond the end of a list or table: "),
            0u);
}

TEST(Evaluate, EveryKindOfFailureIsDataWithItsReason) {
  const Problem problem = support::unit_problem(2, 2);
  Eigen::MatrixXd X(7, 2);
  X << 0.05, 0, 0.15, 0, 0.25, 0, 0.35, 0, 0.45, 0, 0.65, 0.5, 0.55, 0;
  const Evaluations table = evaluate(troubled, problem, X);
  const std::vector<std::string> reasons{"stuck at the \"toe\", twice",
                                         "exception: diverged",
                                         "exception of a type that is not a std::exception",
                                         "response \"f1\" is nan",
                                         "response \"f1\" is -inf",
                                         "",
                                         "returned 3 values where the problem has 2 responses"};
  for (std::size_t i = 0; i < reasons.size(); ++i) EXPECT_EQ(table.rows[i].outcome.reason(), reasons[i]);
  EXPECT_EQ(table.failed(), 6);
  EXPECT_EQ(table.X(), X.row(5));
  EXPECT_EQ(table.y("f1")[0], 0.5);
}

// On however many threads: the first values in the order of the runs tell, which is row 2 here.
TEST(Evaluate, FirstValuesOfAWrongCountEndIt) {
  const Problem problem = support::unit_problem(2, 2);
  const std::string expected =
      "doe::evaluate: the black box returned 3 values where the problem has 2 responses; return one value "
      "per "
      "response, in the order of Problem::responses";
  Eigen::MatrixXd X(5, 2);
  X << 0.05, 0, 0.15, 0, 0.55, 0, 0.65, 0.5, 0.75, 0.5;
  for (const int threads : {1, 2, 8})
    EXPECT_EQ(support::thrown_text<std::invalid_argument>(
                  [&] { evaluate(troubled, problem, X, {.threads = threads}); }),
              expected);
  const auto batch = [](const Eigen::MatrixXd& points, std::span<const Seed>) {
    return std::vector<Outcome>(static_cast<std::size_t>(points.rows()), Outcome{1.0, 2.0, 3.0});
  };
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([&] { evaluate(batch, problem, X); }), expected);
}

TEST(Evaluate, SeedsDependOnStudyRunAndReplicateOnly) {
  const Problem problem = support::unit_problem(1);
  const auto f = [](const Eigen::VectorXd& x) { return x[0]; };
  const Eigen::MatrixXd X = uniform_random(problem, 20);
  const Evaluations all = evaluate(f, problem, X, {.seed = 4, .replicates = 2});
  const Evaluations later =
      evaluate(f, problem, X.bottomRows(15), {.seed = 4, .replicates = 2, .on_result = {}, .first_run = 5});
  std::set<Seed> seeds;
  for (const Evaluation& row : all.rows) seeds.insert(row.seed);
  EXPECT_EQ(seeds.size(), all.rows.size());
  for (std::size_t i = 0; i < later.rows.size(); ++i) expect_equal(later.rows[i], all.rows[i + 10]);
  EXPECT_NE(evaluate(f, problem, X, {.seed = 5}).rows[0].seed, all.rows[0].seed);
}

TEST(Evaluate, ABatchFunctionSeesAllRowsAtOnceAndAgreesWithThePointFunction) {
  const Problem problem = support::unit_problem(2, 2);
  const Eigen::MatrixXd X = uniform_random(problem, 50, {.seed = 5});
  int calls = 0;
  const auto batch = [&calls](const Eigen::MatrixXd& points, std::span<const Seed> seeds) {
    ++calls;
    std::vector<Outcome> outcomes;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      try {
        outcomes.push_back(troubled(points.row(i), seeds[i]));
      } catch (const std::exception& e) {
        outcomes.emplace_back(Failure{std::string("exception: ") + e.what()});
      } catch (...) {
        outcomes.emplace_back(Failure{"exception of a type that is not a std::exception"});
      }
    }
    return outcomes;
  };
  const Evaluations from_batch = evaluate(batch, problem, X, {.seed = 3, .replicates = 2});
  const Evaluations from_points = evaluate(troubled, problem, X, {.seed = 3, .replicates = 2});
  EXPECT_EQ(calls, 1);
  for (std::size_t i = 0; i < from_points.rows.size(); ++i)
    expect_equal(from_batch.rows[i], from_points.rows[i]);
}

TEST(Evaluate, ABatchThatThrowsOrMiscountsFailsAllItsRows) {
  const Problem problem = support::unit_problem(1);
  const Eigen::MatrixXd X = uniform_random(problem, 3);
  const auto short_batch = [](const Eigen::MatrixXd&, std::span<const Seed>) {
    return std::vector<Outcome>(2, Outcome(1.0));
  };
  const auto throwing = [](const Eigen::MatrixXd&, std::span<const Seed>) -> std::vector<Outcome> {
    throw std::runtime_error("the cluster is down");
  };
  for (const Evaluation& row : evaluate(short_batch, problem, X).rows)
    EXPECT_EQ(row.outcome.reason(), "the batch returned 2 outcomes for 3 points");
  for (const Evaluation& row : evaluate(throwing, problem, X).rows)
    EXPECT_EQ(row.outcome.reason(), "exception: the cluster is down");
}

TEST(Evaluate, ReportsEachRunOnceAndOneAtATime) {
  const Problem problem = support::unit_problem(2, 2);
  std::set<std::pair<std::int64_t, int>> seen;  // unguarded on purpose: the calls must not overlap
  EvaluateOptions options{.threads = 4, .replicates = 2};
  std::atomic<int> inside{0};
  options.on_result = [&](const Evaluation& row) {
    EXPECT_EQ(++inside, 1);
    EXPECT_TRUE(seen.emplace(row.run, row.replicate).second);
    --inside;
  };
  evaluate(troubled, problem, uniform_random(problem, 60, {.seed = 5}), options);
  EXPECT_EQ(seen.size(), 120U);
}

TEST(Evaluate, WhatTheReportThrowsStopsTheStudyAndIsPassedOn) {
  const Problem problem = support::unit_problem(2, 2);
  std::atomic<int> calls{0};
  const auto counted = [&calls](const Eigen::VectorXd& x) -> Outcome {
    ++calls;
    return {x[0], x[1]};
  };
  EvaluateOptions options{.threads = 2};
  options.on_result = [](const Evaluation&) { throw std::runtime_error("disk full"); };
  EXPECT_EQ(support::thrown_text<std::runtime_error>(
                [&] { evaluate(counted, problem, uniform_random(problem, 1000), options); }),
            "disk full");
  EXPECT_LE(calls, 1000);
  EXPECT_GE(calls, 1);
}

TEST(Evaluate, BadInputIsNamed) {
  const Problem problem = support::loader_problem();
  const auto f = [](const Eigen::VectorXd& x) -> Outcome { return {x[0], x[1]}; };
  Eigen::MatrixXd X = uniform_random(problem, 3);
  const auto text = [&](const EvaluateOptions& options = {}) {
    return support::thrown_text<std::invalid_argument>([&] { evaluate(f, problem, X, options); });
  };
  EXPECT_EQ(text({.threads = -1}), "doe::evaluate: threads is -1; allowed is 0 or more");
  EXPECT_EQ(text({.replicates = -1}), "doe::evaluate: replicates is -1; allowed is 1 or more");
  X(2, 0) = 7.5;
  EXPECT_EQ(
      text(),
      "doe::evaluate: row 2, variable \"lip_angle\": 7.5 deg is not within -25 deg to 5 deg; correct the "
      "point or the bounds");
  X(2, 0) = std::nan("");
  EXPECT_NE(text().find("row 2, variable \"lip_angle\": nan deg is not within"), std::string::npos);
  X.resize(3, 2);
  EXPECT_EQ(text(),
            "doe::evaluate: X has 2 columns, the problem has 3 variables; X is n x d with one run per row");
}

TEST(Evaluate, AFractionOfAnIntegerIsRefused) {
  const Problem problem{.variables = {integer_variable("teeth", "1", 2, 6)}, .responses = {{"cost", "EUR"}}};
  const auto f = [](const Eigen::VectorXd& x) { return x.sum(); };
  const auto text = [&](double teeth) {
    return support::thrown_text<std::invalid_argument>(
        [&] { evaluate(f, problem, Eigen::MatrixXd::Constant(1, 1, teeth)); });
  };
  EXPECT_EQ(
      text(3.5),
      "doe::evaluate: row 0, variable \"teeth\": 3.5 is not a whole number from 2 to 6; correct the point "
      "or the bounds");
  EXPECT_EQ(evaluate(f, problem, Eigen::MatrixXd::Constant(1, 1, 3.0)).rows.size(), 1u);
}

TEST(Evaluate, AnEmptyDesignGivesAnEmptyTable) {
  const Problem problem = support::unit_problem(2);
  const auto f = [](const Eigen::VectorXd& x) { return x.sum(); };
  const Evaluations table = evaluate(f, problem, Eigen::MatrixXd(0, 2), {.threads = 4});
  EXPECT_TRUE(table.rows.empty());
  EXPECT_EQ(table.X().cols(), 2);
  EXPECT_EQ(table.y("f0").size(), 0);
}

TEST(Evaluate, AValueOutsideItsRangeIsAFailure) {
  const Problem bounded{.variables = {{"x", "m", -1.0, 1.0}},
                        .responses = {{.name = "load", .unit = "t", .lower = 0, .upper = 20}}};
  const auto itself = [](const Eigen::VectorXd& x) { return Eigen::VectorXd(x); };
  const Evaluations table = evaluate(itself, bounded, Eigen::Vector3d(-0.5, 0, 0.5), {});
  EXPECT_EQ(table.rows[0].outcome.reason(), "response \"load\" is -0.5 t, outside its range 0 to 20 t");
  EXPECT_FALSE(table.rows[1].outcome.failed());
  EXPECT_FALSE(table.rows[2].outcome.failed());
}

}  // namespace
