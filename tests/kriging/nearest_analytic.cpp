// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Kriging by nearest runs against exact Kriging, where all runs are neighbours, and its derivatives.

#include <gtest/gtest.h>

#include <drawpoint/kriging/fit_nearest.hpp>
#include <drawpoint/tests/kriging/categories.hpp>
#include <drawpoint/tests/kriging/derivatives.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A likelihood away from its maximum, with λ = 0.02, which keeps the condition of R near 1e4.
struct LikelihoodCase {
  std::string name;
  LikelihoodProblem problem;
  VectorXd p;
};

LikelihoodProblem runs_of_noisy4(Eigen::Index n) {
  const reference::Data data = reference::training("noisy4", 100);
  LikelihoodProblem problem;
  problem.X = (2.0 * data.X.array() - 1.0).matrix().topRows(n);
  problem.y = reference::standardized(data.y).head(n);
  problem.F = MatrixXd::Ones(n, 1);
  return problem;
}

VectorXd parameters(std::initializer_list<double> logarithms) {
  VectorXd p(static_cast<Eigen::Index>(logarithms.size()));
  std::copy(logarithms.begin(), logarithms.end(), p.begin());
  p[p.size() - 1] = std::log(p[p.size() - 1]);
  return p;
}

std::vector<LikelihoodCase> likelihood_cases() {
  std::vector<LikelihoodCase> cases;
  const LikelihoodProblem plain = runs_of_noisy4(100);
  const VectorXd p = parameters({-1.2, -0.7, -2.0, -3.5, 0.02});
  cases.push_back({"gaussian", plain, p});
  LikelihoodProblem one = plain;
  one.prior = true;
  one.nugget_power = 0.5;
  cases.push_back({"with a prior", one, p});
  one = plain;
  one.family = Correlation::matern52;
  one.F.resize(100, 5);
  one.F << MatrixXd::Ones(100, 1), plain.X;
  cases.push_back({"matern52, linear trend", one, p});
  one = plain;
  one.family = Correlation::power_exponential;
  cases.push_back({"power_exponential", one, parameters({-1.2, -.7, -2., -3.5, 1.8, 1.5, 1.9, 1.6, .02})});
  one = plain;
  one.structure = Structure::isotropic;
  one.noise = VectorXd::LinSpaced(100, 0.5, 1.5);
  one.known_noise = 0.05;
  cases.push_back({"isotropic, known noise", one, parameters({-1.5, 0.02})});
  one = plain;
  one.levels = {0, 4, 0, 0};
  for (Eigen::Index i = 0; i < 100; ++i) one.X(i, 1) = static_cast<double>(i % 4);
  cases.push_back({"a category", one, p});
  return cases;
}

/// Options that fix all parameters, so that a fit estimates β and s² alone.
FitOptions fixed_options(VectorXd theta, double nugget) {
  FitOptions options;
  options.theta_lower = options.theta_upper = theta;
  options.nugget_lower = options.nugget_upper = nugget;
  options.parameter_uncertainty = false;
  return options;
}

constexpr NearestOptions all_runs{.neighbours = 4000, .neighbourhood = 4000};

}  // namespace

// 100 runs in blocks of seven to twelve, each with all runs of the blocks before as neighbours, and one block
// of all. LL is good to the condition times the precision times its size, 1e4 · 1e-16 · 1e2 = 1e-10, in both;
// the gradient's terms are of the size of LL.
TEST(Nearest, LikelihoodIsExactWhereAllEarlierRunsAreNeighbours) {
  for (const LikelihoodCase& c : likelihood_cases()) {
    Likelihood exact(c.problem);
    const double value = exact.value(c.p);
    const VectorXd gradient = exact.gradient(c.p);
    for (const int neighbours : {100, 800}) {
      detail::VecchiaLikelihood nearest(c.problem, neighbours, c.p);
      EXPECT_EQ(nearest.families().size() > 1, neighbours == 100);
      EXPECT_NEAR(nearest.value(c.p), value, 1e-8) << c.name;
      EXPECT_LT((nearest.gradient(c.p) - gradient).norm(), 1e-8 * gradient.norm()) << c.name;
      EXPECT_NEAR(nearest.beta()[0], exact.estimates().trend, 1e-8) << c.name;
    }
    detail::VecchiaLikelihood few(c.problem, 16, c.p);
    EXPECT_GT(std::abs(few.value(c.p) - value), 1e-3)
        << c.name << ": few neighbours are all, so nothing is tested";
  }
}

// The budget of difference quotients is that of likelihood_analytic.cpp: 1e-6 of the gradient.
TEST(Nearest, GradientIsTheDifferenceQuotient) {
  for (const LikelihoodCase& c : likelihood_cases()) {
    detail::VecchiaLikelihood likelihood(c.problem, 16, c.p);
    const VectorXd g = likelihood.gradient(c.p);
    ASSERT_GT(g.cwiseAbs().minCoeff(), 1e-3) << c.name << ": a derivative that vanishes tests nothing";
    for (Eigen::Index k = 0; k < c.p.size(); ++k) {
      const double expected =
          reference::derivative([&](const VectorXd& q) { return likelihood.value(q); }, c.p, k, 0.02);
      EXPECT_NEAR(g[k], expected, 1e-6 * g.norm()) << c.name << ", parameter " << k;
    }
  }
}

// Both solve with R of condition 1e4: relative differences of 1e-12 · the few hundred terms of a sum.
TEST(Nearest, ModelIsExactWhereAllRunsAreNeighbours) {
  const reference::Data data = reference::training("noisy4", 100);
  const MatrixXd points = reference::design(40, 4, 5);
  for (const Trend trend : {Trend::constant, Trend::quadratic}) {
    FitOptions options = fixed_options(Eigen::Vector4d(0.3, 0.5, 0.1, 0.03), 0.02);
    options.trend = trend;
    options.correlation = trend == Trend::constant ? Correlation::gaussian : Correlation::matern52;
    const Model exact = fit(data.X, data.y, options);
    const NearestModel nearest = fit_nearest(data.X, data.y, options, all_runs);
    const Prediction a = exact.predict(points), b = nearest.predict(points);
    const double range = data.y.maxCoeff() - data.y.minCoeff();
    EXPECT_LT((a.mean - b.mean).cwiseAbs().maxCoeff(), 1e-9 * range);
    EXPECT_LT((a.variance - b.variance).cwiseAbs().maxCoeff(), 1e-9 * exact.process_variance());
    EXPECT_EQ(nearest.mean(points), b.mean);
    EXPECT_NEAR(nearest.process_variance(), exact.process_variance(), 1e-9 * exact.process_variance());
    EXPECT_NEAR(nearest.log_likelihood(), exact.log_likelihood(), 1e-8);
    EXPECT_EQ(nearest.error().log_density, 0.0);
    EXPECT_EQ(nearest.error().mean, 0.0);
    const VectorXd x = points.row(0), slope = exact.mean_gradient(x);
    EXPECT_LT((nearest.mean_gradient(x) - slope).norm(), 1e-8 * slope.norm());
    const Prediction run = nearest.predict(points, Target::observation);
    EXPECT_LT((run.variance - b.variance).array().abs().maxCoeff(), (1 + 1e-9) * nearest.noise_variance());
    EXPECT_GT((run.variance - b.variance).minCoeff(), (1 - 1e-9) * nearest.noise_variance());
  }
}

TEST(Nearest, KnownNoiseAndCategoriesAreThoseOfTheExactModel) {
  const MatrixXd X = categories::points(90, 4, 3);
  VectorXd y(90);
  for (Eigen::Index i = 0; i < 90; ++i)
    y[i] = categories::scrambled(X(i, 0), X(i, 1), static_cast<int>(X(i, 2)));
  FitOptions options = fixed_options(Eigen::Vector3d(0.8, 0.2, 0.1), 0.01);
  options.levels = {0, 0, 4};
  options.noise = Noise::known;
  options.noise_variance = VectorXd::LinSpaced(90, 0.0, 0.02);
  const Model exact = fit(X, y, options);
  const NearestModel nearest = fit_nearest(X, y, options, all_runs);
  const MatrixXd points = categories::points(30, 4, 8);
  EXPECT_LT((exact.mean(points) - nearest.mean(points)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((exact.predict(points).variance - nearest.predict(points).variance).cwiseAbs().maxCoeff(),
            1e-9 * exact.process_variance());
}

// The mean is infinitely smooth within a cell, so Richardson's differences are good to 1e-7 there.
TEST(Nearest, MeanGradientIsTheDifferenceQuotient) {
  const MatrixXd X = reference::design(300, 4, 2);
  const VectorXd y = reference::values(reference::branin4, X);
  FitOptions options = fixed_options(Eigen::Vector4d(0.3, 0.5, 0.1, 0.03), 1e-4);
  options.trend = Trend::linear;
  const NearestModel model = fit_nearest(X, y, options, {.neighbours = 40, .neighbourhood = 40});
  for (Eigen::Index i = 0; i < 5; ++i) {
    const VectorXd x = reference::design(5, 4, 9).row(i), g = model.mean_gradient(x);
    for (Eigen::Index k = 0; k < 4; ++k)
      EXPECT_NEAR(g[k], reference::derivative(model, x, k, 1e-3), 1e-6 * g.norm());
  }
}
