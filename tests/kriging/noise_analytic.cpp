// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double hills(const VectorXd& x) { return std::sin(6 * x[0]) + 2 * std::pow(x[1] - 0.4, 2); }

VectorXd noisy(const MatrixXd& X, double deviation, doe::Seed seed) {
  VectorXd y = reference::values(hills, X);
  doe::RandomStream random(seed);
  for (double& value : y) value += deviation * random.normal();
  return y;
}

const MatrixXd points = reference::design(50, 2, 33);

}  // namespace

// The nugget's fit maximises over (θ, λ, s²) at once, here without a power of λ in its prior, which known
// noise does not have. Known noise restricts λs² to τ²: given the τ² that the nugget's fit found, the
// restricted maximum is the same point. Both searches end with less than 1e-3 to
// gain, where curvatures of about n/2 leave ln λ within √(2e-3/20) = 0.01, predictions within a hundredth of
// the noise.
TEST(Noise, KnownAsTheNuggetWasEstimatedGivesTheSameModel) {
  const MatrixXd X = reference::design(40, 2, 21);
  const VectorXd y = noisy(X, 0.2, 4);
  FitOptions options;
  options.nugget_power = 0;
  const Model nugget = fit(X, y, options);
  options.noise = Noise::known;
  options.noise_variance = VectorXd::Constant(40, nugget.noise_variance());
  const Model known = fit(X, y, options);
  EXPECT_NEAR(known.log_likelihood(), nugget.log_likelihood(), 2e-3);
  EXPECT_NEAR(known.nugget() / nugget.nugget(), 1.0, 0.03);
  EXPECT_NEAR(known.noise_variance() / nugget.noise_variance(), 1.0, 1e-12) << "λ s² is what was given";
  EXPECT_LT((known.mean(points) - nugget.mean(points)).cwiseAbs().maxCoeff(), 0.01 * 0.2);
}

// Equal weights are the nugget's model, but for the floor of 1e-10 beside λ near 1e-2.
TEST(Noise, ProportionalWithEqualWeightsIsTheNugget) {
  const MatrixXd X = reference::design(40, 2, 21);
  const VectorXd y = noisy(X, 0.2, 4);
  FitOptions options;
  options.noise = Noise::proportional;
  options.noise_variance = VectorXd::Constant(40, 17.0);
  const Model a = fit(X, y), b = fit(X, y, options);
  EXPECT_NEAR(a.log_likelihood(), b.log_likelihood(), 1e-3);
  EXPECT_LT((a.mean(points) - b.mean(points)).cwiseAbs().maxCoeff(), 0.01 * 0.2);
}

// A run of m replicates with noise σ² is, for the posterior of the latent function, one run of the mean with
// σ²/m: exact algebra (Binois, Gramacy, Ludkovski 2018, lemma 3.1 for the predictions), so at one θ, s² and λ
// the predictions agree to the condition, asserted below 1e5, times round-off.
TEST(Noise, MeansOfReplicatesPredictAsAllRuns) {
  const MatrixXd X = reference::design(12, 2, 21);
  MatrixXd all(27, 2);
  all << X, X, X.topRows(3);  // two or three runs per point
  const VectorXd y = noisy(all, 0.2, 5);
  const Replicates r = replicates(all, y);
  ASSERT_EQ(r.X, X);
  ASSERT_EQ(r.count.head(4), Eigen::Vector4i(3, 3, 3, 2));
  FitOptions options;
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  options.theta_lower = options.theta_upper = 1.5;
  options.nugget_lower = options.nugget_upper = 0.1;
  const Model whole = fit(all, y, options);
  options.noise = Noise::proportional;
  options.noise_variance = r.count.cast<double>().cwiseInverse();
  options.nugget_lower = options.nugget_upper = 0.1 * options.noise_variance.mean();
  const Model means = fit(r.X, r.y, options);
  ASSERT_LT(whole.report().condition, 1e5);
  // The floor of 1e-10 beside noise of 0.03 and more moves α by 3e-9 of itself.
  EXPECT_LT((whole.mean(points) - means.mean(points)).cwiseAbs().maxCoeff(), 3e-8);
  const VectorXd a = whole.predict(points).variance / whole.process_variance();
  const VectorXd b = means.predict(points).variance / means.process_variance();
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 3e-8);
}

// Runs 1, 3 at one point, 2, 4, 9 at the other: means 2 and 5, squares 2 and 9 + 1 + 16 = 26, 28/3 pooled. Two points
// scatter no more than chance has it, so that the noise of each own is that as well; of variances that differ
// nine hundredfold, of five runs each, each keeps most of its own.
TEST(Replicates, FollowTheirDefinition) {
  const MatrixXd X = (MatrixXd(5, 1) << 7, 8, 7, 8, 8).finished();
  const VectorXd y = (VectorXd(5) << 1, 2, 3, 4, 9).finished();
  const Replicates pooled = replicates(X, y), own = replicates(X, y, ReplicateNoise::own);
  EXPECT_EQ(pooled.X, Eigen::Vector2d(7, 8));
  EXPECT_EQ(pooled.y, Eigen::Vector2d(2, 5));
  EXPECT_NEAR(pooled.noise_variance[0], 28.0 / 3 / 2, 1e-14);
  EXPECT_NEAR(pooled.noise_variance[1], 28.0 / 3 / 3, 1e-14);
  EXPECT_NEAR(own.noise_variance[0], 28.0 / 3 / 2, 1e-14);
  EXPECT_NEAR(own.noise_variance[1], 28.0 / 3 / 3, 1e-14);
  MatrixXd places(30, 1);
  VectorXd values(30);
  for (int i = 0; i < 30; ++i) {
    places(i, 0) = i % 6;
    values[i] = (i % 2 ? 30.0 : 1.0) * (i / 6);
  }
  const VectorXd differ = replicates(places, values, ReplicateNoise::own).noise_variance;
  VectorXd variance(6);
  for (int i = 0; i < 6; ++i) variance[i] = i % 2 ? 900 * 2.5 : 2.5;
  EXPECT_LT((differ - moderated_noise(variance, 4.0) / 5).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT(differ[1] / differ[0], 100);
}

TEST(Replicates, RefuseWhatHasNone) {
  try {
    replicates(VectorXd::LinSpaced(3, 0, 1), VectorXd::Ones(3));
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()),
              "kriging::replicates: no two rows of X are equal; allowed is one repeated point or more; use "
              "Noise::nugget");
  }
  EXPECT_THROW(replicates(Eigen::Vector3d(0, 0, 1), VectorXd::Ones(3), ReplicateNoise::own),
               std::invalid_argument);
}

// A quiet half and a loud half. With its noise known the model must follow the quiet runs: their residuals
// stay within 4 deviations of their noise, where one nugget for all would smooth over them.
TEST(Noise, QuietRunsAreFollowedAndLoudOnesSmoothed) {
  const MatrixXd X = reference::design(60, 1, 2);
  VectorXd y(60), variance(60);
  doe::RandomStream random(3);
  for (Eigen::Index i = 0; i < 60; ++i) {
    variance[i] = X(i, 0) < 0.5 ? 1e-6 : 0.25;
    y[i] = std::sin(10 * X(i, 0)) + std::sqrt(variance[i]) * random.normal();
  }
  FitOptions options;
  options.noise = Noise::known;
  options.noise_variance = variance;
  const VectorXd mean = fit(X, y, options).mean(X);
  double quiet = 0, loud = 0;
  for (Eigen::Index i = 0; i < 60; ++i) (X(i, 0) < 0.5 ? quiet : loud) += std::pow(mean[i] - y[i], 2) / 30;
  EXPECT_LT(std::sqrt(quiet), 4e-3);
  EXPECT_GT(std::sqrt(loud), 0.25);
}
