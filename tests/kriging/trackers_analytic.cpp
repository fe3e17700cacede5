// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Faults that users of other libraries reported in public, as cases whose answer is known exactly. Each
/// test names the tracker and the number of the report.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <drawpoint/kriging/acquisition_constraints.hpp>
#include <drawpoint/kriging/acquisition_hypervolume.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/kriging/score.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/normal_surrogate.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <limits>
#include <numbers>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using doe::Goal;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

double waves(const VectorXd& x) { return std::sin(5 * x[0]) + x[1] * x[1]; }

/// θ and λ are given, as is the box [0, 1]², so that a point is 2x − 1 on the scale of the correlation.
FitOptions given(double theta, double nugget, Trend trend) {
  FitOptions options;
  options.theta_lower = options.theta_upper = theta;
  options.nugget_lower = options.nugget_upper = nugget;
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  options.trend = trend;
  options.parameter_uncertainty = options.may_be_exact = false;
  return options;
}

/// Gaussian correlations of the rows of A with those of B.
MatrixXd correlations_of(const MatrixXd& A, const MatrixXd& B, double theta) {
  MatrixXd C(A.rows(), B.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < B.rows(); ++j)
      C(i, j) = std::exp(-4 * theta * (A.row(i) - B.row(j)).squaredNorm());
  return C;
}

/// The terms 1, x₁, x₂ and, for a quadratic trend, x₁², x₁x₂, x₂².
MatrixXd terms_of(const MatrixXd& X, Trend trend) {
  const Eigen::ArrayXd a = X.col(0), b = X.col(1);
  MatrixXd F(X.rows(), trend == Trend::quadratic ? 6 : 3);
  F.leftCols(3) << VectorXd::Ones(X.rows()), X;
  if (trend == Trend::quadratic) F.rightCols(3) << a * a, a * b, b * b;
  return F;
}

double score_of_one(double observed, double predicted, double variance) {
  Validation v;
  v.observed = VectorXd::Constant(1, observed);
  v.predicted = VectorXd::Constant(1, predicted);
  v.variance = v.observation_variance = VectorXd::Constant(1, variance);
  return score(v, ErrorFunction::nlpd);
}

}  // namespace

// SMTorg/smt #486: a model stated no variance where it was wrong. ln σ + e²/2σ² grows without bound as σ
// vanishes beside an error e, and falls without bound without one: what was sure and wrong scores +∞, what
// was sure and right −∞, and nothing scores NaN, by which no model could be compared. A constant model is
// such a one.
TEST(Trackers, ASurePredictionThatIsWrongScoresInfinity) {
  for (const double tiny : {1e-100, 1e-300}) EXPECT_GT(score_of_one(1.0, 1.5, tiny), 1e97);
  EXPECT_EQ(score_of_one(1.0, 1.5, 0.0), unbounded);
  EXPECT_EQ(score_of_one(1.5, 1.5, 0.0), -unbounded);
  const MatrixXd X = reference::design(6, 2, 1);
  const Model constant = fit(X, VectorXd::Constant(6, 3.0));
  EXPECT_EQ(score(validate(constant, X, VectorXd::Constant(6, 4.0)), ErrorFunction::nlpd), unbounded);
}

// SALib/SALib #344: values that were all 192.53 had a variance of 8e-28, for their mean was rounded, and so
// had indices. Repeats that agree have the mean that each of them is, and no noise, whatever the number and
// how many.
TEST(Trackers, RepeatsThatAgreeHaveNoNoise) {
  for (const double value : {192.53, 0.1, 0.3, -1.0 / 3, 1e100})
    for (int m = 2; m <= 12; ++m) {
      MatrixXd X(2 * m, 1);
      X << VectorXd::Zero(m), VectorXd::Ones(m);
      for (const ReplicateNoise noise : {ReplicateNoise::pooled, ReplicateNoise::own}) {
        const Replicates r = replicates(X, VectorXd::Constant(2 * m, value), noise);
        EXPECT_EQ(r.y, Eigen::Vector2d::Constant(value)) << m << " times " << value;
        EXPECT_EQ(r.noise_variance, Eigen::Vector2d::Zero()) << m << " times " << value;
      }
    }
}

// SciML/Surrogates.jl #606: the term of the variance that an estimated trend adds squared the wrong
// residual. The best linear unbiased predictor wᵀy has Fᵀw = f and least squared error; with a multiplier m
// for each condition it solves [R F; Fᵀ 0][w; m] = [r; f], and its squared error is s²(1 − 2wᵀr + wᵀRw), in
// which the trend does not occur. With λ = 1e-3 the matrix has a condition below 20/1e-3, and far outside
// the weights reach 1e3: 1e3·2e4·1e-16·1e3 = 2e-6 of s² there, and 1e-9 within the box.
TEST(Trackers, TheVarianceIsTheSquaredErrorOfTheBestWeights) {
  const double theta = 0.9, nugget = 1e-3;
  const MatrixXd X = reference::design(20, 2, 3);
  const VectorXd y = reference::values(waves, X);
  for (const Trend trend : {Trend::linear, Trend::quadratic})
    for (const double reach : {1.0, 3.0}) {
      const MatrixXd Z = 0.5 * (1 - reach) + reach * reference::design(12, 2, 4).array();
      const Model model = fit(X, y, given(theta, nugget, trend));
      const MatrixXd F = terms_of(X, trend), r = correlations_of(X, Z, theta);
      const Eigen::Index n = X.rows(), q = F.cols();
      MatrixXd R = correlations_of(X, X, theta), system = MatrixXd::Zero(n + q, n + q),
               right(n + q, Z.rows());
      R.diagonal().array() += nugget;
      system.topLeftCorner(n, n) = R;
      system.topRightCorner(n, q) = F;
      system.bottomLeftCorner(q, n) = F.transpose();
      right << r, terms_of(Z, trend).transpose();
      const MatrixXd w = Eigen::FullPivLU<MatrixXd>(system).solve(right).topRows(n);
      const Prediction p = model.predict(Z);
      const double s2 = model.process_variance(), bound = reach > 1 ? 2e-6 : 1e-9;
      for (Eigen::Index i = 0; i < Z.rows(); ++i) {
        const double error = 1 - 2 * w.col(i).dot(r.col(i)) + w.col(i).dot(R * w.col(i));
        EXPECT_NEAR(p.mean[i], w.col(i).dot(y), bound) << i;
        EXPECT_NEAR(p.variance[i], s2 * error, bound * s2) << i;
      }
    }
}

// libKriging/libKriging #184 (as scikit-learn/scikit-learn #11663): deviations were NaN at runs that lie
// close, from negative variances. A run is itself an unbiased guess of the response at its place, of squared
// error τᵢ², its noise; the best linear unbiased one is no worse. So the variance at run i lies between 0
// and τᵢ², for every correlation and trend. Round-off is relative to s²: the smallest λ is 1e-6/s², the
// condition below 1e7 with twelve runs, so 1e-8.
TEST(Trackers, NoVarianceAtARunIsMoreThanItsNoise) {
  VectorXd x(12), noise(12);
  x << 0.00, 0.01, 0.02, 0.23, 0.24, 0.35, 0.50, 0.51, 0.76, 0.77, 0.99, 1.00;
  for (Eigen::Index i = 0; i < 12; ++i) noise[i] = std::pow(10.0, -static_cast<double>(i % 6) - 1);
  const VectorXd y = 1 - 0.5 * ((12 * x.array()).sin() / (1 + x.array()) + 2 * (7 * x.array()).cos());
  for (const Correlation correlation : {Correlation::gaussian, Correlation::matern32, Correlation::matern52})
    for (const Trend trend : {Trend::constant, Trend::linear, Trend::quadratic}) {
      FitOptions options;
      options.noise = Noise::known;
      options.noise_variance = noise;
      options.correlation = correlation;
      options.trend = trend;
      options.parameter_uncertainty = false;
      options.starts = 2;
      options.candidates = 8;
      const Model model = fit(x, y, options);
      const VectorXd at_runs = model.predict(x).variance;
      for (Eigen::Index i = 0; i < 12; ++i) {
        EXPECT_GE(at_runs[i], 0.0) << to_string(correlation) << ", run " << i;
        EXPECT_LE(at_runs[i], noise[i] + 1e-8 * model.process_variance())
            << to_string(correlation) << ", run " << i;
      }
      const VectorXd between = model.predict(VectorXd::LinSpaced(201, 0, 1)).variance;
      EXPECT_TRUE(between.allFinite());
      EXPECT_GE(between.minCoeff(), 0.0);
    }
}

// meta-pytorch/botorch #1565: the expected improvement and its slope vanished where none is likely, and
// searches stood still; its logarithm is to hold a hundred orders of magnitude away. t deviations beyond the
// best it is ln φ(t) + ln[(1 − 3/t² + 15/t⁴ − ...)/t²], and the next term, 105/t⁶, is 1e-16 from t = 1e3 on.
// Relative to t²/2 the numbers carry a few roundings. Of a deviation σ the argument is t/σ, and ln σ is
// added.
TEST(Trackers, TheLogarithmOfTheImprovementHoldsFarAway) {
  const doe::Criterion logarithm =
      log_expected_improvement(reference::NormalSurrogate{}, Goal::minimize, 0.0);
  const auto exact = [](double t) {
    const double u = 1 / (t * t);
    return -0.5 * t * t - 0.5 * std::log(2 * std::numbers::pi) - 2 * std::log(t) +
           std::log1p(-3 * u + 15 * u * u);
  };
  for (const double t : {1e3, 1e5, 1e8, 1e30, 1e100, 1e140}) {
    MatrixXd X(3, 2);
    X << t, 1.0, 1.001 * t, 1.0, 1.0, 1 / t;
    const VectorXd score = logarithm(X);
    EXPECT_NEAR(score[0] / exact(t), 1.0, 2e-15) << t;
    EXPECT_NEAR(score[1] / score[0], 1.002001, 1e-4) << "it falls as t²";
    EXPECT_NEAR(score[2] / (exact(t) - std::log(t)), 1.0, 2e-15) << t;
  }
}

// openturns/openturns #2012: paths could not be drawn on a mesh that holds runs, where the covariance is
// singular. Here it holds all runs and two points twice. At a run the variance is at most λs², so a path
// misses it by at most six of those deviations, and rows of points that are one point have equal paths, up
// to the root of the round-off of the covariance, √(21·2e-16) s < 1e-7 s, times normal numbers below 6.
TEST(Trackers, PathsOnAMeshThatHoldsTheRunsMeetThem) {
  const MatrixXd X = reference::design(8, 1, 3);
  const VectorXd y = (6 * X.col(0).array()).sin();
  FitOptions options;
  options.noise = Noise::none;
  options.parameter_uncertainty = false;
  const Model model = fit(X, y, options);
  const VectorXd grid = VectorXd::LinSpaced(11, 0, 1);
  MatrixXd mesh(21, 1);
  mesh << grid, X, grid.head(2);
  const MatrixXd paths = sample_paths(model, mesh, 20);
  ASSERT_TRUE(paths.allFinite());
  const double s = std::sqrt(model.process_variance()), round_off = 6e-7 * s;
  EXPECT_LE((paths.middleRows(11, 8).colwise() - y).cwiseAbs().maxCoeff(),
            6 * std::sqrt(model.noise_variance()) + round_off);
  EXPECT_LE((paths.topRows(2) - paths.bottomRows(2)).cwiseAbs().maxCoeff(), round_off);
  EXPECT_GT((paths.col(0) - paths.col(1)).cwiseAbs().maxCoeff(), 1e-3 * s) << "between the runs they differ";
}

// facebook/Ax #4970: the reference point of an objective to be minimised was taken from the wrong end of the
// runs, and every improvement of the hypervolume was 0. Turning a response and its goal over changes the
// signs of numbers and no other bit, so the improvement is the same, and somewhere it is above 0.
TEST(Trackers, TurningAnObjectiveOverChangesNoImprovement) {
  const MatrixXd X = reference::design(12, 2, 3), Z = reference::design(40, 2, 9);
  const VectorXd f = X.col(0) + X.col(1).cwiseAbs2(), g = (1 - X.col(0).array()).square();
  doe::Problem problem{.variables = {{"a", "1", 0, 1}, {"b", "1", 0, 1}},
                       .responses = {{"f", "1", Goal::minimize}, {"g", "1", Goal::minimize}}};
  const std::vector<Model> models{fit(X, f), fit(X, g)}, turned{fit(X, -f), fit(X, g)};
  const VectorXd improvement = constrained_hypervolume_improvement(problem, models)(Z);
  problem.responses[0].goal = Goal::maximize;
  EXPECT_EQ(constrained_hypervolume_improvement(problem, turned)(Z), improvement);
  EXPECT_GT(improvement.maxCoeff(), 1e-3);
}

// bayesian-optimization/BayesianOptimization #413: an acquisition with a constraint was another one even
// where the constraint is certain to hold. A response of one value keeps its limit with the probability 1,
// also on it, or 0: the improvement is that without the limit, to the bit, or nothing.
TEST(Trackers, ALimitThatIsSurelyKeptChangesNothing) {
  const MatrixXd X = reference::design(12, 2, 3), Z = reference::design(40, 2, 9);
  const Model cost = fit(X, X.col(0).cwiseAbs2() - X.col(1));
  const VectorXd free = expected_improvement(cost, Goal::minimize)(Z);
  ASSERT_GT(free.maxCoeff(), 1e-3);
  for (const Goal goal : {Goal::at_most, Goal::at_least}) {
    const doe::Problem problem{.variables = {{"a", "1", 0, 1}, {"b", "1", 0, 1}},
                               .responses = {{"cost", "EUR", Goal::minimize}, {"mass", "t", goal, 3.3}}};
    const double sign = goal == Goal::at_most ? 1.0 : -1.0;
    const auto score = [&](double mass) {
      return constrained_improvement(problem,
                                     std::vector<Model>{cost, fit(X, VectorXd::Constant(12, mass))})(Z);
    };
    EXPECT_EQ(score(3.3 - sign), free);
    EXPECT_EQ(score(3.3), free) << "on the limit";
    EXPECT_EQ(score(3.3 + sign), VectorXd(VectorXd::Zero(40)));
  }
}
