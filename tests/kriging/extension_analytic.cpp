// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// What is done with a fitted model: derivatives, joint covariance, paths, more runs, re-interpolation.

#include <gtest/gtest.h>

#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/reinterpolation.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double wave(const VectorXd& x) { return std::sin(5 * x[0]) + x[1] * x[1]; }

struct Kind {
  Correlation correlation;
  Trend trend;
  bool weighted;
};

constexpr Kind kinds[] = {{Correlation::gaussian, Trend::constant, false},
                          {Correlation::gaussian, Trend::quadratic, true},
                          {Correlation::matern32, Trend::linear, false},
                          {Correlation::matern52, Trend::constant, true},
                          {Correlation::power_exponential, Trend::linear, false}};

// Runs of the kind with λ = 1e-2, so that the condition stays below 1e5.
Model model_of(const Kind& kind, const MatrixXd& X, const VectorXd& y, const VectorXd& noise) {
  FitOptions options;
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  options.theta_lower = options.theta_upper = 1.3;
  options.nugget_lower = options.nugget_upper = 1e-2;
  options.correlation = kind.correlation;
  options.trend = kind.trend;
  if (kind.correlation == Correlation::power_exponential) options.exponent = Eigen::Vector2d(1.9, 1.6);
  if (kind.weighted) {
    options.noise = Noise::proportional;
    options.noise_variance = noise;
  }
  return fit(X, y, options);
}

Model model_of(const Kind& kind) {
  const MatrixXd X = reference::design(25, 2, 3);
  return model_of(kind, X, reference::values(wave, X), VectorXd::LinSpaced(25, 0.5, 1.5));
}

}  // namespace

// Richardson's extrapolation with h = 1e-3 between runs (no run closer than 4h, asserted, where the power
// exponential's derivatives of order five grow as h^(p − 5)): h⁴ f⁽⁵⁾/480, f⁽⁵⁾ below 5⁵·10 for what varies
// over a fifth of the box, is 6e-11; round-off 1e-16·1e5/h = 1e-8. Near a run p = 1.6 gives f⁽⁵⁾ up to
// (4h)^(−3.4) = 2e8, so 4e-7.
TEST(Gradient, IsTheDifferenceQuotientOfThePrediction) {
  for (const Kind& kind : kinds) {
    const Model model = model_of(kind);
    const MatrixXd runs = reference::design(25, 2, 3), Z = reference::design(15, 2, 12);
    for (Eigen::Index i = 0; i < Z.rows(); ++i) {
      const VectorXd x = Z.row(i);
      if ((runs.rowwise() - x.transpose()).cwiseAbs().minCoeff() < 4e-3) continue;
      const PredictionGradient g = model.gradient(x);
      EXPECT_EQ(model.mean_gradient(x), g.mean);
      for (Eigen::Index k = 0; k < 2; ++k) {
        const auto quotient = [&](double h) -> Eigen::Vector2d {
          MatrixXd pair(2, 2);
          pair << x.transpose(), x.transpose();
          pair(0, k) += h;
          pair(1, k) -= h;
          const Prediction p = model.predict(pair);
          return Eigen::Vector2d(p.mean[0] - p.mean[1], p.variance[0] - p.variance[1]) / (2 * h);
        };
        const Eigen::Vector2d expected = (4 * quotient(5e-4) - quotient(1e-3)) / 3;
        EXPECT_NEAR(g.mean[k], expected[0], 1e-6) << to_string(kind.correlation);
        EXPECT_NEAR(g.variance[k], expected[1], 1e-6) << to_string(kind.correlation);
      }
    }
  }
}

// The diagonal is the variance, and conditioning a covariance on one more run is one step of elimination:
// from the covariance of (z, x) the variance at z after a run at x follows in closed form.
TEST(Covariance, HasTheVariancesAndConditionsAsARunDoes) {
  for (const Kind& kind : kinds) {
    const Model model = model_of(kind);
    const MatrixXd Z = reference::design(6, 2, 12);
    const MatrixXd C = model.covariance(Z);
    EXPECT_EQ(C, MatrixXd(C.transpose()));
    EXPECT_LT((C.diagonal() - model.predict(Z).variance).cwiseAbs().maxCoeff(),
              1e-10 * model.process_variance());
    const double noise = 0.7;  // of the new run, in the unit of the weights, whose mean is 1
    const Model more = append(model, Z.topRows(1), VectorXd::Ones(1),
                              kind.weighted ? VectorXd::Constant(1, noise) : VectorXd());
    const double s2 = model.process_variance(),
                 added = kind.weighted ? noise * 1e-2 * s2 + 1e-10 * s2 : 1e-2 * s2;
    const VectorXd expected = C.diagonal() - C.col(0).array().square().matrix() / (C(0, 0) + added);
    // s² is found anew with the run; as a share of s² the variances are those of elimination.
    const VectorXd found = more.predict(Z).variance * (s2 / more.process_variance());
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-9 * s2) << to_string(kind.correlation);
  }
}

// 4000 draws at three points, one of them a run of a nearly interpolating model. The sample covariance of N
// draws has the standard error √((CᵢᵢCⱼⱼ + Cᵢⱼ²)/N); 5 of them are passed by chance once in a million for
// each of nine entries.
TEST(SamplePaths, HaveTheMeanAndTheCovariance) {
  const Model model = model_of(kinds[0]);
  const MatrixXd Z = reference::design(3, 2, 12);
  const int N = 4000;
  const MatrixXd paths = sample_paths(model, Z, N, {.seed = 9});
  const MatrixXd C = model.covariance(Z);
  const MatrixXd deviations = paths.colwise() - model.mean(Z);
  const MatrixXd found = deviations * deviations.transpose() / N;
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(deviations.row(i).mean(), 0.0, 5 * std::sqrt(C(i, i) / N));
    for (Eigen::Index j = 0; j < 3; ++j)
      EXPECT_NEAR(found(i, j), C(i, j), 5 * std::sqrt((C(i, i) * C(j, j) + C(i, j) * C(i, j)) / N));
  }
  EXPECT_EQ(paths, sample_paths(model, Z, N, {.seed = 9}));
  EXPECT_THROW(sample_paths(model, Z, 0), std::invalid_argument);
}

// At the runs of an interpolating model the covariance is singular and the paths pass through the runs: λ =
// 1e-8.
TEST(SamplePaths, PassThroughTheRunsOfAnInterpolatingModel) {
  const MatrixXd X = reference::design(12, 2, 3);
  const VectorXd y = reference::values(wave, X);
  FitOptions options;
  options.nugget_lower = options.nugget_upper = 1e-8;
  options.theta_lower = options.theta_upper = 2.0;
  const Model model = fit(X, y, options);
  const MatrixXd paths = sample_paths(model, X, 20);
  // Six deviations of √(λ s²) and what the mean misses.
  const double bound =
      6 * std::sqrt(1e-8 * model.process_variance()) + (model.mean(X) - y).cwiseAbs().maxCoeff();
  EXPECT_LT((paths.colwise() - y).cwiseAbs().maxCoeff(), bound + 1e-7);
}

// The same runs in one fit: equal but for round-off times the condition, below 1e5. 40 runs cross two block
// sizes.
TEST(Append, EqualsTheFullFactor) {
  const MatrixXd X = reference::design(65, 2, 3), Z = reference::design(10, 2, 12);
  const VectorXd y = reference::values(wave, X), noise = VectorXd::LinSpaced(65, 0.5, 1.5);
  for (const Kind& kind : kinds) {
    // The same units: the first model's scale of y and mean noise differ from the last's, so its λ is
    // converted.
    const Model few = model_of(kind, X.topRows(25), y.head(25), noise.head(25));
    const Model all =
        append(few, X.bottomRows(40), y.tail(40), kind.weighted ? VectorXd(noise.tail(40)) : VectorXd());
    detail::ModelState s = all.state();
    MatrixXd R;
    fill_correlation(s.X, s.correlation, R);
    R.diagonal() += detail::added_noise(s);
    ASSERT_TRUE(detail::factor(detail::block_of(R), 1));
    const MatrixXd L = R.triangularView<Eigen::Lower>();
    EXPECT_LT((s.L - L).cwiseAbs().maxCoeff(), 1e-11);
    s.L = L;
    detail::estimate(s);
    const Model full(s);
    EXPECT_LT((full.mean(Z) - all.mean(Z)).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LT((full.predict(Z).variance - all.predict(Z).variance).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_NEAR(full.log_likelihood(), all.log_likelihood(), 1e-9);
    EXPECT_EQ(all.runs(), 65);
    EXPECT_NE(all.message().find("40 runs appended without a new fit"), std::string::npos);
  }
}

TEST(Append, TakesARunThatRepeatsAnotherAndSaysSo) {
  const MatrixXd X = reference::design(12, 2, 3);
  FitOptions options;
  options.nugget_lower = options.nugget_upper = 1e-18;
  options.theta_lower = options.theta_upper = 40.0;
  const Model model = fit(X, reference::values(wave, X), options);
  const Model more = append(model, X.topRows(1), VectorXd::Zero(1));
  EXPECT_EQ(more.status(), Status::ill_conditioned);
  EXPECT_NE(more.message().find("added to their nugget because they repeat other runs"), std::string::npos);
  EXPECT_TRUE(more.predict(X).mean.allFinite());
}

TEST(Append, RefusesOtherSizes) {
  const Model model = model_of(kinds[0]);
  try {
    append(model, MatrixXd::Zero(2, 2), VectorXd::Zero(3));
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()),
              "kriging::append: X has 2 rows but y has 3 entries; give one response a run");
  }
  EXPECT_THROW(append(model, MatrixXd::Zero(1, 2), VectorXd::Zero(1), VectorXd::Ones(1)),
               std::invalid_argument);
  EXPECT_THROW(
      append(fit(MatrixXd::Identity(2, 2), VectorXd::Ones(2)), MatrixXd::Zero(1, 2), VectorXd::Zero(1)),
      std::invalid_argument);
}

// Forrester, Keane, Bressloff 2006: the mean stays, the variance vanishes at the runs, and s²_ri is that of
// Kriging through the regression's predictions. C of these runs has its smallest eigenvalue above 1e-9 (θ =
// 20), so what is added to it, 4n ε = 2e-14, changes nothing of note: the mean from C⁻¹ agrees within
// 1e-16/1e-9·1e2 = 1e-5.
TEST(Reinterpolation, KeepsTheMeanAndVanishesAtTheRuns) {
  const MatrixXd X = reference::design(25, 2, 3), Z = reference::design(20, 2, 12);
  VectorXd y = reference::values(wave, X);
  doe::RandomStream random(5);
  for (double& value : y) value += 0.2 * random.normal();
  FitOptions options;
  options.theta_lower = options.theta_upper = 20.0;
  options.nugget_lower = options.nugget_upper = 0.1;
  const Model regression = fit(X, y, options);
  const Model through = reinterpolated(regression);
  EXPECT_EQ(through.mean(Z), regression.mean(Z));
  EXPECT_LT(through.predict(X).variance.maxCoeff(), 1e-12 * through.process_variance());
  EXPECT_GT(regression.predict(X).variance.minCoeff(), 1e-3 * regression.process_variance());
  options.nugget_lower = options.nugget_upper = 1e-13;
  const Model again = fit(X, regression.mean(X), options);
  EXPECT_LT((again.mean(Z) - through.mean(Z)).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_NEAR(again.process_variance() / through.process_variance(), 1.0, 1e-5);
  EXPECT_LT((again.predict(Z).variance - through.predict(Z).variance).cwiseAbs().maxCoeff(),
            1e-5 * through.process_variance());
}

// With λ = 1e-10 the regression is the interpolation but for λ over the smallest eigenvalue.
TEST(Reinterpolation, IsTheModelItselfWithoutNoise) {
  const MatrixXd X = reference::design(25, 2, 3), Z = reference::design(20, 2, 12);
  FitOptions options;
  options.theta_lower = options.theta_upper = 20.0;
  options.nugget_lower = options.nugget_upper = 1e-12;
  const Model model = fit(X, reference::values(wave, X), options);
  const Model through = reinterpolated(model);
  EXPECT_NEAR(through.process_variance() / model.process_variance(), 1.0, 1e-3);
  EXPECT_LT((through.predict(Z).variance - model.predict(Z).variance).cwiseAbs().maxCoeff(),
            1e-3 * model.process_variance());
}

// Differences of such inputs have no square: the correlation would be no number, and its factor would never
// come.
TEST(Append, RefusesMagnitudesWithoutASquare) {
  const MatrixXd X = reference::design(12, 2, 3);
  const Model model = fit(X, X.col(0).array().sin().matrix());
  for (const double far : {1e308, -1e151}) {
    EXPECT_THROW(append(model, MatrixXd::Constant(1, 2, far), VectorXd::Zero(1)), std::invalid_argument);
    EXPECT_THROW(append(model, MatrixXd::Zero(1, 2), VectorXd::Constant(1, far)), std::invalid_argument);
  }
  EXPECT_EQ(append(model, MatrixXd::Constant(1, 2, 1e150), VectorXd::Zero(1)).runs(), 13);
}
