// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/main_effects.hpp>
#include <drawpoint/doe/sensitivity.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/doe/sensitivity_cases.hpp>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

constexpr SobolEstimator estimators[] = {SobolEstimator::saltelli, SobolEstimator::jansen,
                                         SobolEstimator::martinez};

/// With quasi-random pairs the error is below that of random ones, whose standard error is the half-width of
/// the 95 % interval over 1.96. Four of them are passed by a normal error once in 16 000.
void expect_exact(const IndexEstimates& found, const Eigen::VectorXd& exact, const std::string& what) {
  for (Eigen::Index j = 0; j < exact.size(); ++j) {
    const double standard_error = (found.upper[j] - found.lower[j]) / (2 * 1.96);
    EXPECT_NEAR(found.value[j], exact[j], 4 * standard_error + 1e-12) << what << " of input " << j;
  }
}

void expect_indices_of(const support::SensitivityCase& c) {
  for (const SobolEstimator estimator : estimators) {
    const Sensitivity s = sobol_indices(c.f, c.problem, {.samples = 2048, .estimator = estimator});
    EXPECT_EQ(s.pairs, 2048);
    EXPECT_EQ(s.responses[0].status, SensitivityStatus::estimated);
    expect_exact(s.responses[0].first, c.first, c.name + ": S");
    expect_exact(s.responses[0].total, c.total, c.name + ": T");
    // Four standard deviations of a mean and of a variance of 4096 values; kurtosis below 5.
    EXPECT_NEAR(s.responses[0].mean, c.mean, 4 * std::sqrt(c.variance / 4096));
    EXPECT_NEAR(s.responses[0].variance, c.variance, 4 * c.variance * std::sqrt(4.0 / 4096));
  }
}

TEST(SobolIndices, OfIshigamisFunction) { expect_indices_of(support::ishigami()); }
TEST(SobolIndices, OfTheGFunction) { expect_indices_of(support::g_function()); }
TEST(SobolIndices, OfAnAdditiveFunction) { expect_indices_of(support::additive()); }

void expect_second_order_of(const support::SensitivityCase& c) {
  for (const SobolEstimator estimator : estimators) {
    SobolIndicesOptions options{.samples = 2048, .estimator = estimator};
    const SobolIndices without = sobol_indices(c.f, c.problem, options).responses[0];
    options.second_order = true;
    const Sensitivity all = sobol_indices(c.f, c.problem, options);
    const SobolIndices& s = all.responses[0];
    const Eigen::Index d = c.first.size();
    EXPECT_EQ(all.runs.rows.size(), static_cast<std::size_t>(2048 * (2 * d + 2)));
    EXPECT_EQ(s.second.value, s.second.value.transpose());
    EXPECT_TRUE(s.first.value.isApprox(without.first.value, 1e-12));  // the mean is that of A and B alone
    EXPECT_EQ(without.second.value.size(), 0);
    for (Eigen::Index j = 0; j < d; ++j)
      expect_exact({s.second.value.col(j), s.second.lower.col(j), s.second.upper.col(j)}, c.second.col(j),
                   c.name + ": S_jk");
  }
}

TEST(SobolIndices, OfTwoInputsTogether) {
  for (const auto& c : {support::ishigami(), support::g_function(), support::additive()})
    expect_second_order_of(c);
}

TEST(SobolIndices, OfTwoInputsTogetherWithoutVarianceOrRuns) {
  SobolIndicesOptions options{.samples = 16, .second_order = true};
  const Problem problem = support::unit_problem(2);
  const auto constant = sobol_indices([](const Eigen::VectorXd&) { return 1.0; }, problem, options);
  EXPECT_EQ(constant.responses[0].second.value, Eigen::Matrix2d::Zero());
  const auto never = [](const Eigen::VectorXd&) -> Outcome { return Failure{"never"}; };
  EXPECT_TRUE(std::isnan(sobol_indices(never, problem, options).responses[0].second.value(0, 1)));
}

// f(C) is f(A) to the bit, so every term of the input is zero.
TEST(SobolIndices, OfAnInertInputAreZero) {
  const Problem problem = support::unit_problem(3);
  const auto f = [](const Eigen::VectorXd& x) { return std::exp(x[0]) * x[2]; };
  for (const SobolEstimator estimator : {SobolEstimator::saltelli, SobolEstimator::jansen}) {
    const SobolIndices s = sobol_indices(f, problem, {.samples = 256, .estimator = estimator}).responses[0];
    EXPECT_EQ(s.total.value[1], 0.0);
    EXPECT_EQ(s.total.upper[1], 0.0);
    if (estimator == SobolEstimator::saltelli) {
      EXPECT_EQ(s.first.value[1], 0.0);
      EXPECT_EQ(s.first.lower[1], 0.0);
    }
  }
}

TEST(SobolIndices, HaveTheSameBitsOnAnyNumberOfThreadsAndInABatch) {
  const auto c = support::ishigami();
  const auto batch = [&c](const Eigen::MatrixXd& X, std::span<const Seed>) {
    std::vector<Outcome> outcomes;
    for (const auto& x : X.rowwise()) outcomes.emplace_back(c.f(x.transpose()));
    return outcomes;
  };
  SobolIndicesOptions options{.samples = 128};
  const SobolIndices one = sobol_indices(c.f, c.problem, options).responses[0];
  options.evaluate.threads = 4;
  const SobolIndices four = sobol_indices(c.f, c.problem, options).responses[0];
  const SobolIndices batched = sobol_indices(batch, c.problem, options).responses[0];
  for (const SobolIndices& other : {four, batched}) {
    EXPECT_EQ(one.first.value, other.first.value);
    EXPECT_EQ(one.total.upper, other.total.upper);
  }
}

TEST(SobolIndices, DoNotDependOnUnitOrOffset) {
  const auto c = support::ishigami();
  const auto shifted = [&c](const Eigen::VectorXd& x) { return 1e3 + 1024.0 * c.f(x); };
  const SobolIndices a = sobol_indices(c.f, c.problem, {.samples = 256}).responses[0];
  const SobolIndices b = sobol_indices(shifted, c.problem, {.samples = 256}).responses[0];
  // Values of 1e4 with a spread of 4e3 carry 1e-16 · 3 of it; products of two, means of 256: below 1e-12.
  EXPECT_TRUE(a.first.value.isApprox(b.first.value, 1e-12));
  EXPECT_TRUE(a.total.value.isApprox(b.total.value, 1e-12));
}

TEST(SobolIndices, DoNotDependOnAnExtremeUnit) {
  const auto c = support::ishigami();
  for (const SobolEstimator estimator : estimators)
    for (const double unit : {1e-200, 1e200}) {
      const auto scaled = [&](const Eigen::VectorXd& x) { return unit * c.f(x); };
      const SobolIndicesOptions options{.samples = 128, .estimator = estimator};
      const SobolIndices a = sobol_indices(c.f, c.problem, options).responses[0];
      const SobolIndices b = sobol_indices(scaled, c.problem, options).responses[0];
      EXPECT_TRUE(a.first.value.isApprox(b.first.value, 1e-12));
      EXPECT_TRUE(a.total.value.isApprox(b.total.value, 1e-12));
    }
}

TEST(SobolIndices, LeaveOutPairsWithAFailure) {
  const auto c = support::ishigami();
  const auto f = [&c](const Eigen::VectorXd& x) -> Outcome {
    if (x[0] > 2.5) return Failure{"stuck"};
    return c.f(x);
  };
  const Sensitivity s = sobol_indices(f, c.problem, {.samples = 512});
  // x₀ of A, and of B in C_0 and B, must be at most 2.5: probability ((2.5 + π)/2π)² = 0.806, 413 of 512.
  EXPECT_NEAR(s.pairs, 413, 5 * std::sqrt(512 * 0.806 * 0.194));
  EXPECT_EQ(s.responses[0].status, SensitivityStatus::runs_lost);
  EXPECT_EQ(s.responses[0].message.find(std::to_string(512 - s.pairs) + " of 512 pairs"), 0u);
  const auto rarely = [&c](const Eigen::VectorXd& x) -> Outcome {
    if (x[0] > 3.1) return Failure{"stuck"};  // of 512 pairs some 7
    return c.f(x);
  };
  EXPECT_EQ(sobol_indices(rarely, c.problem, {.samples = 512}).responses[0].status,
            SensitivityStatus::estimated);
  const auto never = [](const Eigen::VectorXd&) -> Outcome { return Failure{"never"}; };
  const Sensitivity none = sobol_indices(never, c.problem, {.samples = 16});
  EXPECT_EQ(none.pairs, 0);
  EXPECT_EQ(none.responses[0].status, SensitivityStatus::too_few_runs);
  EXPECT_EQ(to_string(none.responses[0].status), "too_few_runs");
  EXPECT_EQ(none.responses[0].message.substr(0, 5), "0 of ");
  EXPECT_TRUE(none.responses[0].first.value.array().isNaN().all());
}

TEST(SobolIndices, OfAConstantResponseAreZero) {
  const Problem problem = support::unit_problem(2, 2);
  const auto f = [](const Eigen::VectorXd& x) -> Outcome { return {0.1, x[0]}; };
  const Sensitivity s = sobol_indices(f, problem, {.samples = 64});
  EXPECT_EQ(s.responses[0].status, SensitivityStatus::constant_response);
  EXPECT_EQ(s.responses[0].message.find("all responses equal "), 0u);
  EXPECT_EQ(s.responses[0].total.value, Eigen::Vector2d::Zero());
  EXPECT_EQ(s.responses[1].status, SensitivityStatus::estimated);
  EXPECT_EQ(s.responses[1].response, "f1");
}

TEST(SobolIndices, BadInputIsNamed) {
  const auto c = support::ishigami();
  const auto text = [&](const SobolIndicesOptions& options) {
    return support::thrown_text<std::invalid_argument>([&] { sobol_indices(c.f, c.problem, options); });
  };
  EXPECT_EQ(text({.samples = 1}),
            "doe::sobol_indices: samples is 1; allowed is 2 or more; take some hundred");
  EXPECT_EQ(text({.confidence = 1.0}),
            "doe::sobol_indices: confidence is 1; allowed is between 0 and 1; 0.95 is usual");
  EXPECT_EQ(
      text({.resamples = 99}),
      "doe::sobol_indices: resamples is 99; allowed is 100 or more; fewer do not reach the tails of the "
      "interval");
  SobolIndicesOptions replicated;
  replicated.evaluate.replicates = 2;
  EXPECT_EQ(text(replicated),
            "doe::sobol_indices: replicates is 2; allowed is 1; average inside the black box");
}

// The other inputs add the same number at every level: the differences along the curve are those of the term.
TEST(MainEffects, OfASumAreItsTerms) {
  const auto c = support::additive();
  const auto effects = main_effects(c.f, c.problem, {.levels = 11, .samples = 32});
  ASSERT_EQ(effects.size(), 3U);
  for (std::size_t j = 0; j < 3; ++j) {
    const MainEffect& e = effects[j];
    EXPECT_EQ(e.variable, c.problem.variables[j].name);
    EXPECT_EQ(e.x[0], c.problem.variables[j].lower);
    EXPECT_EQ(e.x[10], c.problem.variables[j].upper);
    for (int k = 0; k <= 10; ++k)
      EXPECT_NEAR(e.mean[k] - e.mean[0], support::additive_slopes[j] * (e.x[k] - e.x[0]), 1e-12);
    EXPECT_TRUE((e.low.array() <= e.mean.array()).all() && (e.mean.array() <= e.high.array()).all());
  }
}

// E[f | x₁] = sin x₁ (1 + bπ⁴/5) + a/2, E[f | x₂] = a sin²x₂, E[f | x₃] = a/2; four standard errors of random
// points, which scrambled Sobol' points do not exceed.
TEST(MainEffects, OfIshigamisFunction) {
  const auto c = support::ishigami();
  const double pi4 = std::pow(std::numbers::pi, 4);
  const auto effects = main_effects(c.f, c.problem);
  for (int k = 0; k < 21; ++k) {
    const Eigen::Vector3d exact(std::sin(effects[0].x[k]) * (1 + 0.1 * pi4 / 5) + 3.5,
                                7 * std::pow(std::sin(effects[1].x[k]), 2), 3.5);
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(effects[j].mean[k], exact[static_cast<Eigen::Index>(j)],
                  4 * effects[j].standard_error[k] + 1e-12)
          << "input " << j << ", level " << k;
  }
}

TEST(MainEffects, BadInputAndFailures) {
  const auto c = support::ishigami();
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([&] { main_effects(c.f, c.problem, {.levels = 1}); }),
            "doe::main_effects: levels is 1; allowed is 2 or more; a curve needs two points and a spread two "
            "runs");
  const auto f = [](const Eigen::VectorXd& x) -> Outcome {
    if (x[0] > 3) return Failure{"stuck"};
    return x[0];
  };
  const auto effects = main_effects(f, c.problem, {.levels = 3, .samples = 8});
  EXPECT_TRUE(std::isnan(effects[0].mean[2]));
  EXPECT_EQ(effects[0].status, SensitivityStatus::too_few_runs);
  EXPECT_EQ(effects[0].message.find("every run failed at 1 of 3 levels"), 0u);
  EXPECT_EQ(effects[1].status, SensitivityStatus::estimated);
  EXPECT_DOUBLE_EQ(effects[0].mean[0], -std::numbers::pi);
  std::stop_source cancel;
  cancel.request_stop();
  MainEffectsOptions stopped{.levels = 2, .samples = 2};
  stopped.evaluate.stop = cancel.get_token();
  EXPECT_EQ(support::thrown_text<std::runtime_error>([&] { main_effects(c.f, c.problem, stopped); }),
            "doe::main_effects: stopped after 0 of 12 runs; give a journal to go on later");
}

// Runs fail where x₀ + x₁ > 1.5: at x₀ = 1 half of the points, at 0.5 and 0 none; so the mean of x₁ that is left
// at x₀ = 1 is 0.25. At 32 points per level one of them lies in each 32nd of x₁, so that the mean is right to 1/64.
TEST(MainEffects, TellWhereRunsAreLost) {
  const auto f = [](const Eigen::VectorXd& x) -> Outcome {
    if (x[0] + x[1] > 1.5) return Failure{"stuck"};
    return x[1];
  };
  const auto effects = main_effects(f, support::unit_problem(2), {.levels = 3, .samples = 32});
  EXPECT_EQ(effects[0].status, SensitivityStatus::runs_lost);
  EXPECT_EQ(
      effects[0].message,
      "16 of 32 runs failed at x0 = 1: means there are of the part of the box where runs succeed; narrow the "
      "bounds, or give failed runs a value");
  EXPECT_NEAR(effects[0].mean[2], 0.25, 1.0 / 64);
  EXPECT_NEAR(effects[0].mean[1], 0.5, 1.0 / 64);
}

// E[x₀ x₁ | x₀] = x₀ E[x₁]: the slope is the other's mean, 0.25 of a triangle from 0 over 0 to 0.75. 2^10
// Sobol' points hold one in each of as many strata, so the mean is right to a stratum's width: 1/sqrt(1024)
// at the triangle's thin end, times its share of 1/1024, and less elsewhere.
TEST(MainEffects, AverageOverTheDistributionOfTheOthers) {
  const auto f = [](const Eigen::VectorXd& x) { return x[0] * x[1]; };
  const auto effects =
      main_effects(f, support::unit_problem(2),
                   {.levels = 3, .samples = 1024, .inputs = {{"x1", triangular(0, 0, 0.75)}}});
  EXPECT_NEAR(effects[0].mean[2] - effects[0].mean[0], 0.25, 1e-4);
}

}  // namespace
