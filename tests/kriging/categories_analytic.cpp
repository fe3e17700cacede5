// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/categories.hpp>
#include <drawpoint/tests/kriging/correlations.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// X: two numbers on [-1, 1] and the index of one of four levels; p: ln θ, exponents, ln λ.
struct Reference {
  Correlation family;
  MatrixXd X;
  VectorXd y;

  double correlation(const VectorXd& p, const VectorXd& a, const VectorXd& b) const {
    double product = 1;
    for (int k = 0; k < 3; ++k) {
      const double distance = k == 2 ? (a[k] == b[k] ? 0.0 : 2.0) : std::abs(a[k] - b[k]);
      const double exponent = family == Correlation::power_exponential ? p[3 + k] : 2.0;
      product *= reference::one_correlation(family, std::exp(p[k]), exponent, distance);
    }
    return product;
  }
  MatrixXd matrix(const VectorXd& p) const {
    MatrixXd R(X.rows(), X.rows());
    for (Eigen::Index i = 0; i < R.rows(); ++i)
      for (Eigen::Index j = 0; j < R.cols(); ++j)
        R(i, j) = correlation(p, X.row(i), X.row(j)) + (i == j ? std::exp(p[p.size() - 1]) : 0.0);
    return R;
  }
  double log_likelihood(const VectorXd& p) const {
    const MatrixXd R = matrix(p), inverse = R.inverse();
    const double n = static_cast<double>(X.rows()), beta = inverse.colwise().sum().dot(y) / inverse.sum();
    const VectorXd r = y.array() - beta;
    const double s2 = r.dot(inverse * r) / n;
    return -0.5 * n * std::log(2 * 3.14159265358979323846 * s2) - 0.5 * std::log(R.determinant()) - 0.5 * n;
  }
};

Reference some_runs(Correlation family) {
  Reference r{family, MatrixXd(14, 3), VectorXd(14)};
  doe::RandomStream random(3);
  for (Eigen::Index i = 0; i < 14; ++i) {
    r.X.row(i) << 2 * random.uniform() - 1, 2 * random.uniform() - 1, static_cast<double>(i % 4);
    r.y[i] = random.normal();
  }
  return r;
}

Likelihood likelihood_of(const Reference& r) {
  LikelihoodProblem problem;
  problem.X = r.X;
  problem.y = r.y;
  problem.family = r.family;
  problem.levels = {0, 0, 4};
  return Likelihood(problem);
}

VectorXd somewhere(Correlation family) {
  VectorXd p(family == Correlation::power_exponential ? 7 : 4);
  p.head(3) << 0.3, -0.4, -1.6;
  if (p.size() == 7) p.segment(3, 3) << 1.7, 1.9, 1.4;
  p[p.size() - 1] = std::log(0.05);
  return p;
}

}  // namespace

// λ = 0.05 keeps R's condition below n/λ = 280, so both agree to some 1e-13 of LL, which is about 20.
TEST(Categories, LikelihoodIsThatOfADenseReference) {
  for (const Correlation family : reference::families) {
    const Reference r = some_runs(family);
    const VectorXd p = somewhere(family);
    EXPECT_NEAR(likelihood_of(r).value(p), r.log_likelihood(p), 1e-10) << to_string(family);
  }
}

// Central differences with h = 1e-4: truncation h² f''' / 6 is some 1e-8, round-off 1e-13/h = 1e-9 of a
// first and 1e-13/h² = 1e-5 of a second derivative; Hessians are therefore differences of the gradient.
TEST(Categories, DerivativesAreDifferencesOfTheReference) {
  constexpr double h = 1e-4;
  for (const Correlation family : reference::families) {
    const Reference r = some_runs(family);
    const VectorXd p = somewhere(family);
    Likelihood likelihood = likelihood_of(r);
    const VectorXd g = likelihood.gradient(p);
    const MatrixXd H = likelihood.hessian(p);
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      VectorXd up = p, down = p;
      up[k] += h;
      down[k] -= h;
      EXPECT_NEAR(g[k], (r.log_likelihood(up) - r.log_likelihood(down)) / (2 * h), 1e-6) << to_string(family);
      const VectorXd change = (likelihood.gradient(up) - likelihood.gradient(down)) / (2 * h);
      EXPECT_LT((H.col(k) - change).cwiseAbs().maxCoeff(), 1e-6) << to_string(family) << " " << k;
    }
  }
}

// ½ tr(R⁻¹Rₐ R⁻¹R_b) − tr(R⁻¹Rₐ) tr(R⁻¹R_b)/(2n), with Rₐ by central differences, good to 1e-8.
TEST(Categories, InformationIsThatOfADenseReference) {
  constexpr double h = 1e-4;
  for (const Correlation family : reference::families) {
    const Reference r = some_runs(family);
    const VectorXd p = somewhere(family);
    std::vector<MatrixXd> slopes;
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      VectorXd up = p, down = p;
      up[k] += h;
      down[k] -= h;
      slopes.push_back(r.matrix(p).inverse() * (r.matrix(up) - r.matrix(down)) / (2 * h));
    }
    const MatrixXd F = likelihood_of(r).fisher(p);
    for (Eigen::Index a = 0; a < p.size(); ++a)
      for (Eigen::Index b = 0; b < p.size(); ++b) {
        const MatrixXd &A = slopes[static_cast<std::size_t>(a)], &B = slopes[static_cast<std::size_t>(b)];
        EXPECT_NEAR(F(a, b), 0.5 * (A * B).trace() - A.trace() * B.trace() / 28.0, 1e-6) << to_string(family);
      }
  }
}

// Mean, variance and covariance at fixed parameters by their equations, with R inverted. θ of a fit are of
// inputs on [-1, 1], so the box is that.
TEST(Categories, PredictionsAreThoseOfADenseReference) {
  for (const Correlation family : reference::families) {
    const Reference r = some_runs(family);
    FitOptions options = categories::box_options();
    options.correlation = family;
    options.parameter_uncertainty = false;
    options.may_be_exact = false;  // by one explanation of the runs
    const Model model = fit(r.X, r.y, options);
    VectorXd p(family == Correlation::power_exponential ? 7 : 4);
    p.head(3) = model.theta().array().log();
    if (p.size() == 7) p.segment(3, 3) = model.correlation().exponent;
    p[p.size() - 1] = std::log(model.nugget());
    MatrixXd Z(4, 3), c(14, 4), prior(4, 4);
    Z << 0.1, -0.3, 0, 0.1, -0.3, 1, 0.1, -0.3, 2, -0.9, 0.7, 3;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 14; ++i) c(i, j) = r.correlation(p, r.X.row(i), Z.row(j));
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) prior(i, j) = r.correlation(p, Z.row(i), Z.row(j));
    const MatrixXd K = r.matrix(p).inverse();
    const VectorXd ones = VectorXd::Ones(14), u = VectorXd::Ones(4) - c.transpose() * K * ones;
    const double beta = ones.dot(K * r.y) / K.sum();
    const VectorXd residual = r.y.array() - beta, mean = (c.transpose() * K * residual).array() + beta;
    const double s2 = residual.dot(K * residual) / 14.0;
    const MatrixXd covariance = s2 * (prior - c.transpose() * K * c + u * u.transpose() / K.sum());
    const Prediction predicted = model.predict(Z);
    // λ of the fit is above 1e-6 here: the condition is below 14/1e-6, which leaves nine digits.
    ASSERT_GT(model.nugget(), 1e-6);
    EXPECT_LT((predicted.mean - mean).cwiseAbs().maxCoeff(), 1e-8) << to_string(family);
    EXPECT_LT((predicted.variance - covariance.diagonal()).cwiseAbs().maxCoeff(), 1e-8) << to_string(family);
    EXPECT_LT((model.covariance(Z) - covariance).cwiseAbs().maxCoeff(), 1e-8) << to_string(family);
    EXPECT_NEAR(model.log_likelihood(), r.log_likelihood(p), 1e-7) << to_string(family);
  }
}

// Two levels are the ends of the range of a number: the same model, with the same θ. Arithmetic differs by
// round-off, and the searches end where they gain less than 1e-6, so the likelihoods agree to that.
TEST(Categories, TwoLevelsAreTheEndsOfANumber) {
  const auto [X, y] = categories::two_level_runs();
  for (const Correlation family : {Correlation::gaussian, Correlation::matern32, Correlation::matern52}) {
    FitOptions numbers = categories::unit_options(3), levels = numbers;
    numbers.correlation = levels.correlation = family;
    levels.levels = {0, 0, 2};
    const Model a = fit(X, y, numbers), b = fit(X, y, levels);
    EXPECT_NEAR(a.log_likelihood(), b.log_likelihood(), 1e-5) << to_string(family);
    EXPECT_LT((a.theta().array().log() - b.theta().array().log()).abs().maxCoeff(), 1e-2);
    const MatrixXd Z = X.topRows(6).array() * 0.9 + 0.05;
    MatrixXd at = Z;
    at.col(2) = X.col(2).head(6);
    const Prediction p = a.predict(at), q = b.predict(at);
    EXPECT_LT((p.mean - q.mean).cwiseAbs().maxCoeff(), 1e-3 * std::sqrt(p.variance.minCoeff()));
    EXPECT_LT(((p.variance - q.variance).array() / p.variance.array()).abs().maxCoeff(), 1e-3);
  }
}

// Names of levels mean nothing: not one bit changes when they are dealt anew.
TEST(Categories, NamesOfLevelsMeanNothing) {
  const auto [X, y] = categories::runs(categories::scrambled, 32, 5);
  for (const Correlation family : reference::families) {
    FitOptions options = categories::unit_options(3);
    options.levels = {0, 0, 4};
    options.correlation = family;
    options.trend = Trend::linear;
    const Model a = fit(X, y, options), b = fit(categories::renamed(X), y, options);
    const MatrixXd Z = categories::points(40, 4, 8);
    const Prediction p = a.predict(Z), q = b.predict(categories::renamed(Z));
    EXPECT_EQ(p.mean, q.mean) << to_string(family);
    EXPECT_EQ(p.variance, q.variance) << to_string(family);
    EXPECT_EQ(a.theta(), b.theta()) << to_string(family);
  }
}
