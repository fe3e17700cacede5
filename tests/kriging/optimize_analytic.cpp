// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Optima that are known exactly, or to the digits that their sources print.

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <drawpoint/doe/remembered.hpp>
#include <drawpoint/kriging/detail/searched_models.hpp>
#include <drawpoint/kriging/optimize.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <drawpoint/tests/support/median.hpp>
#include <drawpoint/tests/support/welded_beam.hpp>
#include <filesystem>
#include <numbers>
#include <set>
#include <thread>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::VectorXd;
using support::median;

namespace {

doe::Problem unit_problem(int variables, doe::Goal goal = doe::Goal::minimize) {
  doe::Problem problem{{}, {{"y", "1", goal}}};
  for (int k = 0; k < variables; ++k) problem.variables.push_back({"x" + std::to_string(k), "1", 0.0, 1.0});
  return problem;
}

doe::Seed seed_of(int k) { return static_cast<doe::Seed>(k); }

// The optimum, −3.32237 (Surjanovic, Bingham 2013), has a rival at −3.20316 that a third of all searches end in;
// no more than three of seven may.
TEST(Optimize, Hartmann6InSixtyRuns) {
  std::vector<double> gaps;
  for (int seed = 1; seed <= 7; ++seed) {
    const Optimum o = optimize([](const VectorXd& x) { return reference::hartmann6(x); }, unit_problem(6), 60,
                               {.seed = seed_of(seed)});
    ASSERT_EQ(o.best.size(), 1U);
    EXPECT_TRUE(o.exact);
    EXPECT_EQ(o.runs.rows.size(), 60U);
    gaps.push_back(o.best[0].y[0] + 3.32236801);
    EXPECT_LT(gaps.back(), 0.3);
  }
  EXPECT_LT(median(gaps), 1e-3);
}

TEST(Optimize, AWeldedBeamInSixtyRuns) {
  std::vector<double> gaps;
  for (int seed = 1; seed <= 3; ++seed) {
    const Optimum o = optimize(support::weld, support::beam(2.0), 60, {.seed = seed_of(seed)});
    ASSERT_TRUE(o.feasible);
    const VectorXd& y = o.best[0].y;
    EXPECT_LE(y[1], 13600.0);
    EXPECT_LE(y[2], 30000.0);
    EXPECT_LE(y[3], 0.0);
    EXPECT_LE(y[4], 0.25);
    EXPECT_GE(y[5], 6000.0);
    gaps.push_back(y[0] - 1.86164);
    EXPECT_GT(gaps.back(), -1e-4);
  }
  EXPECT_LT(median(gaps), 0.05);
}

// 10 − (a − 0.3)² − |k − 4| − 0.5 [kind is not "b"]: largest at 0.3, 4, "b", where it is 10.
TEST(Optimize, MaximizesOverWholeNumbersAndCategories) {
  const doe::Problem problem{.variables = {{"a", "1", 0.0, 1.0},
                                           doe::integer_variable("k", "1", 0, 9),
                                           doe::categorical_variable("kind", {"a", "b", "c"})},
                             .responses = {{"y", "1", doe::Goal::maximize}}};
  const Optimum o = optimize(
      [](const VectorXd& x) {
        return 10.0 - std::pow(x[0] - 0.3, 2) - std::abs(x[1] - 4.0) - (x[2] == 1.0 ? 0.0 : 0.5);
      },
      problem, 40);
  EXPECT_GT(o.best[0].y[0], 10.0 - 1e-4);
  EXPECT_EQ(o.best[0].x[1], 4.0);
  EXPECT_EQ(o.best[0].x[2], 1.0);
}

// All twelve points of a box without a real variable are run once, but for the one that is run twice. Counts that
// several points share do not tell that the simulator is exact, so y is the model's, which may see some noise.
TEST(Optimize, SaysWhenEveryPointHasBeenRun) {
  const doe::Problem problem{
      .variables = {doe::integer_variable("k", "1", 0, 3), doe::integer_variable("l", "1", 0, 2)},
      .responses = {{"y", "1", doe::Goal::minimize}}};
  const Optimum o = optimize([](const VectorXd& x) { return std::pow(x[0] - 2, 2) + std::pow(x[1] - 1, 2); },
                             problem, 60, {.first = 6});
  EXPECT_EQ(o.status, OptimizeStatus::no_candidate);
  EXPECT_NEAR(o.best[0].y[0], 0.0, 0.01);  // of a range of 5
  EXPECT_EQ(o.best[0].x, Eigen::Vector2d(2, 1));
}

// f₁ = x² + y², f₂ = (x − 1)² + y²: the front is √f₁ + √f₂ = 1, y = 0, which bounds 1/6 of the unit square.
TEST(Optimize, SeveralObjectivesGiveTheFront) {
  doe::Problem problem = unit_problem(2);
  problem.variables[1].lower = -1.0;
  problem.responses.push_back({"z", "1", doe::Goal::minimize});
  const Optimum o = optimize(
      [](const VectorXd& x) -> doe::Outcome {
        return {x[0] * x[0] + x[1] * x[1], (x[0] - 1) * (x[0] - 1) + x[1] * x[1]};
      },
      problem, 40);
  std::vector<std::pair<double, double>> front;
  for (const OptimalPoint& p : o.best) front.emplace_back(p.y[0], p.y[1]);
  std::sort(front.begin(), front.end());
  double volume = 0, height = 1;
  for (const auto& [a, b] : front) {
    if (a < 1 && b < height) volume += (1 - a) * (height - b), height = b;
  }
  EXPECT_GT(volume, 5.0 / 6.0 - 0.035);  // thirty points spread evenly leave 1/(2·30) or so
  EXPECT_LT(volume, 5.0 / 6.0);
  EXPECT_FALSE(o.expected);
}

// Fails for x > 0.6, on the way to the least value of those that do not, −0.36 at 0.6.
TEST(Optimize, StepsBackFromWhereRunsFail) {
  const Optimum o = optimize(
      [](const VectorXd& x) -> doe::Outcome {
        if (x[0] > 0.6) return doe::Failure{"stuck"};
        return -x[0] * x[0] + (x[1] - 0.5) * (x[1] - 0.5);
      },
      unit_problem(2), 30);
  EXPECT_LT(o.best[0].y[0], -0.36 + 0.02);
  EXPECT_GT(o.runs.failed(), 0);
  EXPECT_LT(o.runs.failed(), 20);
  const Optimum none =
      optimize([](const VectorXd&) -> doe::Outcome { return doe::Failure{"never"}; }, unit_problem(2), 20);
  EXPECT_EQ(none.status, OptimizeStatus::nothing_succeeded);
  EXPECT_TRUE(none.best.empty());
}

// Noise of 0.2 on a bowl of range 2: intervals hold what the best points are without it.
TEST(Optimize, TellsNoiseFromARunMadeTwice) {
  const auto truth = [](const VectorXd& x) { return 4 * (x - Eigen::Vector2d(0.3, 0.6)).squaredNorm(); };
  int held = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    const Optimum o = optimize(
        [&](const VectorXd& x, doe::Seed s) { return truth(x) + 0.2 * doe::RandomStream(s).normal(); },
        unit_problem(2), 40, {.seed = seed_of(seed)});
    EXPECT_FALSE(o.exact);
    EXPECT_LT(truth(o.best[0].x), 0.15);
    ASSERT_TRUE(o.expected);
    EXPECT_LT(truth(o.expected->x), 0.15);
    held += o.best[0].lower[0] <= truth(o.best[0].x) && truth(o.best[0].x) <= o.best[0].upper[0];
  }
  EXPECT_GE(held, 4);
}

TEST(Optimize, SaysWhenNoRunKeepsItsLimits) {
  doe::Problem problem = unit_problem(1);
  problem.responses.push_back({"z", "1", doe::Goal::at_most, -1.0});
  const Optimum o = optimize(
      [](const VectorXd& x) -> doe::Outcome {
        return {x[0], 0.5 + x[0] * x[0]};
      },
      problem, 15);
  EXPECT_EQ(o.status, OptimizeStatus::nothing_feasible);
  EXPECT_FALSE(o.feasible);
  EXPECT_LT(o.best[0].y[1], 0.5 + 1e-4);  // the least infeasible
}

double bowl(const VectorXd& x) { return (x - Eigen::Vector2d(0.3, 0.6)).squaredNorm(); }

TEST(Optimize, IsReproducibleAndGoesOnFromItsJournalToTheSameBits) {
  const auto path =
      std::filesystem::temp_directory_path() / ("optimize_" + std::to_string(::getpid()) + ".txt");
  std::filesystem::remove(path);
  const Optimum whole = optimize(bowl, unit_problem(2), 24);
  std::stop_source cancel;
  OptimizeOptions options{.journal = path, .stop = cancel.get_token()};
  int ended = 0;
  options.on_result = [&](const doe::Evaluation&) {
    if (++ended == 17) cancel.request_stop();
  };
  EXPECT_EQ(optimize(bowl, unit_problem(2), 24, options).status, OptimizeStatus::cancelled);
  int made = 0;
  const Optimum again = optimize(
      [&](const VectorXd& x) {
        ++made;
        return bowl(x);
      },
      unit_problem(2), 24, {.journal = path});
  EXPECT_EQ(made, 24 - 17);
  ASSERT_EQ(again.runs.rows.size(), 24U);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(again.runs.rows[i].x, whole.runs.rows[i].x) << i;
  EXPECT_EQ(again.best[0].y, whole.best[0].y);
  std::filesystem::remove(path);
}

// Four threads: no point twice but the one that is run again, and never fewer than four under way for long.
TEST(Optimize, KeepsAllThreadsBusyWithDifferentPoints) {
  std::atomic<int> under_way{0}, most{0};
  const auto f = [&](const VectorXd& x) {
    const int now = ++under_way;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    --under_way;
    return bowl(x);
  };
  const Optimum o = optimize(f, unit_problem(2), 40, {.threads = 4});
  EXPECT_EQ(o.runs.rows.size(), 40U);
  EXPECT_EQ(most, 4);
  std::set<std::pair<double, double>> points;
  for (const doe::Evaluation& row : o.runs.rows) points.emplace(row.x[0], row.x[1]);
  EXPECT_EQ(points.size(), 39U);
  EXPECT_LT(o.best[0].y[0], 1e-4);
}

TEST(Optimize, TakesBatchFunctionsStoresAndARegion) {
  doe::MemoryStore store;
  const auto batch = [](const Eigen::MatrixXd& X, std::span<const doe::Seed>) {
    std::vector<doe::Outcome> all;
    for (const auto& x : X.rowwise()) all.emplace_back(bowl(x.transpose()));
    return all;
  };
  const auto f = doe::remembered(batch, unit_problem(2), store);
  const OptimizeOptions options{.allowed = [](const VectorXd& x) { return x[0] >= 0.5; }};
  const Optimum o = optimize(f, unit_problem(2), 24, options);
  EXPECT_EQ(store.size(), 24U);
  for (const doe::Evaluation& row : o.runs.rows) EXPECT_GE(row.x[0], 0.5);
  EXPECT_NEAR(o.best[0].y[0], 0.04, 1e-3);  // at (0.5, 0.6)
}

TEST(Optimize, RefusesWhatItCannotServe) {
  using support::thrown_text;
  const auto text = [](const doe::Problem& problem, int budget, const OptimizeOptions& options = {}) {
    return thrown_text<std::invalid_argument>([&] { optimize(bowl, problem, budget, options); });
  };
  EXPECT_EQ(text(unit_problem(2, doe::Goal::record), 10),
            "kriging::optimize: the problem has 0 objectives; allowed is 1 or more; give a response the goal "
            "minimize or maximize");
  EXPECT_EQ(text(unit_problem(2), 0),
            "kriging::optimize: budget is 0; allowed is 1 or more; give the runs that can be made");
  EXPECT_EQ(
      text(unit_problem(2), 10, {.first = 11}),
      "kriging::optimize: first is 11; allowed is 1 to the budget, 10; leave it out for 2 per variable");
  EXPECT_EQ(thrown_text<std::invalid_argument>([] {
              optimize([](const VectorXd&) -> doe::Outcome { return {1.0, 2.0}; }, unit_problem(2), 10);
            }).substr(0, 42),
            "kriging::optimize: the black box returned ");
  EXPECT_EQ(optimize(bowl, unit_problem(2), 1).runs.rows.size(), 1U);
}

}  // namespace

// A run that reports a small standard error is weighed by it where the problem has its degrees of freedom, and then
// moderated; else all runs have one size of noise. Errors of 0 beside others are no proof of exact runs.
TEST(Optimize, WeighsRunsByWhatTheirStandardErrorsAreWorth) {
  doe::Evaluations runs{unit_problem(1), {}};
  runs.problem.responses[0].standard_error = "error";
  runs.problem.responses.push_back({.name = "error", .unit = "1", .lower = 0});
  const VectorXd error = (VectorXd(6) << 1, 0.01, 3, 2, 0.1, 0.5).finished();
  for (int i = 0; i < 6; ++i)
    runs.rows.push_back(
        {i + 1, 0, 1, VectorXd::Constant(1, 0.1 + 0.15 * i), VectorXd(Eigen::Vector2d(i, error[i])), 0.0});
  const VectorXd variance = error.array().square();
  EXPECT_EQ(detail::search_fit_options(runs, "y", false).noise, Noise::pooled);
  runs.problem.responses[0].standard_error_freedom = 3;
  const FitOptions weighed = detail::search_fit_options(runs, "y", false);
  EXPECT_EQ(weighed.noise, Noise::known);
  EXPECT_EQ(weighed.noise_variance, moderated_noise(variance, 3.0));
}
