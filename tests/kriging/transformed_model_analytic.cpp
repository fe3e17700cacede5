// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/acquisition_hypervolume.hpp>
#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <limits>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr ResponseRange positive{0, std::numeric_limits<double>::infinity()};

struct Runs {
  MatrixXd X;
  VectorXd z;  // normal noise of deviation 0.3 about 1 + sin 3x₀ + x₁
};

Runs runs(Eigen::Index n, doe::Seed seed) {
  doe::RandomStream random(seed);
  Runs r{MatrixXd(n, 2), VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    r.X(i, 0) = random.uniform();
    r.X(i, 1) = random.uniform();
    r.z[i] = 1 + std::sin(3 * r.X(i, 0)) + r.X(i, 1) + 0.3 * random.normal();
  }
  return r;
}

VectorXd exponentials(VectorXd z) {
  for (double& entry : z) entry = std::exp(entry);
  return z;
}

const MatrixXd points = (MatrixXd(3, 2) << 0.2, 0.3, 0.5, 0.9, 1.0, 0.0).finished();

}  // namespace

TEST(TransformedModel, OnTheLinearScaleIsTheModel) {
  const Runs r = runs(30, 1);
  const Model plain = fit(r.X, r.z);
  const TransformedModel same = fit_transformed(r.X, r.z, Scale::linear, {});
  EXPECT_EQ(same.mean(points), plain.mean(points));
  EXPECT_EQ(same.predict(points, Target::observation).variance,
            plain.predict(points, Target::observation).variance);
  EXPECT_EQ(leave_one_out(same).predicted, leave_one_out(plain).predicted);
  EXPECT_EQ(fitted_values(same), fitted_values(plain));
}

// The fit to ln y is a fit to z = ln y: all that is predicted follows from the model of z. 1e-9 is the
// quadrature's part of the mean (transform_analytic.cpp).
TEST(TransformedModel, OfALogarithmHasLognormalPredictions) {
  const Runs r = runs(40, 2);
  const Model z = fit(r.X, r.z);
  const TransformedModel y = fit_transformed(r.X, exponentials(r.z), Scale::logarithm, positive);
  const Prediction of_z = z.predict(points), run_z = z.predict(points, Target::observation);
  const VectorXd mean = y.mean(points), high = y.quantile(points, 0.975),
                 high_run = y.quantile(points, 0.975, Target::observation);
  const double noise = z.noise_variance(), t = 1.959963984540054;
  EXPECT_GT(noise, 0.03);
  for (Eigen::Index i = 0; i < 3; ++i) {
    // ln of exp returns z to an ulp or two, which moves the fit by far less than 1e-8.
    EXPECT_NEAR(mean[i] / std::exp(of_z.mean[i] + noise / 2), 1, 1e-8);
    EXPECT_NEAR(high[i] / std::exp(of_z.mean[i] + t * std::sqrt(of_z.variance[i]) + noise / 2), 1, 1e-8);
    EXPECT_NEAR(high_run[i] / std::exp(run_z.mean[i] + t * std::sqrt(run_z.variance[i])), 1, 1e-8);
    const double s = std::sqrt(run_z.variance[i]);
    EXPECT_NEAR(std::sqrt(y.predict(points, Target::observation).variance[i]) /
                    (std::exp(run_z.mean[i]) * std::sinh(s)),
                1, 1e-8);
  }
}

// Central differences of step 1e-5: 1e-10 of the third derivative, some 100 here, and 1e-11 of round-off.
TEST(TransformedModel, HasTheGradientOfItsMean) {
  const Runs r = runs(40, 3);
  const double h = 1e-5;
  for (const Scale scale : {Scale::square_root, Scale::logarithm, Scale::logit}) {
    const TransformedModel y = fit_transformed(r.X, exponentials(r.z), scale, {0, 100});
    const VectorXd x = points.row(1).transpose(), gradient = y.mean_gradient(x);
    for (Eigen::Index k = 0; k < 2; ++k) {
      VectorXd up = x, down = x;
      up[k] += h;
      down[k] -= h;
      EXPECT_NEAR(gradient[k], (y(up) - y(down)) / (2 * h), 1e-6) << to_string(scale);
    }
  }
}

// Leaving a run out is done on the scale of z, in closed form there; what comes of it is what a model
// predicts.
TEST(TransformedModel, LeavesRunsOutOnItsScale) {
  const Runs r = runs(25, 4);
  const TransformedModel y = fit_transformed(r.X, exponentials(r.z), Scale::logarithm, positive);
  const Validation v = leave_one_out(y), of_z = leave_one_out(y.model());
  EXPECT_EQ(v.observed, y.observed());
  EXPECT_EQ(v.scaled_mean, of_z.predicted);
  EXPECT_EQ(v.scaled_variance, of_z.observation_variance);
  for (Eigen::Index i = 0; i < v.observed.size(); ++i)
    EXPECT_NEAR(v.predicted[i] / std::exp(of_z.predicted[i] + y.noise_variance() / 2), 1, 1e-9);
  // A monotone scale keeps what lies within an interval.
  EXPECT_EQ(score(v, ErrorFunction::coverage), score(of_z, ErrorFunction::coverage));
}

TEST(TransformedModel, IsValidatedByItsQuantiles) {
  const Runs r = runs(40, 5), fresh = runs(200, 6);
  const TransformedModel y = fit_transformed(r.X, exponentials(r.z), Scale::logarithm, positive);
  const Validation v = validate(y, fresh.X, exponentials(fresh.z));
  const VectorXd low = y.quantile(fresh.X, 0.025, Target::observation),
                 high = y.quantile(fresh.X, 0.975, Target::observation);
  int within = 0;
  for (Eigen::Index i = 0; i < 200; ++i) within += v.observed[i] >= low[i] && v.observed[i] <= high[i];
  EXPECT_DOUBLE_EQ(score(v, ErrorFunction::coverage), within / 200.0);
}

// A search re-interpolates: the mean stays, and no variance is left at the runs.
TEST(TransformedModel, IsReinterpolatedInSearches) {
  const Runs r = runs(30, 7);
  for (const Scale scale : {Scale::linear, Scale::square_root, Scale::logarithm, Scale::logit}) {
    const TransformedModel sure = reinterpolated(fit_transformed(r.X, exponentials(r.z), scale, {0, 100}));
    EXPECT_EQ(sure.predict(r.X).variance, VectorXd::Zero(30)) << to_string(scale);
    EXPECT_EQ(sure.quantile(r.X, 0.9), sure.quantile(r.X, 0.1)) << to_string(scale);
  }
  const TransformedModel y = fit_transformed(r.X, exponentials(r.z), Scale::logarithm, positive);
  const TransformedModel sure = reinterpolated(y);
  EXPECT_EQ(sure.mean(points), y.mean(points)) << "the weights stay";
  EXPECT_EQ(sure.predict(r.X).variance, VectorXd::Zero(30));
  EXPECT_EQ(detail::SearchModel<AnySurrogate>(AnySurrogate(y)).predict(r.X).variance, VectorXd::Zero(30));
  doe::Problem problem;
  problem.variables = {{.name = "a", .unit = "m", .lower = 0, .upper = 1},
                       {.name = "b", .unit = "m", .lower = 0, .upper = 1}};
  problem.responses = {{.name = "y", .unit = "t", .goal = doe::Goal::minimize}};
  const VectorXd score = constrained_hypervolume_improvement(problem, std::vector{y})(r.X);
  // The mean of a run is a sum of 30 terms below 1e3, so it repeats to 30 · 1e3 · 1e-16.
  EXPECT_GE(score.minCoeff(), 0.0);
  EXPECT_LT(score.maxCoeff(), 3e-12) << "nothing is won where all is known";
}

// Multiplicative noise of 0.6 about a response that varies by a factor of 50, and noise of 0.3 added to one
// that varies by a factor of 2. Each is the truth of one scale: of ten designs chance may misjudge two, a
// rule without sense does seven.
TEST(ChooseScale, FindsTheScaleOfTheNoise) {
  int logarithms = 0, linears = 0;
  for (doe::Seed seed = 1; seed <= 10; ++seed) {
    Runs r = runs(60, seed);
    logarithms += choose_scale(r.X, exponentials(2.0 * r.z), positive).scale() == Scale::logarithm;
    const FitChoice additive = choose_scale(r.X, r.z.array() + 1.0, positive);
    linears += additive.scale() == Scale::linear;
    EXPECT_EQ(additive.table.size(), 3u) << "logit needs an upper bound";
  }
  EXPECT_GE(logarithms, 8);
  EXPECT_GE(linears, 8);
}

TEST(ChooseScale, WithoutARangeIsLinear) {
  const Runs r = runs(20, 1);
  const FitChoice choice = choose_scale(r.X, exponentials(r.z), {});
  EXPECT_EQ(choice.table.size(), 1u);
  EXPECT_EQ(choice.scale(), Scale::linear);
}

// A prediction of one run has no width: its median is the run, the rest is unknown.
TEST(TransformedModel, OfOneRunHasAMedian) {
  const TransformedModel one =
      fit_transformed(MatrixXd::Constant(1, 2, 0.5), VectorXd::Constant(1, 3.0), Scale::linear, {});
  EXPECT_EQ(one.quantile(points, 0.5), VectorXd::Constant(3, 3.0));
  EXPECT_TRUE(std::isinf(one.quantile(points, 0.975)[0]));
}

TEST(ChooseScale, TakesOneRunAndEqualOnes) {
  const MatrixXd one = MatrixXd::Constant(1, 2, 0.5);
  EXPECT_EQ(choose_scale(one, VectorXd::Constant(1, 3.0), positive).scale(), Scale::linear);
  const Runs r = runs(8, 1);
  const FitChoice zeros = choose_scale(r.X, VectorXd::Zero(8), positive);
  EXPECT_EQ(zeros.scale(), Scale::linear);
  EXPECT_EQ(zeros.model.mean(points), VectorXd::Zero(3));
}
