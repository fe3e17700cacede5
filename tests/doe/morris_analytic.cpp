// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/morris.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/doe/sensitivity_cases.hpp>
#include <set>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

ElementaryEffects effects_on(const auto& f, int d, const MorrisOptions& options = {}) {
  return morris_screening(f, support::unit_problem(d), options).responses[0];
}

// Each effect of a linear function is slope times range. Values are sums of three terms of at most 4, divided
// by a step of 2/3: round-off below 1e-14.
TEST(MorrisScreening, OfALinearFunctionIsItsSlopes) {
  const auto c = support::additive();
  const Screening s = morris_screening(c.f, c.problem);
  const ElementaryEffects& e = s.responses[0];
  EXPECT_EQ(e.status, SensitivityStatus::estimated);
  EXPECT_EQ(s.runs.rows.size(), 40U);
  for (int j = 0; j < 3; ++j) {
    const double range = c.problem.variables[j].upper - c.problem.variables[j].lower;
    const double slope = support::additive_slopes[j] * range;
    EXPECT_NEAR(e.mean[j], slope, 1e-14);
    EXPECT_NEAR(e.mean_absolute[j], std::abs(slope), 1e-14);
    EXPECT_NEAR(e.deviation[j], 0, 1e-14);
    EXPECT_EQ(e.count[j], 10);
  }
}

TEST(MorrisScreening, ChangesOneInputAtATimeByHalfTheLevels) {
  const auto f = [](const Eigen::VectorXd& x) { return x[0]; };
  const Screening s =
      morris_screening(f, support::unit_problem(4), {.seed = 3, .trajectories = 50, .levels = 6});
  ASSERT_EQ(s.runs.rows.size(), 250U);
  for (std::size_t row = 0; row < 250; ++row) {
    const Eigen::VectorXd on_grid = s.runs.rows[row].x * 5;
    EXPECT_NEAR((on_grid - on_grid.array().round().matrix()).norm(), 0, 1e-14);
    if (row % 5 == 0) continue;
    const Eigen::VectorXd step = s.runs.rows[row].x - s.runs.rows[row - 1].x;
    EXPECT_EQ((step.array() != 0).count(), 1);
    EXPECT_NEAR(step.cwiseAbs().maxCoeff(), 0.6, 1e-15);
  }
}

// The effect of x₀ on x₀ x₁ is x₁, which is 0, 1/3, 2/3 or 1 alike: mean 1/2, variance 5/36. Over 400
// trajectories the mean is right to 4 · sqrt(5/36/400); a variance of values with kurtosis 1.64 to
// 4 · 5/36 · sqrt(0.64/400).
TEST(MorrisScreening, SeesAnInteraction) {
  const auto e = effects_on([](const Eigen::VectorXd& x) { return x[0] * x[1]; }, 2, {.trajectories = 400});
  for (int j = 0; j < 2; ++j) {
    EXPECT_NEAR(e.mean_absolute[j], 0.5, 4 * std::sqrt(5.0 / 36 / 400));
    EXPECT_NEAR(e.deviation[j] * e.deviation[j], 5.0 / 36, 4 * 5.0 / 36 * std::sqrt(0.64 / 400));
    EXPECT_NEAR(e.standard_error[j], e.deviation[j] / 20, 1e-15);
  }
}

// |x − 1/2| falls by 1/3 from 0 to 2/3 and rises by as much from 1/3 to 1, over steps of 2/3.
TEST(MorrisScreening, MeanAbsoluteDoesNotCancel) {
  const auto e =
      effects_on([](const Eigen::VectorXd& x) { return std::abs(x[0] - 0.5); }, 1, {.trajectories = 200});
  EXPECT_NEAR(e.mean_absolute[0], 0.5, 1e-14);
  EXPECT_LT(std::abs(e.mean[0]), 4 * 0.5 / std::sqrt(200.0));
}

TEST(MorrisScreening, AnInertInputHasNoEffect) {
  const auto e = effects_on([](const Eigen::VectorXd& x) { return std::exp(x[0]) * x[2]; }, 3);
  EXPECT_EQ(e.mean_absolute[1], 0.0);
  EXPECT_EQ(e.deviation[1], 0.0);
  EXPECT_GT(e.mean_absolute[0], 0.0);
}

// A response linear in an integer input, with 2 values or 12, has the effect of a real one: its change over the
// range. A categorical input's effect is its change: of 0, 10, 20 from level to level 10 up or 20 down.
TEST(MorrisScreening, MovesEveryKindOfVariableOverAllItsValues) {
  Problem problem = support::unit_problem(1);
  problem.variables.push_back(integer_variable("teeth", "1", 2, 3));
  problem.variables.push_back(integer_variable("rows", "1", 1, 12));
  problem.variables.push_back(categorical_variable("tool", {"bucket", "blade", "ripper"}));
  const auto f = [](const Eigen::VectorXd& x) { return 3 * x[0] + 3 * x[1] + 3.0 / 11 * x[2] + 10 * x[3]; };
  for (const int levels : {2, 4}) {
    const Screening s = morris_screening(f, problem, {.trajectories = 60, .levels = levels});
    for (std::size_t row = 1; row < s.runs.rows.size(); ++row)
      if (row % 5 != 0) {
        EXPECT_NE(s.runs.rows[row].x, s.runs.rows[row - 1].x);
      }
    const ElementaryEffects& e = s.responses[0];
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(e.mean[j], 3, 1e-13);
      EXPECT_NEAR(e.deviation[j], 0, 1e-12);
    }
    EXPECT_GE(e.mean_absolute[3], 10);
    EXPECT_LE(e.mean_absolute[3], 20);
    std::set<double> rows, tools;
    for (const auto& run : s.runs.rows) rows.insert(run.x[2]), tools.insert(run.x[3]);
    EXPECT_EQ(rows.size(), 12U);  // of 120 draws none misses one of 12, once in 3000
    EXPECT_EQ(tools.size(), 3U);
  }
}

TEST(MorrisScreening, DoesNotDependOnTheUnit) {
  for (const double unit : {1e-200, 1e200}) {
    const auto f = [unit](const Eigen::VectorXd& x) { return unit * x[0] * x[1]; };
    const auto one = [](const Eigen::VectorXd& x) { return x[0] * x[1]; };
    const auto e = effects_on(f, 2), of_one = effects_on(one, 2);
    EXPECT_NEAR(e.deviation[0] / unit, of_one.deviation[0], 1e-14);
    EXPECT_NEAR(e.mean_absolute[1] / unit, of_one.mean_absolute[1], 1e-14);
  }
}

TEST(MorrisScreening, AFailedRunTakesTheEffectsOnBothSides) {
  const auto f = [](const Eigen::VectorXd& x) -> Outcome {
    if (x[0] > 0.9) return Failure{"stuck"};
    return x.sum();
  };
  const Screening s = morris_screening(f, support::unit_problem(3), {.trajectories = 40});
  const ElementaryEffects& e = s.responses[0];
  int whole = 0;
  for (std::size_t row = 1; row < s.runs.rows.size(); ++row)
    whole += row % 4 != 0 && !s.runs.rows[row].outcome.failed() && !s.runs.rows[row - 1].outcome.failed();
  EXPECT_EQ(e.count.sum(), whole);
  EXPECT_LT(whole, 114);
  EXPECT_EQ(e.status, SensitivityStatus::runs_lost);
  EXPECT_EQ(e.message.find(std::to_string(120 - whole) + " of 120 effects"), 0u);
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(e.mean[j], 1, 1e-14);
  const auto never = [](const Eigen::VectorXd&) -> Outcome { return Failure{"never"}; };
  const ElementaryEffects none = effects_on(never, 2);
  EXPECT_EQ(none.status, SensitivityStatus::too_few_runs);
  EXPECT_EQ(none.message.substr(0, 25), "2 variables have fewer th");
  EXPECT_TRUE(none.mean_absolute.array().isNaN().all());
}

TEST(MorrisScreening, OfAConstantSaysSo) {
  const auto e = effects_on([](const Eigen::VectorXd&) { return 3.0; }, 2);
  EXPECT_EQ(e.status, SensitivityStatus::constant_response);
  EXPECT_EQ(e.message, "no change of an input changed the response");
}

TEST(MorrisScreening, HasTheSameBitsOnAnyNumberOfThreads) {
  const auto c = support::ishigami();
  MorrisOptions options{.seed = 9};
  const auto one = morris_screening(c.f, c.problem, options).responses[0];
  options.evaluate.threads = 4;
  const auto four = morris_screening(c.f, c.problem, options).responses[0];
  EXPECT_EQ(one.mean_absolute, four.mean_absolute);
  options.seed = 10;
  EXPECT_NE(one.mean_absolute, morris_screening(c.f, c.problem, options).responses[0].mean_absolute);
}

TEST(MorrisScreening, BadInputIsNamed) {
  const auto text = [](const MorrisOptions& options) {
    return support::thrown_text<std::invalid_argument>(
        [&] { effects_on([](const Eigen::VectorXd& x) { return x[0]; }, 1, options); });
  };
  EXPECT_EQ(text({.trajectories = 1}),
            "doe::morris_screening: trajectories is 1; allowed is 2 or more; 10 rank the inputs");
  EXPECT_EQ(text({.levels = 5}),
            "doe::morris_screening: levels is 5; allowed is an even number from 2 to 1000; 4 is usual");
}

}  // namespace
