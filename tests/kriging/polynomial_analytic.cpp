// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/polynomial.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/kriging/without.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double cubic(const VectorXd& x) { return 1 + 2 * x[0] - x[1] + 3 * x[0] * x[1] * x[1] - 0.5 * x[0] * x[0]; }

double wave(const VectorXd& x) { return std::sin(3 * x[0]) + x[1] * x[1]; }

}  // namespace

// C(d + degree, degree) terms, and 1 + d·degree without products.
TEST(Monomials, AreAsManyAsTheBinomialSays) {
  EXPECT_EQ(detail::monomials(4, 3, 4).size(), 35u);
  EXPECT_EQ(detail::monomials(4, 3, 1).size(), 13u);
  EXPECT_EQ(detail::monomials(3, 2, 2).size(), 10u);
  EXPECT_EQ(detail::monomials(2, 0, 1).size(), 1u);
  EXPECT_EQ(detail::monomials(2, 2, 2)[4], (Monomial{1, 1}));
}

// 40 runs, ten terms, inputs within [-1, 1]: the condition of F is below 100, so 1e-16·100·40 = 4e-13.
TEST(PolynomialFit, ReproducesAPolynomial) {
  const MatrixXd X = reference::design(40, 2, 3), points = reference::design(200, 2, 4);
  const VectorXd y = reference::values(cubic, X);
  const Polynomial all = fit_polynomial(X, y, {.degree = 3, .interaction = 2});
  EXPECT_LE((all.mean(points) - reference::values(cubic, points)).cwiseAbs().maxCoeff(), 4e-13);
  EXPECT_EQ(all.status(), Status::converged);
  EXPECT_EQ(all.terms().size(), 10u);
  EXPECT_LE(leave_one_out(all).rmse, 1e-12);
  // The same function has fewer terms than candidates: the selection stops when the error is round-off, or
  // has them.
  const Polynomial chosen =
      fit_polynomial(X, y, {.degree = 4, .interaction = 2, .selection = Selection::leave_one_out});
  EXPECT_LE((chosen.mean(points) - reference::values(cubic, points)).cwiseAbs().maxCoeff(), 1e-11);
}

// Straight line through (−1, 0), (0, 1), (1, 5) by hand: slope 5/2, mean 2, residuals 1/2, −1, 1/2, s²
// = 1.5/1; hat values 1/3 + x²/2; at x = 1 the variance of the mean is s²·5/6, leave-one-out misses by
// 0.5/(1/6) = 3.
TEST(PolynomialFit, OfALineEqualsTheHandCalculation) {
  const MatrixXd X = Eigen::Vector3d(-1, 0, 1);
  const VectorXd y = Eigen::Vector3d(0, 1, 5);
  const Polynomial line = fit_polynomial(X, y, {.degree = 1});
  EXPECT_NEAR(line(VectorXd::Constant(1, 0.5)), 3.25, 1e-14);
  EXPECT_NEAR(line.noise_variance(), 1.5, 1e-14);
  const MatrixXd one = MatrixXd::Constant(1, 1, 1.0);
  EXPECT_NEAR(line.predict(one).variance[0], 1.25, 1e-14);
  EXPECT_NEAR(line.predict(one, Target::observation).variance[0], 2.75, 1e-14);
  const Validation v = leave_one_out(line);
  EXPECT_NEAR(v.observed[2] - v.predicted[2], 3.0, 1e-13);
  EXPECT_NEAR(v.predicted[1], 2.5, 1e-13);
}

// Refits without each run, the terms held by `all`: equal to the round-off of the fits, as above.
TEST(PolynomialLeaveOneOut, EqualsTheRefits) {
  const MatrixXd X = reference::design(25, 2, 3);
  const VectorXd y = reference::values(wave, X);
  const PolynomialOptions options{
      .degree = 3, .interaction = 2, .lower = VectorXd::Zero(2), .upper = VectorXd::Ones(2)};
  const Validation v = leave_one_out(fit_polynomial(X, y, options));
  for (Eigen::Index i = 0; i < 25; ++i)
    EXPECT_NEAR(v.predicted[i],
                fit_polynomial(reference::without(X, i), reference::without(y, i), options).mean(X.row(i))[0],
                1e-11);
}

// A site leaves with all of its runs: six of 25 are repeated twice more, with other values.
TEST(PolynomialLeaveOneOut, OfRepeatsEqualsTheRefitsWithoutTheirPoint) {
  MatrixXd X(37, 2);
  X << reference::design(25, 2, 3), reference::design(25, 2, 3).topRows(6),
      reference::design(25, 2, 3).topRows(6);
  VectorXd y = reference::values(wave, X);
  doe::RandomStream random(1);
  for (double& value : y) value += 0.2 * random.normal();
  const PolynomialOptions options{
      .degree = 3, .interaction = 2, .lower = VectorXd::Zero(2), .upper = VectorXd::Ones(2)};
  const Validation v = leave_one_out(fit_polynomial(X, y, options));
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    std::vector<Eigen::Index> rest;
    for (Eigen::Index j = 0; j < X.rows(); ++j)
      if (X.row(j) != X.row(i)) rest.push_back(j);
    const Polynomial others = fit_polynomial(detail::rows_of(X, rest), detail::entries_of(y, rest), options);
    EXPECT_NEAR(v.predicted[i], others.mean(X.row(i))[0], 1e-11) << i;
  }
}

// White noise over 12 places with 8 runs each: a leave-one-out that kept seven runs of the place would choose
// terms until the means of all places are met.
TEST(PolynomialSelection, LearnsNothingFromRepeatsOfNoise) {
  const MatrixXd places = reference::design(12, 1, 3);
  MatrixXd X(96, 1);
  for (int k = 0; k < 8; ++k) X.middleRows(12 * k, 12) = places;
  VectorXd mean = VectorXd::Zero(12), y(96);
  doe::RandomStream random(2);
  for (double& value : mean) value = random.normal();
  for (Eigen::Index i = 0; i < 96; ++i) y[i] = mean[i % 12] + 0.01 * random.normal();
  const Polynomial p = fit_polynomial(X, y, {.degree = 9, .selection = Selection::leave_one_out});
  EXPECT_LE(p.terms().size(), 4u);
  const double spread = std::sqrt((y.array() - y.mean()).square().mean());
  EXPECT_GT(leave_one_out(p).rmse, 0.9 * spread);
}

// With noise of deviation 0.3 on a response of three terms, candidates of degree 4 in three inputs are 35 for
// 60 runs: all of them fit the noise, the selection does not. Fixed seed; the ratio of errors is √(35/60) to
// √(some/60).
TEST(PolynomialSelection, LeavesOutWhatDoesNotHelp) {
  const MatrixXd X = reference::design(60, 3, 3), points = reference::design(500, 3, 4);
  const auto f = [](const VectorXd& x) { return 2 * x[0] - x[1] * x[1]; };
  VectorXd y = reference::values(f, X);
  doe::RandomStream random(1);
  for (double& value : y) value += 0.3 * random.normal();
  const PolynomialOptions all{.degree = 4, .interaction = 3};
  PolynomialOptions some = all;
  some.selection = Selection::leave_one_out;
  const Polynomial full = fit_polynomial(X, y, all), chosen = fit_polynomial(X, y, some);
  const VectorXd truth = reference::values(f, points);
  EXPECT_LT(chosen.terms().size(), 15u);
  EXPECT_LT(validate(chosen, points, truth).rmse, 0.7 * validate(full, points, truth).rmse);
  EXPECT_LT(leave_one_out(chosen).rmse, leave_one_out(full).rmse);
}

TEST(PolynomialStatus, TellsWhatTheRunsAllow) {
  const MatrixXd X = reference::design(5, 2, 3);
  const VectorXd y = reference::values(wave, X);
  const Polynomial few = fit_polynomial(X, y);
  EXPECT_EQ(few.status(), Status::too_few_runs);
  EXPECT_EQ(few.terms().size(), 3u) << few.message();
  const Polynomial one = fit_polynomial(X.topRows(1), y.head(1));
  EXPECT_EQ(one.status(), Status::too_few_runs);
  EXPECT_TRUE(std::isinf(one.predict(X).variance[0]));
  EXPECT_EQ(one.mean(X)[4], y[0]);
  const Polynomial flat = fit_polynomial(X, VectorXd::Constant(5, 3.0));
  EXPECT_EQ(flat.status(), Status::constant_response);
  EXPECT_EQ(flat.predict(X, Target::observation).variance[0], 0.0);
  EXPECT_EQ(leave_one_out(flat).rmse, 0.0);
  MatrixXd levels(12, 1);  // two levels cannot tell x² from 1
  for (int i = 0; i < 12; ++i) levels(i, 0) = i % 2;
  VectorXd response = levels.col(0);
  response[0] = 0.5;
  const Polynomial two = fit_polynomial(levels, response);
  EXPECT_EQ(two.status(), Status::ill_conditioned);
  EXPECT_EQ(two.terms().size(), 2u);
}

TEST(PolynomialStatus, RefusesBadInput) {
  const auto refusal = [](const PolynomialOptions& options, const VectorXd& y) -> std::string {
    try {
      fit_polynomial(reference::design(6, 2, 3), y, options);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  const VectorXd y = VectorXd::LinSpaced(6, 0, 1);
  EXPECT_EQ(refusal({.degree = -1}, y), "kriging::fit_polynomial: degree is -1; allowed is 0 to 20; use 2");
  EXPECT_EQ(refusal({.interaction = 0}, y),
            "kriging::fit_polynomial: interaction is 0; allowed is 1 or more; use 1 for no products");
  EXPECT_EQ(refusal({}, y.head(5)),
            "kriging::fit_polynomial: X has 6 rows but y has 5 entries; give one response a run");
  try {
    fit_polynomial(reference::design(6, 2, 3), y).mean(MatrixXd::Zero(1, 3));
    ADD_FAILURE();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(),
                 "kriging::Polynomial: X has 3 columns; the model has 2 variables; give one point per row");
  }
}

// A cubic is its own polynomial, so its derivatives are the formula's; the error of β is that of
// ReproducesAPolynomial, times the degree and the scale of the inputs.
TEST(PolynomialGradient, IsThatOfThePolynomial) {
  const MatrixXd X = reference::design(40, 2, 3), points = reference::design(20, 2, 4);
  const Polynomial model = fit_polynomial(X, reference::values(cubic, X), {.degree = 3, .interaction = 2});
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const VectorXd x = points.row(i).transpose();
    const Eigen::Vector2d exact(2 + 3 * x[1] * x[1] - x[0], -1 + 6 * x[0] * x[1]);
    EXPECT_LE((model.mean_gradient(x) - exact).cwiseAbs().maxCoeff(), 1e-11);
  }
  const Polynomial constant = fit_polynomial(X, VectorXd::Constant(40, 2.5));
  EXPECT_EQ(constant.mean_gradient(X.row(0).transpose()), VectorXd::Zero(2));
}
