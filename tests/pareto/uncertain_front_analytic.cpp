// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/pareto/vorobev.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

using doe::Goal;

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Four standard errors of a share of N draws, at its largest: fixed seeds, so one in 16 000 once.
double four_errors(int draws) { return 4.0 * 0.5 / std::sqrt(static_cast<double>(draws)); }

PredictedResponses predicted(const Eigen::MatrixXd& mean, const Eigen::MatrixXd& deviation) {
  return {mean, deviation};
}

const doe::Problem two = support::unit_problem(1, 2);

// b dominates a with Π_j Φ((μ_aj - μ_bj)/√(σ_aj² + σ_bj²)), and a dominates b with the same of -.
TEST(NonDomination, TwoPointsOfIndependentNormals) {
  Eigen::Matrix2d mean, deviation;
  mean << 1.0, 2.0, 1.3, 1.8;
  deviation << 0.3, 0.4, 0.4, 0.3;
  const Eigen::Vector2d z = (mean.row(0) - mean.row(1)).transpose() / 0.5;
  const NonDomination p =
      probability_non_dominated(two, draws_of_normals(predicted(mean, deviation), {.draws = 4096}));
  EXPECT_NEAR(p.probability[0], 1.0 - normal_cdf(z[0]) * normal_cdf(z[1]), four_errors(4096));
  EXPECT_NEAR(p.probability[1], 1.0 - normal_cdf(-z[0]) * normal_cdf(-z[1]), four_errors(4096));
  EXPECT_NEAR(p.standard_error[0], std::sqrt(p.probability[0] * (1.0 - p.probability[0]) / 4096), 1e-15);
}

// Of n unrelated points of one continuous law, the k-th best in the first objective is on the front iff it is
// the best of k in the second: 1 + 1/2 + ... + 1/n points in the mean. Their number has the variance
// Σ (1/k - 1/k²), so its mean over N draws the error below.
TEST(NonDomination, TheFrontOfUnrelatedPointsHasTheHarmonicNumberOfPoints) {
  const int n = 25, draws = 2048;
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(n, 2), one = Eigen::MatrixXd::Ones(n, 2);
  double expected = 0.0, variance = 0.0;
  for (int k = 1; k <= n; ++k) {
    expected += 1.0 / k;
    variance += 1.0 / k - 1.0 / (static_cast<double>(k) * k);
  }
  const NonDomination p = probability_non_dominated(two, draws_of_normals(predicted(zero, one), {draws, 7}));
  EXPECT_NEAR(p.probability.sum(), expected, 4.0 * std::sqrt(variance / draws));
}

TEST(NonDomination, CertainPointsAreOnTheFrontOrNot) {
  Eigen::MatrixXd mean(3, 2);
  mean << 0, 1, 1, 0, 1, 1;
  const Draws draws = draws_of_normals(predicted(mean, Eigen::MatrixXd::Zero(3, 2)), {.draws = 2});
  EXPECT_EQ(probability_non_dominated(two, draws).probability, Eigen::Vector3d(1, 1, 0));
}

// The better point meets its limit with Φ((5 - 4)/2) = Φ(1/2); the other one is on the front when it does
// not.
TEST(NonDomination, APointThatMayMissALimitLeavesItsPlace) {
  doe::Problem problem = two;
  problem.responses.push_back({"damage", "s", Goal::at_most, 5.0});
  Eigen::MatrixXd mean(2, 3), deviation(2, 3);
  mean << 0, 0, 4, 1, 1, 0;
  deviation << 0, 0, 2, 0, 0, 0;
  const Draws draws = draws_of_normals(predicted(mean, deviation), {.draws = 4096});
  const NonDomination p = probability_non_dominated(problem, draws);
  EXPECT_NEAR(p.probability[0], normal_cdf(0.5), four_errors(4096));
  EXPECT_EQ(p.probability[0] + p.probability[1], 1.0);
}

// A net's mean over N = 1024 points in four dimensions beats N unrelated draws: over 16 seeds the mean square
// error stays below a quarter of p(1-p)/N (chi-squared of 16 falls below a quarter of its mean once in 1e5).
TEST(Draws, QuasiMonteCarloBeatsUnrelatedDraws) {
  Eigen::Matrix2d mean, deviation = Eigen::Matrix2d::Ones();
  mean << 0, 0, 0.5, -0.2;
  const double exact = 1.0 - normal_cdf(-0.5 / std::sqrt(2.0)) * normal_cdf(0.2 / std::sqrt(2.0));
  double square = 0.0;
  for (doe::Seed seed = 1; seed <= 16; ++seed) {
    const Draws draws = draws_of_normals(predicted(mean, deviation), {1024, seed});
    square += std::pow(probability_non_dominated(two, draws).probability[0] - exact, 2) / 16.0;
  }
  EXPECT_LT(square, 0.25 * exact * (1.0 - exact) / 1024.0);
}

// Each coordinate is a stratified sample of N = 1024: one normal in each N-th of the probability, so the k-th
// smallest lies between the quantiles (k-1)/N and k/N. 30 points of 3 responses span three blocks.
TEST(Draws, EveryCoordinateIsStratified) {
  const PredictedResponses p =
      predicted(Eigen::MatrixXd::Constant(30, 3, 5.0), Eigen::MatrixXd::Constant(30, 3, 2.0));
  const Draws draws = draws_of_normals(p, {.draws = 1024, .seed = 3});
  for (const auto& [i, j] : {std::pair{0, 0}, {11, 2}, {12, 0}, {29, 2}}) {
    std::vector<double> shares;
    for (const Eigen::MatrixXd& Y : draws) shares.push_back(normal_cdf((Y(i, j) - 5.0) / 2.0));
    std::sort(shares.begin(), shares.end());
    for (int k = 0; k < 1024; ++k)
      EXPECT_NEAR(shares[static_cast<std::size_t>(k)], (k + 0.5) / 1024.0, 0.5 / 1024 + 1e-12);
  }
}

TEST(Draws, PathsAndFunctionsGiveTheSame) {
  const Eigen::MatrixXd X = Eigen::MatrixXd::Zero(3, 1);
  const auto mean_and_deviation = [](const Eigen::MatrixXd& at) {
    return predicted(Eigen::MatrixXd::Zero(at.rows(), 2), Eigen::MatrixXd::Ones(at.rows(), 2));
  };
  const Draws drawn = draws_at(mean_and_deviation, X, {.draws = 8, .seed = 2});
  std::vector<Eigen::MatrixXd> paths(2, Eigen::MatrixXd(3, 8));
  for (int s = 0; s < 8; ++s)
    for (int j = 0; j < 2; ++j)
      paths[static_cast<std::size_t>(j)].col(s) = drawn[static_cast<std::size_t>(s)].col(j);
  EXPECT_EQ(draws_of_paths(paths), drawn);
  const auto path_function = [&](const Eigen::MatrixXd&, const DrawOptions&) { return drawn; };
  EXPECT_EQ(draws_at(path_function, X), drawn);
}

// One point of means (1, 2) and deviations (0.5, 0.2), the second objective maximised: α(z) = Φ Φ. Where the
// other objective asks nothing, the p-quantile of the point's own normal; order statistics of a stratified
// sample lie within one N-th of their probability.
TEST(Attainment, OnePointHasTheNormalsOwnBand) {
  const doe::Problem problem{{{"x", "1", 0.0, 1.0}},
                             {{"cost", "SEK", Goal::minimize}, {"gain", "kg", Goal::maximize}}};
  const Draws draws =
      draws_of_normals(predicted(Eigen::RowVector2d(1, 2), Eigen::RowVector2d(0.5, 0.2)), {.draws = 4096});
  const FrontBand band = front_band(problem, draws, Eigen::RowVector2d(100, -100), 0.9);
  const auto share = [](double cost) { return normal_cdf((cost - 1.0) / 0.5); };
  const auto share_of_gain = [](double gain) { return normal_cdf((2.0 - gain) / 0.2); };
  EXPECT_NEAR(share(band.optimistic(0, 0)), 0.05, 1.0 / 4096);
  EXPECT_NEAR(share(band.median(0, 0)), 0.5, 1.0 / 4096);
  EXPECT_NEAR(share(band.pessimistic(0, 0)), 0.95, 1.0 / 4096);
  EXPECT_NEAR(share_of_gain(band.optimistic(0, 1)), 0.05, 1.0 / 4096);
  EXPECT_NEAR(share_of_gain(band.pessimistic(0, 1)), 0.95, 1.0 / 4096);
  const Eigen::VectorXd alpha = attainment_probability(problem, draws, Eigen::RowVector2d(1.2, 1.9));
  EXPECT_NEAR(alpha[0], normal_cdf(0.4) * normal_cdf(0.5), four_errors(4096));
}

// With the gain at its median only half of the draws reach the place at all: the cost attained with
// probability 0.25 is the median, and none is attained with 0.9.
TEST(Attainment, WhatTheOthersAskIsPaidFor) {
  const Draws draws =
      draws_of_normals(predicted(Eigen::RowVector2d(1, 2), Eigen::RowVector2d(0.5, 0.2)), {.draws = 4096});
  const Eigen::RowVector2d at(100, 2);
  EXPECT_NEAR(normal_cdf((attained_front(two, draws, at, 0.25)(0, 0) - 1.0) / 0.5), 0.5,
              4 * four_errors(4096));
  EXPECT_EQ(attained_front(two, draws, at, 0.9)(0, 0), INFINITY);
}

// n unrelated points: α(z) = 1 - (1 - Φ(z_1) Φ(z_2))^n.
TEST(Attainment, OfUnrelatedPoints) {
  const Draws draws = draws_of_normals(predicted(Eigen::MatrixXd::Zero(40, 2), Eigen::MatrixXd::Ones(40, 2)),
                                       {.draws = 4096});
  for (const double z : {-1.5, -1.0, -0.5}) {
    const double single = std::pow(normal_cdf(z), 2);
    EXPECT_NEAR(attainment_probability(two, draws, Eigen::RowVector2d(z, z))[0],
                1.0 - std::pow(1.0 - single, 40), four_errors(4096));
  }
}

/// Two equally likely fronts of one point each: (1, 1) and (0, 0), reference (2, 2). Volumes 1 and 4 in a box
/// of 4, α = 1 in the small square and 1/2 elsewhere: E vol = 2.5, Q = all at β* = 1/2, deviation 3/2.
TEST(Vorobev, TwoNestedFronts) {
  const Draws draws{Eigen::RowVector2d(1, 1), Eigen::RowVector2d(0, 0)};
  const Vorobev v = vorobev(two, draws, {.samples = 4096, .reference = Eigen::Vector2d(2, 2)});
  // A quarter of 4096 scrambled net points lie in the quarter square, up to its border.
  const double error = 4.0 * 2.0 / 4096.0;
  EXPECT_EQ(v.status, VorobevStatus::completed);
  EXPECT_EQ(v.threshold, 0.5);
  EXPECT_NEAR(v.expected_volume, 2.5, error);
  EXPECT_NEAR(v.deviation, 1.5, error);
}

TEST(Vorobev, ACertainFrontHasNoDeviationAndItsOwnVolume) {
  Eigen::Matrix2d Y;
  Y << 0, 1, 1, 0;
  const Vorobev v = vorobev(two, {Y, Y}, {.samples = 4096, .reference = Eigen::Vector2d(2, 2)});
  EXPECT_EQ(v.deviation, 0.0);
  EXPECT_NEAR(v.expected_volume, 3.0, 4.0 * 2.0 / 4096.0);
}

TEST(Vorobev, AReferenceThatNothingReachesLeavesNoVolume) {
  const Vorobev v = vorobev(two, {Eigen::RowVector2d(1, 1), Eigen::RowVector2d(2, 0)},
                            {.reference = Eigen::Vector2d(0.5, 0.5)});
  EXPECT_EQ(v.status, VorobevStatus::no_volume);
  EXPECT_EQ(v.message, "no draw dominates the reference point; give one that is worse in every objective");
  EXPECT_EQ(v.expected_volume, 0.0);
}

TEST(Vorobev, DeviationGrowsWithTheErrorOfTheSurrogate) {
  Eigen::MatrixXd mean(5, 2);
  mean << 0, 4, 1, 2, 2, 1.5, 3, 1, 4, 0;
  double last = 0.0;
  for (const double sigma : {0.05, 0.1, 0.2, 0.4}) {
    const Draws draws = draws_of_normals(predicted(mean, Eigen::MatrixXd::Constant(5, 2, sigma)), {256, 1});
    const double now = vorobev(two, draws, {.reference = Eigen::Vector2d(5, 5)}).deviation;
    EXPECT_GT(now, 1.5 * last);
    last = now;
  }
}

TEST(UncertainFront, BadInputIsNamed) {
  const auto text = [](const auto& call) { return support::thrown_text<std::invalid_argument>(call); };
  const PredictedResponses uneven{Eigen::MatrixXd::Zero(3, 2), Eigen::MatrixXd::Zero(2, 2)};
  EXPECT_EQ(text([&] { draws_of_normals(uneven); }),
            "pareto::draws_of_normals: mean is 3 x 2, deviation is 2 x 2; both need points x responses");
  const PredictedResponses fine{Eigen::MatrixXd::Zero(2, 2), Eigen::MatrixXd::Zero(2, 2)};
  EXPECT_EQ(text([&] { draws_of_normals(fine, {.draws = 1}); }),
            "pareto::draws_of_normals: draws is 1; allowed is 2 or more");
  const Draws draws = draws_of_normals(fine, {.draws = 2});
  EXPECT_EQ(
      text([&] { probability_non_dominated(support::unit_problem(1, 3), draws); }),
      "pareto::probability_non_dominated: a draw is 2 x 2; each must have 3 responses at the same points, "
      "one at least");
  EXPECT_EQ(text([&] { front_band(two, draws, Eigen::MatrixXd::Zero(1, 3)); }),
            "pareto::front_band: at has 3 columns; give one number per objective (2) at each place");
  EXPECT_EQ(text([&] { front_band(two, draws, Eigen::MatrixXd::Zero(1, 2), 1.0); }),
            "pareto::front_band: confidence is 1; allowed is above 0 and below 1");
  EXPECT_EQ(
      text([&] {
        draws_of_paths({Eigen::MatrixXd::Zero(3, 4), Eigen::MatrixXd::Zero(3, 5)});
      }),
      "pareto::draws_of_paths: one response has 3 x 5 paths, the first 3 x 4; draw all at the same points, "
      "equally often");
}

}  // namespace
