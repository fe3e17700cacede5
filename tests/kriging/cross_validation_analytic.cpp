// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <set>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double wave(const VectorXd& x) { return std::sin(5 * x[0]) + x[1] * x[1]; }

MatrixXd without(const MatrixXd& X, Eigen::Index row) {
  MatrixXd rest(X.rows() - 1, X.cols());
  rest << X.topRows(row), X.bottomRows(X.rows() - 1 - row);
  return rest;
}

FitOptions fixed(const Model& model) {
  FitOptions options;
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  options.theta_lower = options.theta_upper = model.theta()[0];
  options.nugget_lower = options.nugget_upper = model.nugget();
  return options;
}

const auto fitter = [](auto& X, auto& y) { return fit(X, y); };  // as docs/explanation/kriging.md has it

}  // namespace

// Brute force: n fits of n − 1 runs with θ and λ held. Their s² is estimated anew, so variances compare as
// shares of it. With known noise λ follows from s² and the runs, so the refits are given the same λ as
// proportional noise of the same weights. The condition is below 1e6 (asserted): 1e-9 leaves 1e-16·1e6 a
// factor of ten.
TEST(LeaveOneOut, EqualsTheRefitsWithTrendsAndNoise) {
  const MatrixXd X = reference::design(24, 2, 3);
  VectorXd y = reference::values(wave, X), noise = VectorXd::LinSpaced(24, 0.5, 1.5);
  doe::RandomStream random(5);
  for (double& value : y) value += 0.05 * random.normal();
  for (const Trend trend : {Trend::constant, Trend::linear, Trend::quadratic})
    for (const bool weighted : {false, true}) {
      FitOptions options;
      options.lower = VectorXd::Zero(2);
      options.upper = VectorXd::Ones(2);
      options.theta_lower = options.theta_upper = 1.3;
      options.nugget_lower = options.nugget_upper = 0.01;
      options.trend = trend;
      if (weighted) {
        options.noise = Noise::proportional;
        options.noise_variance = noise;
      }
      const Model model = fit(X, y, options);
      ASSERT_LT(model.report().condition, 1e6);
      const Validation v = leave_one_out(model);
      for (Eigen::Index i = 0; i < 24; ++i) {
        FitOptions rest = options;
        if (weighted) {
          rest.noise_variance = without(noise, i);
          // λ multiplies variances over their mean, which leaving one out moves.
          const double nugget = 0.01 * rest.noise_variance.mean() / noise.mean();
          rest.nugget_lower = rest.nugget_upper = nugget;
        }
        const Model other = fit(without(X, i), without(y, i), rest);
        const Prediction p = other.predict(X.row(i));
        EXPECT_NEAR(v.predicted[i], p.mean[0], 1e-9) << i;
        EXPECT_NEAR(v.variance[i] / model.process_variance(), p.variance[0] / other.process_variance(), 1e-9)
            << i;
        EXPECT_NEAR((v.observation_variance[i] - v.variance[i]) / model.process_variance(),
                    0.01 * (weighted ? noise[i] / noise.mean() : 1.0), 1e-9);
      }
    }
}

// A repeat gives the others of its point away, so points are left out with all their runs: as a refit without
// them predicts, at the same θ and λ, to the round-off of the test above.
TEST(LeaveOneOut, OfRepeatsEqualsTheRefitsWithoutTheirPoint) {
  const MatrixXd points = reference::design(12, 2, 3);
  const std::vector<Eigen::Index> place{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 4, 4, 7, 0};
  const MatrixXd X = points(place, Eigen::all);
  VectorXd y = reference::values(wave, X);
  doe::RandomStream random(6);
  for (double& value : y) value += 0.05 * random.normal();
  FitOptions options;
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  options.theta_lower = options.theta_upper = 1.3;
  options.nugget_lower = options.nugget_upper = 0.01;
  for (const Trend trend : {Trend::constant, Trend::linear}) {
    options.trend = trend;
    const Model model = fit(X, y, options);
    const Validation v = leave_one_out(model);
    for (std::size_t i = 0; i < place.size(); ++i) {
      std::vector<Eigen::Index> others;
      for (std::size_t k = 0; k < place.size(); ++k)
        if (place[k] != place[i]) others.push_back(static_cast<Eigen::Index>(k));
      const auto row = static_cast<Eigen::Index>(i);
      const Model other = fit(X(others, Eigen::all), y(others), options);
      const Prediction p = other.predict(X.row(row));
      EXPECT_NEAR(v.predicted[row], p.mean[0], 1e-9) << i;
      EXPECT_NEAR(v.variance[row] / model.process_variance(), p.variance[0] / other.process_variance(), 1e-9);
    }
  }
}

// A site without which the others do not tell the trend has no error that is known; the others have theirs.
TEST(LeaveOneOut, OfTheOnlySiteThatTellsASlopeIsUnknown) {
  MatrixXd X(6, 1);
  X << 0, 0, 0, 1, 1, 1;
  VectorXd y(6);
  y << 1.0, 1.1, 0.9, 2.0, 2.2, 1.9;
  FitOptions options;
  options.trend = Trend::linear;
  const Validation v = leave_one_out(fit(X, y, options));
  for (Eigen::Index i = 0; i < 6; ++i) EXPECT_TRUE(std::isnan(v.predicted[i])) << v.predicted[i];
}

// White noise over 20 points with 4 runs each: a new point is missed by the noise and what the mean is off,
// √(1 + 1/80), and the mean of 80 squares scatters by √(2/80): 0.16, of which three are 0.24 of the error.
TEST(CrossValidation, RepeatsDoNotMakeNoiseAModel) {
  const MatrixXd points = reference::design(20, 2, 4);
  MatrixXd X(80, 2);
  VectorXd y(80);
  doe::RandomStream random(8);
  for (Eigen::Index i = 0; i < 80; ++i) {
    X.row(i) = points.row(i % 20);
    y[i] = random.normal();
  }
  EXPECT_NEAR(leave_one_out(fit(X, y)).rmse, 1.006, 0.24);
  for (const int folds : {5, 20}) EXPECT_NEAR(k_fold(X, y, folds, fitter).rmse, 1.006, 0.24) << folds;
  const Validation out = hold_out(X, y, 0.2, fitter);
  EXPECT_EQ(out.observed.size(), 16) << "four points with four runs each";
  EXPECT_THROW(k_fold(X, y, 21, fitter), std::invalid_argument) << "there are 20 points";
}

TEST(LeaveOneOut, OfAConstantModelIsTheConstant) {
  const Validation v = leave_one_out(fit(VectorXd::LinSpaced(5, 0, 1), VectorXd::Constant(5, 4.0)));
  EXPECT_EQ(v.predicted, VectorXd(VectorXd::Constant(5, 4.0)));
  EXPECT_EQ(v.rmse, 0.0);
}

// As many folds as runs leave out one each, so the refits of hyperparameters are the only difference to brute
// force.
TEST(KFold, PredictsEachRunByAModelThatHasNotSeenIt) {
  const MatrixXd X = reference::design(14, 2, 8);
  const VectorXd y = reference::values(wave, X);
  std::multiset<double> seen;
  const auto recording = [&](const MatrixXd& rest, const VectorXd& z) {
    for (const double value : z) seen.insert(value);
    return fit(rest, z, fixed(fit(X, y)));
  };
  const Validation v = k_fold(X, y, 14, recording);
  for (const double value : y) EXPECT_EQ(seen.count(value), 13u);
  EXPECT_EQ(v.observed, y);
  const Model third = fit(without(X, 3), without(y, 3), fixed(fit(X, y)));
  EXPECT_EQ(v.predicted[3], third.mean(X.row(3))[0]);
  EXPECT_EQ(k_fold(X, y, 5, fitter, {.seed = 2}).predicted, k_fold(X, y, 5, fitter, {.seed = 2}).predicted);
}

TEST(KFold, TellsAFitterWhoseRunsTheRowsAre) {
  const MatrixXd X = reference::design(14, 2, 8);
  const VectorXd y = reference::values(wave, X), noise = VectorXd::LinSpaced(14, 0.01, 0.05);
  int fits = 0;
  const auto with_noise = [&](const MatrixXd& P, const VectorXd& v, const std::vector<Eigen::Index>& rows) {
    ++fits;
    EXPECT_EQ(P, X(rows, Eigen::all));
    EXPECT_EQ(v, y(rows));
    return fit(P, v, {.noise = Noise::known, .noise_variance = noise(rows)});
  };
  EXPECT_LT(k_fold(X, y, 7, with_noise).nrmse, 1);
  EXPECT_EQ(fits, 7);
}

TEST(HoldOut, PredictsTheShareThatWasAskedFor) {
  const MatrixXd X = reference::design(20, 2, 8);
  const VectorXd y = reference::values(wave, X);
  Eigen::Index trained = 0;
  const Validation v = hold_out(X, y, 0.25, [&](const MatrixXd& rest, const VectorXd& z) {
    trained = rest.rows();
    return fit(rest, z);
  });
  EXPECT_EQ(trained, 15);
  EXPECT_EQ(v.observed.size(), 5);
  std::set<double> all(y.begin(), y.end());
  for (const double value : v.observed) EXPECT_TRUE(all.count(value));
}

TEST(Measure, IsMetOnTheRightSideOfItsTarget) {
  const MatrixXd X = reference::design(20, 2, 8);
  const VectorXd y = reference::values(wave, X);
  for (const Estimator estimator : {Estimator::leave_one_out, Estimator::k_fold, Estimator::hold_out}) {
    const Assessment error = assess({.estimator = estimator, .error = ErrorFunction::rmse}, X, y, fitter);
    EXPECT_EQ(error.value, score(error.validation, ErrorFunction::rmse));
    EXPECT_TRUE(
        assess({.estimator = estimator, .error = ErrorFunction::rmse, .target = error.value}, X, y, fitter)
            .met);
    EXPECT_FALSE(assess({.estimator = estimator, .error = ErrorFunction::rmse, .target = 0.99 * error.value},
                        X, y, fitter)
                     .met);
    EXPECT_TRUE(
        assess({.estimator = estimator, .error = ErrorFunction::q2, .target = 0.5}, X, y, fitter).met);
    EXPECT_FALSE(
        assess({.estimator = estimator, .error = ErrorFunction::q2, .target = 1.0}, X, y, fitter).met);
  }
}

TEST(CrossValidation, RejectsWhatItCannotShareOut) {
  const MatrixXd X = reference::design(6, 2, 8);
  const VectorXd y = reference::values(wave, X);
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message([&] { k_fold(X, y, 1, fitter); }),
            "kriging::k_fold: folds is 1; allowed is 2 to the 6 runs; use 5");
  EXPECT_EQ(message([&] { k_fold(X, y.head(5), 2, fitter); }),
            "kriging::k_fold: X has 6 rows but y has 5 entries; give one response a run");
  EXPECT_EQ(message([&] { hold_out(X, y, 1.0, fitter); }),
            "kriging::hold_out: share is 1 of 6 runs; allowed are numbers between 0 and 1 of 2 runs or more; "
            "use 0.2");
}
