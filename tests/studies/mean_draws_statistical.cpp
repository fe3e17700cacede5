// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Draws of mean responses from noisy runs: the terms they are made of, and how often they hold the truth.

#include <drawpoint/studies/loading/statistics/finding_statistics.h>
#include <drawpoint/studies/loading/statistics/mean_draws.h>
#include <drawpoint/studies/loading/statistics/polynomial_terms.h>
#include <gtest/gtest.h>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/sobol.hpp>

#include <cmath>

using namespace drawpoint;
using namespace drawpoint::studies;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const doe::Problem problem{.variables = {{"a", "m", -1, 3}, {"b", "1", 0, 1}, {"c", "1", 0, 1}},
                           .responses = {{"y", "kg"}}};

// Products of up to degree 5 each: 1, 5 of each variable, and (1,1), (1,2), (2,1) of each pair.
TEST(PolynomialTerms, AreAHyperbolicCross) {
  const Eigen::MatrixXi degrees = term_degrees(3);
  EXPECT_EQ(degrees.rows(), 1 + 3 * 5 + 3 * 3);
  EXPECT_EQ(degrees.row(0).sum(), 0);
  EXPECT_EQ(degrees.maxCoeff(), 5);
}

// Of 4096 points of a net: (t, m, d)-nets integrate these products to some 1e-3.
TEST(PolynomialTerms, AreOrthonormalOverTheBox) {
  const MatrixXd X = doe::scrambled_sobol(problem, 4096);
  const MatrixXd B = term_values(problem, term_degrees(3), X);
  const MatrixXd G = B.transpose() * B / 4096.0;
  EXPECT_LT((G - MatrixXd::Identity(G.rows(), G.cols())).cwiseAbs().maxCoeff(), 0.02);
}

double truth(const VectorXd& x) { return 10 + 3 * x[0] + 4 * std::sin(3 * x[1]) + x[0] * x[1]; }

NoisyRuns noisy_runs(int n, double noise, doe::Seed seed) {
  NoisyRuns runs{.X = doe::latin_hypercube(problem, n, {.seed = seed}), .y = VectorXd(n), .noise = {}};
  doe::RandomStream random(seed);
  for (int i = 0; i < n; ++i) runs.y[i] = truth(runs.X.row(i).transpose()) + noise * random.normal();
  return runs;
}

TEST(MeanDraws, WithoutNoiseAreTheResponse) {
  const MatrixXd points = doe::scrambled_sobol(problem, 64);
  const MatrixXd draws = draw_means(problem, noisy_runs(80, 0, 1), points, 50, 1);
  for (Index i = 0; i < points.rows(); ++i)
    EXPECT_NEAR(draws.row(i).mean(), truth(points.row(i).transpose()), 0.1);
}

TEST(MeanDraws, OfEqualRunsAreEqual) {
  NoisyRuns runs = noisy_runs(20, 0, 1);
  runs.y.setConstant(7);
  const MatrixXd draws = draw_means(problem, runs, runs.X, 10, 1);
  EXPECT_EQ(draws.minCoeff(), 7);
  EXPECT_EQ(draws.maxCoeff(), 7);
}

TEST(MeanDraws, AreTheSameForTheSameSeed) {
  const NoisyRuns runs = noisy_runs(20, 1, 3);
  EXPECT_EQ(draw_means(problem, runs, runs.X, 5, 8), draw_means(problem, runs, runs.X, 5, 8));
  EXPECT_NE(draw_means(problem, runs, runs.X, 5, 8), draw_means(problem, runs, runs.X, 5, 9));
}

/// Mean over the points with most of b less that over the others.
double contrast(const MatrixXd& points, const VectorXd& y) {
  const VectorXd high = (points.col(1).array() > 0.7).cast<double>();
  return y.dot(high) / high.sum() - y.dot(VectorXd::Ones(y.size()) - high) / (high.size() - high.sum());
}

// Forty runs with noise of 2 beside a deviation of the mean of 4. Intervals of 95.4 %: of 60, fewer than 53 hold
// with a chance of 0.6 %.
TEST(MeanDraws, HoldTheTruthAsOftenAsTheySay) {
  const MatrixXd points = doe::scrambled_sobol(problem, 256);
  VectorXd means(points.rows());
  for (Index i = 0; i < points.rows(); ++i) means[i] = truth(points.row(i).transpose());
  int held = 0;
  for (doe::Seed seed = 1; seed <= 60; ++seed) {
    NoisyRuns runs = noisy_runs(40, 2, seed);
    runs.noise = {.variance = 4, .degrees = 4, .weights = {}};
    const MatrixXd draws = draw_means(problem, runs, points, 200, seed);
    std::vector<double> contrasts;
    for (const auto draw : draws.colwise()) contrasts.push_back(contrast(points, draw));
    const Estimate estimate = estimate_of(contrasts);
    held += std::abs(estimate.value - contrast(points, means)) < 2 * estimate.error;
  }
  EXPECT_GE(held, 53);
}

}  // namespace
