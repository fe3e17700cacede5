// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/fit_radial.hpp>
#include <drawpoint/kriging/polynomial.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

FitOptions fixed(double theta, double nugget) {
  FitOptions options;
  options.theta_lower = options.theta_upper = theta;
  options.nugget_lower = options.nugget_upper = nugget;
  return options;
}

double wave(const VectorXd& x) { return std::sin(5 * x[0]) + x[1] * x[1]; }

}  // namespace

// Runs at 2 and 6, so that the scaled input is (x − 4)/2. With u = r₁ + r₂, v = r₂ − r₁ the system splits
// into its even and odd part: mean = μ + δ v/(1 + λ − c), rᵀR⁻¹r = u²/(2(1 + λ + c)) + v²/(2(1 + λ − c)),
// 1ᵀR⁻¹r = u/(1 + λ + c), 1ᵀR⁻¹1 = 2/(1 + λ + c).
TEST(Model, OfTwoRunsIsTheClosedForm) {
  const double theta = 0.3, nugget = 0.05, a = 10.0, b = 16.0, delta = 0.5 * (b - a);
  const Model model = fit(Eigen::Vector2d(2, 6), Eigen::Vector2d(a, b), fixed(theta, nugget));
  const double c = std::exp(-4 * theta), odd = 1 + nugget - c, even = 1 + nugget + c,
               s2 = delta * delta / odd;
  EXPECT_NEAR(model.trend(), 13.0, 1e-12);
  EXPECT_NEAR(model.process_variance(), s2, 1e-12);
  EXPECT_NEAR(model.log_likelihood(), -std::log(2 * reference::pi * s2) - 0.5 * std::log(odd * even) - 1,
              1e-12);
  for (const double x : {-3.0, 2.0, 3.1, 4.0, 6.0, 11.0}) {
    const double z = 0.5 * (x - 4), r1 = std::exp(-theta * (z + 1) * (z + 1));
    const double r2 = std::exp(-theta * (z - 1) * (z - 1)), u = r1 + r2, v = r2 - r1;
    const double variance =
        s2 * (1 - u * u / (2 * even) - v * v / (2 * odd) + std::pow(1 - u / even, 2) * even / 2);
    const Prediction p = model.predict(MatrixXd::Constant(1, 1, x));
    // A dozen operations on numbers below 100 with a condition below 5: 1e-12 leaves a factor of ten.
    EXPECT_NEAR(p.mean[0], 13.0 + delta * v / odd, 1e-12);
    EXPECT_NEAR(p.variance[0], variance, 1e-12);
    EXPECT_NEAR(model.predict(MatrixXd::Constant(1, 1, x), Target::observation).variance[0],
                variance + nugget * s2, 1e-12);
    EXPECT_EQ(model(VectorXd::Constant(1, x)), p.mean[0]);
  }
}

// At a run ŷ = y − λα, and |α| is at most |y − 1μ|/(λ_min(C) + λ); its variance is s²(λ − λ²(R⁻¹ᵢᵢ −
// βᵢ²/1ᵀβ)) with β = R⁻¹1, between 0 and λ s² by Cauchy and Schwarz. So a vanishing nugget interpolates, at
// the rate λ.
TEST(Model, InterpolatesAsTheNuggetVanishes) {
  const double theta = 20.0;
  const MatrixXd X = reference::design(40, 2, 3);
  const VectorXd y = reference::values(wave, X);
  FitOptions options = fixed(theta, 1.0);
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  MatrixXd C;
  fill_correlation(2.0 * X.array() - 1.0, VectorXd::Constant(2, theta), C);
  const double smallest = Eigen::SelfAdjointEigenSolver<MatrixXd>(C, Eigen::EigenvaluesOnly).eigenvalues()[0];
  ASSERT_GT(smallest, 1e-8) << "the bound below would say nothing";
  for (const double nugget : {1e-2, 1e-5, 1e-8, 1e-10}) {
    options.nugget_lower = options.nugget_upper = nugget;
    const Model model = fit(X, y, options);
    const Prediction p = model.predict(X);
    const double residual = (y.array() - model.trend()).matrix().norm();
    // Round-off: the condition is below 40/1e-8 and y near 1.
    EXPECT_LE((p.mean - y).cwiseAbs().maxCoeff(), nugget * residual / (smallest + nugget) + 1e-6);
    EXPECT_GE(p.variance.minCoeff(), 0.0);
    EXPECT_LE(p.variance.maxCoeff(), nugget * model.process_variance() + 1e-6 * model.process_variance());
  }
}

// Far away r = 0: the mean is the trend and the variance s²(1 + 1/(1ᵀR⁻¹1)), above the process variance.
TEST(Model, FarFromTheRunsFallsBackToTheTrend) {
  const MatrixXd X = reference::design(20, 2, 5);
  const Model model = fit(X, reference::values(wave, X), fixed(2.0, 1e-3));
  MatrixXd R;
  const VectorXd low = X.colwise().minCoeff(), high = X.colwise().maxCoeff();
  const MatrixXd scaled =
      ((X.rowwise() - 0.5 * (low + high).transpose()) * (2.0 / (high - low).array()).matrix().asDiagonal());
  fill_correlation(scaled, VectorXd::Constant(2, 2.0), R);
  R = MatrixXd(R.selfadjointView<Eigen::Lower>());
  R.diagonal().array() += 1e-3;
  const double ones = VectorXd::Ones(20).dot(R.ldlt().solve(VectorXd::Ones(20)));
  const Prediction p = model.predict(MatrixXd::Constant(1, 2, 1e6));
  EXPECT_EQ(p.mean[0], model.trend());
  // Condition below 20/1e-3, so eleven digits hold.
  EXPECT_NEAR(p.variance[0] / model.process_variance(), 1 + 1 / ones, 1e-11);
}

TEST(Model, PredictsManyPointsAsItPredictsEach) {
  const MatrixXd X = reference::design(30, 2, 7), Z = reference::design(300, 2, 8);  // more than two blocks
  const Model model = fit(X, reference::values(wave, X), fixed(1.0, 1e-4));
  const Prediction all = model.predict(Z);
  const VectorXd mean = model.mean(Z);
  for (Eigen::Index i = 0; i < Z.rows(); ++i) {
    const Prediction one = model.predict(Z.row(i));
    // Blocks of other widths sum in another order; the condition of 1e5 multiplies the round-off.
    EXPECT_NEAR(all.mean[i], one.mean[0], 1e-10);
    EXPECT_NEAR(all.variance[i], one.variance[0], 1e-10 * model.process_variance());
    EXPECT_EQ(all.mean[i], mean[i]);
  }
  EXPECT_EQ(model.predict(MatrixXd(0, 2)).mean.size(), 0);
}

TEST(Surrogates, AreOneBlackBoxOfAllMeans) {
  const MatrixXd X = reference::design(20, 2, 9), Z = reference::design(5, 2, 10);
  const Model a = fit(X, reference::values(wave, X), fixed(1.0, 1e-4)),
              b = fit(X, X.col(1), fixed(0.2, 1e-4));
  const Surrogates surrogates({a, b});
  const std::vector<doe::Seed> seeds(5, 1);
  const std::vector<doe::Outcome> outcomes = surrogates(Z, seeds);
  ASSERT_EQ(outcomes.size(), 5u);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    ASSERT_EQ(outcomes[i].values().size(), 2);
    EXPECT_EQ(outcomes[i].values()[0], a.mean(Z)[i]);
    EXPECT_EQ(outcomes[i].values()[1], b.mean(Z)[i]);
  }
  EXPECT_THROW(Surrogates({}), std::invalid_argument);
  EXPECT_THROW(Surrogates({a, fit(X.leftCols(1), X.col(1), fixed(1, 1e-4))}), std::invalid_argument);
}

// A mean below the range of its response is no failed run: it counts as the bound. A model of other variables is a
// mistake of the program, refused before anything is evaluated.
TEST(Surrogates, KeepTheRangesAndTheVariablesOfTheProblem) {
  const MatrixXd X = reference::design(20, 2, 9);
  const VectorXd low = X.col(0).array() - 0.5;
  const Surrogates surrogates({fit(X, low, fixed(0.2, 1e-4)), fit(X, X.col(1), fixed(0.2, 1e-4))});
  const doe::Problem problem{
      .variables = {{"a", "1", 0, 1}, {"b", "1", 0, 1}},
      .responses = {{.name = "f", .unit = "1", .goal = doe::Goal::minimize, .lower = 0.0}, {"g", "1"}}};
  const doe::Evaluations runs = doe::evaluate(surrogates, problem, X);
  for (std::size_t i = 0; i < runs.rows.size(); ++i) {
    ASSERT_FALSE(runs.rows[i].outcome.failed()) << runs.rows[i].outcome.reason();
    const double mean = surrogates.members()[0].mean(X.row(static_cast<Eigen::Index>(i)))[0];
    EXPECT_EQ(runs.rows[i].outcome.values()[0], std::max(mean, 0.0));
  }
  const auto simulator = [](const VectorXd& x) { return VectorXd(Eigen::Vector2d(x[0] - 0.5, x[1])); };
  EXPECT_TRUE(doe::evaluate(simulator, problem, Eigen::RowVector2d(0.1, 0.1)).rows[0].outcome.failed())
      << "ranges hold for runs";
  doe::Problem wider = problem;
  wider.variables.push_back({"c", "1", 0, 1});
  EXPECT_THROW(doe::evaluate(surrogates, wider, MatrixXd::Zero(3, 3)), std::invalid_argument);
}

// A set of kinds gives what its members give, the derivatives too.
TEST(Surrogates, MayBeOfSeveralKinds) {
  const MatrixXd X = reference::design(20, 2, 9), Z = reference::design(5, 2, 10);
  const VectorXd y = reference::values(wave, X), x = Z.row(2).transpose();
  const Model model = fit(X, y, fixed(1.0, 1e-4));
  const Polynomial polynomial = fit_polynomial(X, y);
  const Radial radial = fit_radial(X, y);
  const Surrogates surrogates({model, polynomial, radial});
  const std::vector<doe::Outcome> outcomes = surrogates(Z, std::vector<doe::Seed>(5, 1));
  EXPECT_EQ(outcomes[2].values(),
            Eigen::Vector3d(model.mean(Z)[2], polynomial.mean(Z)[2], radial.mean(Z)[2]));
  const doe::ValueAndJacobian at = surrogates(x);
  EXPECT_EQ(at.values, Eigen::Vector3d(model(x), polynomial(x), radial(x)));
  EXPECT_EQ(at.jacobian.row(0).transpose(), model.mean_gradient(x));
  EXPECT_EQ(at.jacobian.row(1).transpose(), polynomial.mean_gradient(x));
  EXPECT_EQ(at.jacobian.row(2).transpose(), radial.mean_gradient(x));
  EXPECT_THROW(Surrogates({model, fit_polynomial(X.leftCols(1), y)}), std::invalid_argument);
}

// A surrogate of the user with nothing but predictions.
struct Flat {
  Prediction predict(const MatrixXd& X, Target = Target::latent) const {
    return {VectorXd::Zero(X.rows()), VectorXd::Zero(X.rows())};
  }
  VectorXd mean(const MatrixXd& X) const { return VectorXd::Zero(X.rows()); }
};

TEST(AnySurrogate, TellsWhatItsSurrogateTells) {
  const MatrixXd X = reference::design(20, 2, 9);
  const Model model = fit(X, X.col(1), fixed(0.2, 1e-4));
  const AnySurrogate any = model, flat = Flat{};
  EXPECT_EQ(any.status(), model.status());
  EXPECT_EQ(any.message(), model.message());
  EXPECT_EQ(any.variables(), 2);
  EXPECT_FALSE(flat.status() || flat.variables() || flat.mean_gradient(X.row(0).transpose()));
  EXPECT_EQ(flat.message(), "");
}

TEST(Surrogates, WithoutDerivativesCanBeSearchedOnly) {
  const MatrixXd X = reference::design(20, 2, 9);
  const Surrogates surrogates({fit(X, X.col(1), fixed(0.2, 1e-4)), Flat{}});
  EXPECT_EQ(surrogates(X, std::vector<doe::Seed>(20, 1))[0].values()[1], 0.0);
  try {
    surrogates(X.row(0).transpose());
    ADD_FAILURE();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(),
                 "kriging::Surrogates: member 1 has no derivatives; allowed are surrogates with "
                 "mean_gradient(x); search without polishing, or fit another kind");
  }
}
