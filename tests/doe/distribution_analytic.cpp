// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/distribution.hpp>
#include <drawpoint/doe/sensitivity.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <numbers>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

/// One real variable from lower to upper.
Problem of_range(double lower, double upper) { return {{{"x", "m", lower, upper}}, {{"f", "1"}}}; }

/// Mean and variance of the distribution in the box, by the midpoint rule over 2^14 equal parts of u.
std::pair<double, double> moments(const Distribution& distribution, double lower, double upper) {
  const Eigen::Index n = 1 << 14;
  Eigen::MatrixXd X(n, 1);
  for (Eigen::Index i = 0; i < n; ++i)
    X(i, 0) = lower + (static_cast<double>(i) + 0.5) / static_cast<double>(n) * (upper - lower);
  const Eigen::VectorXd x = distributed(of_range(lower, upper), {{"x", distribution}}, X).col(0);
  const double mean = x.mean();
  return {mean, (x.array() - mean).square().mean()};
}

TEST(Distribution, QuantileAndProbabilityUndoEachOther) {
  for (const Distribution& d :
       {normal(-2, 3), lognormal(5, 0.7), triangular(-1, 0, 4), triangular(0, 0, 1), triangular(0, 1, 1)})
    for (int i = 1; i < 100;
         ++i)  // round-off of p is at most 1e-16 over a density of some 0.01 per unit of p
      EXPECT_NEAR(d.probability(d.quantile(i / 100.0)), i / 100.0, 1e-13) << d.name;
}

// The midpoint rule misses the variance by the square of a stratum's width; the widest are the two in the
// tails. Of the normal distribution cut at six deviations the last stratum reaches from 3.84 to 6: its second
// moment about its middle is below 1, its share 6e-5. That of the others is smaller.
TEST(Distribution, OfAnExtremeUnit) {
  for (const double unit : {1e-200, 1e200}) {
    const Distribution d = triangular(0, 0.25 * unit, unit);
    EXPECT_NEAR(d.quantile(0.25) / unit, 0.25, 1e-15);
    EXPECT_NEAR(d.probability(0.5 * unit), 1 - 0.25 / 0.75, 1e-15);
  }
}

TEST(Distribution, HasTheMomentsOfItsFormula) {
  const auto [m, v] = moments(normal(10, 2), -2, 22);
  EXPECT_NEAR(m, 10, 1e-12);
  EXPECT_NEAR(v, 4, 4 * 1.2e-4);
  const auto [tm, tv] = moments(triangular(0, 3, 6), 0, 6);
  EXPECT_NEAR(tm, 3, 1e-12);
  EXPECT_NEAR(tv, 36.0 / 24, 1e-4);
  const auto [lm, lv] = moments(lognormal(2, 0.25), 1e-9, 50);
  EXPECT_NEAR(lm, 2 * std::exp(0.25 * 0.25 / 2), 1e-4);
}

// Cut at one deviation on each side: variance 1 − 2 φ(1)/(2Φ(1) − 1) = 0.2911.
TEST(Distribution, IsCutToTheBox) {
  const auto [m, v] = moments(normal(0, 1), -1, 1);
  const double density = std::exp(-0.5) / std::sqrt(2 * std::numbers::pi);
  EXPECT_NEAR(m, 0, 1e-12);
  EXPECT_NEAR(v, 1 - 2 * density / std::erf(1 / std::numbers::sqrt2), 1e-7);
  const Eigen::MatrixXd ends = distributed(of_range(-1, 1), {{"x", normal(0, 1)}}, Eigen::Vector2d(-1, 1));
  EXPECT_NEAR(ends(0, 0), -1, 1e-12);
  EXPECT_NEAR(ends(1, 0), 1, 1e-12);
}

// Forty deviations from the mean F is 0 to the last bit, and the quantile of 0 would be infinite.
TEST(Distribution, ReachesTheBoundsOfAWideBox) {
  const Eigen::MatrixXd X = distributed(of_range(-40, 40), {{"x", normal(0, 1)}}, Eigen::Vector2d(-40, 40));
  EXPECT_EQ(X(0, 0), -40);
  EXPECT_EQ(X(1, 0), 40);
}

TEST(Distribution, OfMeasuredValuesPassesThroughThem) {
  const auto X = distributed(of_range(0, 8), {{"x", empirical({5, 1, 2})}}, Eigen::Vector4d(0, 4, 8, 2));
  EXPECT_EQ(X(0, 0), 1);
  EXPECT_EQ(X(1, 0), 2);
  EXPECT_EQ(X(2, 0), 5);
  EXPECT_EQ(X(3, 0), 1.5);
}

TEST(Distribution, LeavesOtherVariablesAlone) {
  const Problem problem = support::loader_problem();
  const Eigen::MatrixXd X = scrambled_sobol(problem, 16);
  const Eigen::MatrixXd moved = distributed(problem, {{"kappa", triangular(0, 0.2, 1)}}, X);
  EXPECT_EQ(moved.leftCols(2), X.leftCols(2));
  EXPECT_NE(moved.col(2), X.col(2));
}

// f = 2 x₀ + x₁ with x₀ of deviation 1 and x₁ uniform on [−6, 6], variance 12: S = 4/16 and 12/16. A normal
// distribution cut at eight deviations differs by 1e-14.
TEST(Distribution, ChangesWhichInputMatters) {
  Problem problem = support::unit_problem(2);
  problem.variables[0].lower = -8, problem.variables[0].upper = 8;
  problem.variables[1].lower = -6, problem.variables[1].upper = 6;
  const auto f = [](const Eigen::VectorXd& x) { return 2 * x[0] + x[1]; };
  const SobolIndices s =
      sobol_indices(f, problem, {.samples = 2048, .inputs = {{"x0", normal(0, 1)}}}).responses[0];
  const Eigen::Vector2d exact(0.25, 0.75);
  for (int j = 0; j < 2; ++j) {
    // As in sensitivity_analytic: four standard errors of random pairs, which those of a sequence beat.
    EXPECT_NEAR(s.first.value[j], exact[j], 4 * (s.first.upper[j] - s.first.lower[j]) / (2 * 1.96));
    EXPECT_NEAR(s.total.value[j], exact[j], 4 * (s.total.upper[j] - s.total.lower[j]) / (2 * 1.96));
  }
  EXPECT_NEAR(s.variance, 16, 4 * 16 * std::sqrt(4.0 / 4096));
  const SobolIndices uniform = sobol_indices(f, problem, {.samples = 2048}).responses[0];
  EXPECT_GT(uniform.first.value[0], 0.8);  // 4 · 64/3 of 4 · 64/3 + 12 = 0.88
}

TEST(Distribution, NamesBadInput) {
  const auto text = [](const auto& action) { return support::thrown_text<std::invalid_argument>(action); };
  const Eigen::MatrixXd X = Eigen::MatrixXd::Zero(1, 1);
  EXPECT_EQ(text([] { normal(0, 0); }),
            "doe::Distribution: the standard deviation of a normal distribution is 0; allowed is above 0 and "
            "finite; leave the variable out for a uniform one");
  EXPECT_EQ(text([] { triangular(0, 2, 1); }),
            "doe::Distribution: a triangular distribution of lower end 0, mode 2 and upper end 1; allowed is "
            "lower <= mode <= upper, lower < upper, finite");
  EXPECT_EQ(text([] { empirical({1}); }),
            "doe::Distribution: an empirical distribution of 1 values; allowed is 2 or more; take triangular "
            "for a guess");
  EXPECT_EQ(text([&] {
              distributed(of_range(0, 1), {{"y", normal(0, 1)}}, X);
            }),
            "doe::Distribution: no variable \"y\"; the variables are \"x\"");
  EXPECT_EQ(text([&] {
              distributed(of_range(0, 1), {{"x", normal(9, 1)}}, X);
            }).substr(0, 60),
            "doe::Distribution: variable \"x\": the box 0 m to 1 m holds 6.");
  EXPECT_EQ(
      text([&] {
        distributed(of_range(0, 1), {{"x", empirical({0, 2})}}, X);
      }),
      "doe::Distribution: variable \"x\": the empirical distribution lies from 0 m to 2 m, outside of the "
      "box 0 m to 1 m; widen the bounds");
  EXPECT_EQ(
      text([&] {
        distributed(of_range(0, 1), {{"x", {"own", [](double p) { return 1 - p; }}}}, X);
      }),
      "doe::Distribution: variable \"x\": the quantile of the own distribution falls beside 0.25, or is not "
      "a number; it must not fall from 0 to 1");
  Problem counted = of_range(0, 1);
  counted.variables[0] = integer_variable("x", "1", 0, 4);
  EXPECT_EQ(
      text([&] {
        distributed(counted, {{"x", normal(2, 1)}}, X);
      }),
      "doe::Distribution: variable \"x\": it is integer; a distribution is for a real variable; leave it "
      "uniform");
}

}  // namespace
