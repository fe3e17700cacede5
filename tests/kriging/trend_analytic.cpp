// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

FitOptions fixed(Trend trend) {
  FitOptions options;
  options.theta_lower = options.theta_upper = 0.8;
  options.nugget_lower = options.nugget_upper = 1e-4;
  options.trend = trend;
  return options;
}

double plane(const VectorXd& x) { return 3.0 - 2.0 * x[0] + 5.0 * x[1]; }
double paraboloid(const VectorXd& x) {
  return plane(x) + 4.0 * x[0] * x[0] - x[1] * x[1] + 2.5 * x[0] * x[1];
}

Basis paraboloid_basis() {
  Basis basis;
  basis.values = [](const VectorXd& x) {
    VectorXd f(6);
    f << 1, x[0], x[1], x[0] * x[0], x[0] * x[1], x[1] * x[1];
    return f;
  };
  return basis;
}

}  // namespace

// Universal Kriging is unbiased for its trend: whatever θ and λ are, y = Fβ gives α = 0 and the mean f(x)ᵀβ
// everywhere, also far outside. Numbers below 1e3, conditions below 1e6 (asserted): 1e3·1e6·1e-16 = 1e-7.
TEST(Trend, APolynomialOfTheTrendIsReproducedEverywhere) {
  const MatrixXd X = reference::design(30, 2, 3), Z = 6.0 * reference::design(40, 2, 4).array() - 3.0;
  const std::pair<Trend, double (*)(const VectorXd&)> cases[] = {{Trend::linear, plane},
                                                                 {Trend::quadratic, plane},
                                                                 {Trend::quadratic, paraboloid},
                                                                 {Trend::user, paraboloid}};
  for (const auto& [trend, f] : cases) {
    FitOptions options = fixed(trend);
    if (trend == Trend::user) options.basis = paraboloid_basis();
    const Model model = fit(X, reference::values(f, X), options);
    ASSERT_LT(model.report().condition, 1e6);
    EXPECT_LT((model.mean(Z) - reference::values(f, Z)).cwiseAbs().maxCoeff(), 1e-7);
    // The variance far away grows with the trend's uncertainty, relative to an s² that is zero but for
    // round-off.
    EXPECT_LT(model.process_variance(), 1e-16);
    const PredictionGradient g = model.gradient(Eigen::Vector2d(0.3, 0.6));
    if (f == paraboloid) {
      EXPECT_NEAR(g.mean[0], -2 + 8 * 0.3 + 2.5 * 0.6, 1e-6);
      EXPECT_NEAR(g.mean[1], 5 - 2 * 0.6 + 2.5 * 0.3, 1e-6);
    }
  }
}

// The same space of functions gives the same predictor, whichever basis spans it.
TEST(Trend, TheUsersBasisOfTheSameSpaceIsTheSameModel) {
  const MatrixXd X = reference::design(30, 2, 3), Z = reference::design(20, 2, 4);
  const VectorXd y =
      reference::values([](const VectorXd& x) { return std::exp(x[0]) * std::cos(4 * x[1]); }, X);
  FitOptions user = fixed(Trend::user);
  user.basis = paraboloid_basis();
  const Model a = fit(X, y, fixed(Trend::quadratic)), b = fit(X, y, user);
  const Prediction p = a.predict(Z), q = b.predict(Z);
  ASSERT_LT(a.report().condition, 1e6);
  EXPECT_LT((p.mean - q.mean).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((p.variance - q.variance).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(a.log_likelihood(), b.log_likelihood(), 1e-8);
}

TEST(Trend, TermsThatTheRunsCannotTellApartAreLeftOut) {
  MatrixXd X(12, 3);  // two levels of x₁, so x₁² is constant; x₃ never varies
  X << reference::design(12, 2, 3), VectorXd::Constant(12, 7.0);
  for (Eigen::Index i = 0; i < 12; ++i) X(i, 0) = static_cast<double>(i % 2);
  const Model model = fit(X, X.col(0) + X.col(1).array().square().matrix(), fixed(Trend::quadratic));
  // 1, x₁, x₂, x₁x₂, x₂² remain of ten.
  EXPECT_EQ(model.trend_function().size(), 5);
  EXPECT_NE(model.message().find("5 terms of the trend are left out"), std::string::npos) << model.message();
  EXPECT_TRUE(model.predict(X).mean.allFinite());
}

// A steep slope in one input under curves in the others: the blind choice must find the slope, and by
// construction it never has a larger leave-one-out error than the constant.
TEST(Trend, TheBlindChoiceFindsTheSlopesAndNeverLosesToTheConstant) {
  const MatrixXd X = reference::design(30, 3, 3);
  VectorXd y = reference::values(
      [](const VectorXd& x) { return 40 * x[0] - 25 * x[2] * x[2] + std::sin(9 * x[1]); }, X);
  FitOptions options;
  const double constant = leave_one_out(fit(X, y, options)).rmse;
  options.trend = Trend::blind;
  const Model blind = fit(X, y, options);
  EXPECT_LE(leave_one_out(blind).rmse, constant);
  const auto& terms = blind.trend_function().terms;
  for (const TrendTerm slope : {TrendTerm{0, -1}, TrendTerm{2, -1}})
    EXPECT_NE(std::find(terms.begin(), terms.end(), slope), terms.end()) << slope.a;
  EXPECT_LT(terms.size(), 10u);
}

TEST(Trend, ABasisThatChangesItsMindIsRefused) {
  const MatrixXd X = reference::design(12, 2, 3);
  FitOptions options = fixed(Trend::user);
  options.basis.values = [](const VectorXd& x) -> VectorXd {
    if (x[0] > 2) return VectorXd::Ones(1);
    return Eigen::Vector2d(1, x[0]);
  };
  const Model model = fit(X, X.col(1), options);
  try {
    model.mean(MatrixXd::Constant(1, 2, 3.0));
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(
        std::string(e.what()),
        "kriging::Basis: values has 1 entries, fewer than at the runs; allowed is one size; return as many "
        "everywhere");
  }
}

// A plane under a linear trend: nothing is left to correlate. The terms of the mean are below 2e3 here, and
// the quadratic has six, found from 30 runs by least squares of a condition below 100: 2e3·6·100·1e-16 =
// 1e-10. The stated deviation is 64 round-offs of 1700/700 for the standardised response, 3e-14, times its
// scale of 200 and some extrapolation: below 1e-10.
TEST(Trend, ThatMeetsAllRunsIsTheModel) {
  const MatrixXd X = reference::design(30, 2, 3), Z = reference::design(20, 2, 4);
  const auto plane = [](const VectorXd& x) { return 1000.0 + 3.0 * x[0] - 700.0 * x[1]; };
  FitOptions options;
  for (const Trend trend : {Trend::linear, Trend::quadratic}) {
    options.trend = trend;
    const Model model = fit(X, reference::values(plane, X), options);
    EXPECT_EQ(model.status(), Status::exact_trend) << model.message();
    const Prediction p = model.predict(Z);
    EXPECT_LT((p.mean - reference::values(plane, Z)).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_GT(p.variance.minCoeff(), 0.0);
    EXPECT_LT(std::sqrt(p.variance.maxCoeff()), 1e-10);
  }
  options.trend = Trend::linear;
  const VectorXd bent = reference::values(plane, X).array() + 1e-6 * X.col(0).array().sin();
  EXPECT_NE(fit(X, bent, options).status(), Status::exact_trend);

  // Known noise bounds the likelihood: there is a model to fit, and it says so much of the next run.
  options.noise = Noise::known;
  options.noise_variance = VectorXd::Constant(30, 0.04);
  const Model noisy = fit(X, reference::values(plane, X), options);
  EXPECT_NE(noisy.status(), Status::exact_trend);
  EXPECT_GE(noisy.predict(Z, Target::observation).variance.minCoeff(), 0.04);
  FitOptions linear;
  linear.trend = Trend::linear;
  const Model alone = fit(X, reference::values(plane, X), linear);
  EXPECT_THROW(append(alone, Z, VectorXd::Ones(20)), std::invalid_argument);
}

// Runs that contradict each other at one place are no plane, even where the nugget is too small to factor
// their correlations: it is raised to some n round-offs, which leave next to no digits of α, but a prediction
// between the repeats.
TEST(Trend, RepeatsThatContradictEachOtherMeetNoTrend) {
  FitOptions options;
  options.trend = Trend::linear;
  options.nugget_lower = options.nugget_upper = 1e-20;
  const MatrixXd X = Eigen::Vector<double, 6>(0.1, 0.1, 0.4, 0.4, 0.9, 0.9);
  const Model model = fit(X, Eigen::Vector<double, 6>(1, 2, 3, 5, 4, 4.5), options);
  EXPECT_EQ(model.status(), Status::ill_conditioned) << model.message();
  EXPECT_NEAR(model(VectorXd::Constant(1, 0.1)), 1.5, 0.5);
}

// Sums without round-off: s² and the likelihood are 0 and infinite.
TEST(Trend, ThatMeetsAllRunsWithoutRoundOffIsTheModel) {
  FitOptions options;
  options.trend = Trend::linear;
  const VectorXd y = Eigen::Vector4d(-1, 1, -1, 1);
  const Model model = fit(MatrixXd(y), y, options);
  EXPECT_EQ(model.status(), Status::exact_trend) << model.message();
  EXPECT_NEAR(model(VectorXd::Constant(1, 0.5)), 0.5, 1e-15);
}

// The starts of 300 runs are found on 250 of them, every sixth left out. A term that only the sixth have was singular
// there whatever the nugget, and the search went on for ever. y = 1 + 2 [sixth] + a sine that 300 runs resolve to its
// last digits: the term's coefficient is 2 but for the error of interpolation, below 1e-6 of the sine's amplitude.
TEST(Trend, ATermOfFewRunsEndsTheSearch) {
  constexpr int n = 300;
  MatrixXd X(n, 2);
  VectorXd y(n);
  for (int i = 0; i < n; ++i) {
    X(i, 0) = i / (n - 1.0);
    X(i, 1) = i % 6 == 5;
    y[i] = std::sin(3 * X(i, 0)) + 2 * X(i, 1);
  }
  FitOptions options;
  options.trend = Trend::user;
  options.basis.values = [](const VectorXd& x) { return VectorXd(Eigen::Vector2d(1, x[1])); };
  const Model model = fit(X, y, options);
  ASSERT_EQ(model.trend_coefficients().size(), 2);
  EXPECT_NEAR(model.trend_coefficients()[1], 2, 1e-6);
}
