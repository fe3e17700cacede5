// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Success and failure: the posterior against exact integrals, the derivatives, and what the model must
/// respect.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/detail/normal_quantile.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/success_model.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd uniform_points(Eigen::Index n, Eigen::Index d, doe::Seed seed) {
  doe::RandomStream random(seed);
  MatrixXd X(n, d);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < d; ++k) X(i, k) = random.uniform();
  return X;
}

/// Fails beyond a slanted edge.
std::vector<bool> beyond_edge(const MatrixXd& X) {
  std::vector<bool> succeeded;
  for (Eigen::Index i = 0; i < X.rows(); ++i) succeeded.push_back(X(i, 0) + 0.5 * X(i, 1) < 0.9);
  return succeeded;
}

SuccessOptions unit_box(Eigen::Index d) { return {VectorXd::Zero(d), VectorXd::Ones(d)}; }

/// Six runs of two kinds, with a covariance of deviation 2 and a wide mean.
struct SixRuns {
  MatrixXd K{6, 6};
  VectorXd y{{1, 1, -1, 1, -1, -1}};

  SixRuns() {
    const VectorXd x{{0.0, 0.1, 0.35, 0.5, 0.8, 1.0}};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) K(i, j) = 4.0 + 4.0 * std::exp(-8.0 * std::pow(x[i] - x[j], 2));
  }
};

std::vector<detail::SuccessRun> as_runs(const VectorXd& y) {
  std::vector<detail::SuccessRun> runs;
  for (const double sign : y) runs.push_back({sign});
  return runs;
}

// Two runs of one kind: Z = 1/4 + asin(r)/(2 pi), r = k12/(1 + k11), the probability that two normal
// variables of correlation r are positive (Sheppard 1899). With one run expectation propagation is exact, to
// round-off; with two it is not, and the tolerances are the errors that the header states: this holds them to
// it.
TEST(SuccessPosterior, EvidenceOfOneAndTwoRuns) {
  const auto one = detail::latent_posterior(MatrixXd::Constant(1, 1, 3.0), as_runs(VectorXd::Ones(1)));
  EXPECT_NEAR(one.log_evidence, std::log(0.5), 1e-12);
  for (const auto& [variance, stated] : {std::pair(0.1, 0.015), {1.0, 0.015}, {4.0, 0.015}, {50.0, 0.065}})
    for (const double correlation : {-0.9, 0.0, 0.5, 0.99}) {
      MatrixXd K = MatrixXd::Constant(2, 2, correlation * variance);
      K.diagonal().setConstant(variance);
      const auto both = detail::latent_posterior(K, as_runs(VectorXd::Ones(2)));
      const double r = correlation * variance / (1.0 + variance);
      EXPECT_TRUE(both.converged);
      EXPECT_NEAR(both.log_evidence, std::log(0.25 + std::asin(r) / (2.0 * std::numbers::pi)), stated)
          << variance << " " << correlation;
    }
}

// At a fixed point the posterior of each run has the mean and variance of cavity times Phi(y f), here by
// Simpson's rule over twelve deviations of the cavity on 4000 intervals: its error is far below 1e-8, and the
// sites stand still to 1e-9.
TEST(SuccessPosterior, AgreesWithTheMomentsOfEachRun) {
  const SixRuns runs;
  const auto posterior = detail::latent_posterior(runs.K, as_runs(runs.y));
  ASSERT_TRUE(posterior.converged);
  const detail::SitePosterior marginals(runs.K, posterior.sites);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double m = marginals.cavity_mean(i), s = 1.0 / std::sqrt(marginals.cavity_precision(i));
    double sum[3] = {0, 0, 0};
    constexpr int intervals = 4000;
    for (int k = 0; k <= intervals; ++k) {
      const double f = m + s * (24.0 * k / intervals - 12.0);
      const double weight = (k == 0 || k == intervals ? 1
                             : k % 2                  ? 4
                                                      : 2) *
                            0.5 * std::erfc(-runs.y[i] * f / std::numbers::sqrt2) *
                            std::exp(-0.5 * std::pow((f - m) / s, 2));
      for (int power = 0; power < 3; ++power) sum[power] += weight * std::pow(f, power);
    }
    const double mean = sum[1] / sum[0];
    EXPECT_NEAR(marginals.mean(i), mean, 1e-7);
    EXPECT_NEAR(marginals.variance(i), sum[2] / sum[0] - mean * mean, 1e-7);
  }
}

// Z and P(success of the fourth run | the other five) against the share of 400 000 draws of f, each weighted
// by the product of Phi(y f). Standard errors from the draws themselves; the method's own error is stated as
// 0.01.
TEST(SuccessPosterior, AgreesWithDrawsOfTheLatentProcess) {
  const SixRuns runs;
  const Eigen::LLT<MatrixXd> factor(runs.K);
  const MatrixXd L = factor.matrixL();
  doe::RandomStream random(11);
  constexpr int draws = 400000;
  double all = 0, all_squares = 0, others = 0;
  for (int draw = 0; draw < draws; ++draw) {
    VectorXd z(6);
    for (double& value : z) value = doe::detail::normal_quantile(random.uniform());
    const VectorXd f = L * z;
    double weight = 1;
    for (const int i : {0, 1, 2, 4, 5}) weight *= detail::normal_probability(runs.y[i] * f[i]);
    others += weight;
    weight *= detail::normal_probability(runs.y[3] * f[3]);
    all += weight;
    all_squares += weight * weight;
  }
  const double Z = all / draws, relative = std::sqrt(all_squares / draws - Z * Z) / std::sqrt(draws) / Z;
  const auto posterior = detail::latent_posterior(runs.K, as_runs(runs.y));
  EXPECT_NEAR(posterior.log_evidence, std::log(Z), 0.01 + 4 * relative);
  // The errors of all and others are nearly the same draws; 4 relative errors are above their quotient's.
  EXPECT_NEAR(std::exp(posterior.left_out[3]), all / others, 0.01 + 4 * relative);
}

// Central differences with h = 1e-4 have an error of h²/6 times the third derivative, some 1e-8, and what the
// sites' tolerance of 1e-9 leaves in ln Z, over 2h.
TEST(LatentLikelihood, GradientIsThatOfTheValue) {
  const MatrixXd U = uniform_points(30, 3, 3);
  const std::vector<bool> succeeded = beyond_edge(U);
  VectorXd y(30);
  for (Eigen::Index i = 0; i < 30; ++i) y[i] = succeeded[static_cast<std::size_t>(i)] ? 1 : -1;
  detail::LatentLikelihood likelihood((2.0 * U.array() - 1.0).matrix(), as_runs(y));
  VectorXd p = likelihood.middle();
  p += VectorXd{{1.3, -0.4, 0.2, 0.7}};
  const VectorXd gradient = likelihood.gradient(p);
  for (Eigen::Index k = 0; k < 4; ++k) {
    VectorXd up = p, down = p;
    up[k] += 1e-4;
    down[k] -= 1e-4;
    EXPECT_NEAR(gradient[k], (likelihood.value(up) - likelihood.value(down)) / 2e-4, 1e-5);
  }
}

// Success and failure are two names: with them exchanged P becomes 1 − P. The fits see the same numbers but
// for signs; sites stop at 1e-9.
TEST(SuccessModel, FailureIsTheComplementOfSuccess) {
  const MatrixXd X = uniform_points(40, 2, 5), Z = uniform_points(50, 2, 6);
  std::vector<bool> succeeded = beyond_edge(X);
  const VectorXd P = fit_success(X, succeeded, unit_box(2)).probability(Z);
  succeeded.flip();
  EXPECT_LT(
      (fit_success(X, succeeded, unit_box(2)).probability(Z) + P - VectorXd::Ones(50)).cwiseAbs().maxCoeff(),
      1e-6);
}

TEST(SuccessModel, UnitsDoNotMatter) {
  const MatrixXd X = uniform_points(40, 2, 5), Z = uniform_points(50, 2, 6);
  const VectorXd P = fit_success(X, beyond_edge(X), unit_box(2)).probability(Z);
  const auto other_units = [](MatrixXd points) {
    points.col(0) = (1e6 * points.col(0).array() + 3e6).matrix();
    points.col(1) *= 1e-3;
    return points;
  };
  const SuccessOptions box{VectorXd{{3e6, 0}}, VectorXd{{4e6, 1e-3}}};
  const VectorXd same = fit_success(other_units(X), beyond_edge(X), box).probability(other_units(Z));
  EXPECT_LT((same - P).cwiseAbs().maxCoeff(), 1e-6);  // round-off of 4e6, times the slope of a sharp edge
}

// Far on both sides of an edge the model is sure, and on the edge it is not.
TEST(SuccessModel, KnowsBothSidesOfAnEdge) {
  const MatrixXd X = uniform_points(80, 2, 9);
  const SuccessModel model = fit_success(X, beyond_edge(X), unit_box(2));
  const VectorXd P = model.probability(MatrixXd{{0.1, 0.1}, {0.95, 0.9}, {0.65, 0.5}});
  EXPECT_GT(P[0], 0.95);
  EXPECT_LT(P[1], 0.05);
  EXPECT_GT(P[2], 0.1);
  EXPECT_LT(P[2], 0.9);
  EXPECT_GT(model.left_out_score(), model.share_score());
  EXPECT_TRUE(model.converged());
}

// Ten runs at one place, half of them failed, count as ten: P there is near one half, whatever is elsewhere.
TEST(SuccessModel, RepeatedRunsCountEach) {
  MatrixXd X = MatrixXd::Constant(20, 1, 0.5);
  std::vector<bool> succeeded(20, true);
  for (int i = 0; i < 10; ++i) X(10 + i, 0) = 0.1 * i / 10.0;
  for (std::size_t i = 0; i < 5; ++i) succeeded[i] = false;
  const VectorXd P = fit_success(X, succeeded, unit_box(1)).probability(MatrixXd{{0.5}, {0.05}});
  EXPECT_NEAR(P[0], 0.5, 0.16);  // the standard error of a share of 10
  EXPECT_GT(P[1], 0.9);
}

TEST(SuccessModel, OneKindAlone) {
  const MatrixXd X = uniform_points(20, 3, 2), Z = uniform_points(50, 3, 7);
  const SuccessModel sound = fit_success(X, std::vector<bool>(20, true), unit_box(3));
  EXPECT_GT(sound.probability(Z).minCoeff(), 0.5);
  EXPECT_EQ(sound.failures(), 0);
  EXPECT_LT(fit_success(X, std::vector<bool>(20, false), unit_box(3)).probability(Z).maxCoeff(), 0.5);
  const double one = fit_success(MatrixXd{{0.3}}, {true}).probability(MatrixXd{{0.3}})[0];
  EXPECT_GT(one, 0.5);
  EXPECT_LT(one, 1.0);
}

// An input that never varies says nothing, at any value.
TEST(SuccessModel, AnInputThatNeverVariesIsIgnored) {
  MatrixXd X = uniform_points(30, 2, 4);
  const std::vector<bool> succeeded = beyond_edge(X);
  X.col(1).setConstant(2.0);
  const SuccessModel model = fit_success(X, succeeded);
  EXPECT_EQ(model.probability(MatrixXd{{0.4, 2.0}})[0], model.probability(MatrixXd{{0.4, 9.0}})[0]);
}

// Of 1000 runs all failures are seen while they are few, and half of each kind when both are many.
TEST(SuccessModel, TheCovarianceSeesBothKinds) {
  const auto failed_among = [](int failures, int runs) {
    std::vector<bool> succeeded(static_cast<std::size_t>(runs), true);
    for (int i = 0; i < failures; ++i) succeeded[static_cast<std::size_t>(i * runs / failures)] = false;
    const auto rows = detail::rows_of_both_kinds(succeeded, 150);
    EXPECT_EQ(static_cast<int>(rows.size()), std::min(runs, 150));
    EXPECT_EQ(std::adjacent_find(rows.begin(), rows.end()), rows.end());
    return std::count_if(rows.begin(), rows.end(),
                         [&](auto row) { return !succeeded[static_cast<std::size_t>(row)]; });
  };
  EXPECT_EQ(failed_among(3, 1000), 3);
  EXPECT_EQ(failed_among(400, 1000), 75);
  EXPECT_EQ(failed_among(990, 1000), 140);
  EXPECT_EQ(failed_among(40, 60), 40);
}

TEST(SuccessModel, FromEvaluationsInTheirBox) {
  doe::Evaluations runs{
      {.variables = {{"a", "m", 0, 1}, {"b", "m", 0, 1}}, .responses = {{"y", "1", doe::Goal::minimize}}}};
  const MatrixXd X = uniform_points(30, 2, 8), Z = uniform_points(20, 2, 9);
  const std::vector<bool> succeeded = beyond_edge(X);
  for (Eigen::Index i = 0; i < 30; ++i) {
    doe::Evaluation row;
    row.x = X.row(i);
    row.outcome = succeeded[static_cast<std::size_t>(i)] ? doe::Outcome(1.0) : doe::Failure{"stuck"};
    runs.rows.push_back(row);
  }
  EXPECT_EQ(fit_success(runs).probability(Z), fit_success(X, succeeded, unit_box(2)).probability(Z));
  EXPECT_EQ(probability_of_success(fit_success(runs))(Z), fit_success(runs).probability(Z));
}

TEST(SuccessModel, BadInputIsRefused) {
  using support::expect_told;
  const MatrixXd X = uniform_points(4, 2, 1);
  const std::vector<bool> all(4, true);
  MatrixXd broken = X;
  broken(1, 1) = std::numeric_limits<double>::quiet_NaN();
  expect_told([&] { fit_success(MatrixXd(0, 2), {}); },
              {"kriging::fit_success", "X is 0 x 2", "1 x 1 or more"});
  expect_told([&] { fit_success(X, {true}); }, {"X has 4 rows", "succeeded has 1 entries"});
  expect_told([&] { fit_success(broken, all); }, {"not finite"});
  expect_told(
      [&] {
        fit_success(X, all, {VectorXd::Zero(2), VectorXd::Ones(1)});
      },
      {"2 lower and 1 upper", "2 columns"});
  expect_told(
      [&] {
        fit_success(X, all, {VectorXd::Ones(2), VectorXd::Ones(2)});
      },
      {"variable 0", "lower below upper"});
  expect_told([&] { fit_success(X, all).probability(MatrixXd(1, 3)); }, {"3 columns", "allowed are 2"});
}

}  // namespace
