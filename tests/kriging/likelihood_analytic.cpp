// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <drawpoint/kriging/detail/likelihood.hpp>
#include <drawpoint/tests/kriging/derivatives.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd scaled(const MatrixXd& X) { return 2.0 * X.array() - 1.0; }

// More runs than one block of the inverse, so that its joints are tested too.
Likelihood noisy_likelihood() {
  const reference::Data data = reference::training("noisy4", 100);
  return {scaled(data.X), reference::standardized(data.y)};
}

// Away from the maximum, so that no derivative vanishes; λ = 0.02 keeps the condition near 1e4.
VectorXd somewhere() {
  VectorXd p(5);
  p << -1.2, -0.7, -2.0, -3.5, std::log(0.02);
  return p;
}

// With h = 0.02 the truncation error h⁴ f⁽⁵⁾/480 is about 3e-10·f⁽⁵⁾. One derivative by a logarithm
// multiplies the terms of LL by at most about 4 here, so f⁽⁵⁾ is below 4⁴ f' and the error below 1e-7 f'.
// Round-off: LL is good to the condition times the precision, 1e4·1e-16 of 1e2, and 1e-10/h is smaller still.
constexpr double step = 0.02, tolerance = 1e-6;

}  // namespace

TEST(Likelihood, GradientIsTheDifferenceQuotient) {
  Likelihood likelihood = noisy_likelihood();
  const VectorXd p = somewhere(), g = likelihood.gradient(p);
  ASSERT_GT(g.cwiseAbs().minCoeff(), 1e-3) << "a derivative that vanishes tests nothing: " << g.transpose();
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    const double expected =
        reference::derivative([&](const VectorXd& q) { return likelihood.value(q); }, p, k, step);
    EXPECT_NEAR(g[k], expected, tolerance * g.norm()) << "parameter " << k;
  }
}

TEST(Likelihood, HessianIsTheDifferenceQuotientOfTheGradient) {
  Likelihood likelihood = noisy_likelihood();
  const VectorXd p = somewhere();
  const MatrixXd H = likelihood.hessian(p);
  EXPECT_EQ(H, H.transpose());
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    const VectorXd expected =
        reference::derivative([&](const VectorXd& q) { return likelihood.gradient(q); }, p, k, step);
    EXPECT_LT((H.col(k) - expected).norm(), tolerance * H.norm()) << "parameter " << k;
  }
}

// Every family, trend and kind of noise against differences, as above; with the prior where the trend is
// linear.
TEST(Likelihood, DerivativesOfAllKindsAreDifferenceQuotients) {
  const reference::Data data = reference::training("noisy4", 100);
  LikelihoodProblem problem;
  problem.X = scaled(data.X);
  problem.y = reference::standardized(data.y);
  for (const Correlation family :
       {Correlation::power_exponential, Correlation::matern32, Correlation::matern52})
    for (const double known : {0.0, 0.05})
      for (const bool universal : {false, true}) {
        problem.family = family;
        problem.known_noise = known;
        problem.F = MatrixXd::Ones(100, 1);
        if (universal) {
          problem.F.resize(100, 5);
          problem.F << VectorXd::Ones(100), problem.X;
        }
        problem.prior = universal;
        problem.nugget_power = 0.5;
        problem.noise = universal ? VectorXd::LinSpaced(100, 0.2, 1.8) : VectorXd();
        Likelihood likelihood(problem);
        VectorXd p = VectorXd::Constant(likelihood.parameters(), 1.7);
        p.head(4) = somewhere().head(4);
        p.tail(1) = somewhere().tail(1);
        const VectorXd g = likelihood.gradient(p);
        const MatrixXd H = likelihood.hessian(p);
        for (Eigen::Index k = 0; k < p.size(); ++k) {
          const double slope =
              reference::derivative([&](const VectorXd& q) { return likelihood.value(q); }, p, k, step);
          EXPECT_NEAR(g[k], slope, tolerance * g.norm()) << to_string(family) << " parameter " << k;
          const VectorXd column =
              reference::derivative([&](const VectorXd& q) { return likelihood.gradient(q); }, p, k, step);
          EXPECT_LT((H.col(k) - column).norm(), tolerance * H.norm())
              << to_string(family) << " parameter " << k;
        }
      }
}

// With s² = τ²/λ the covariance is V = τ²/λ·(C + λ diag w), and F = ½ tr(V⁻¹Vₐ V⁻¹V_b).
TEST(Likelihood, FisherInformationOfKnownNoiseFollowsItsDefinition) {
  LikelihoodProblem problem;
  const reference::Data data = reference::training("noisy4", 100);
  problem.X = scaled(data.X);
  problem.y = reference::standardized(data.y);
  problem.known_noise = 0.05;
  Likelihood likelihood(problem);
  const auto matrix = [&](const VectorXd& q) {
    MatrixXd V;
    fill_correlation(problem.X, q.head(4).array().exp(), V);
    V = MatrixXd(V.selfadjointView<Eigen::Lower>());
    V.diagonal().array() += std::exp(q[4]);
    return MatrixXd(0.05 * std::exp(-q[4]) * V);
  };
  const VectorXd p = somewhere();
  const MatrixXd F = likelihood.fisher(p), K = matrix(p).inverse();
  for (Eigen::Index a = 0; a < 5; ++a)
    for (Eigen::Index b = 0; b < 5; ++b) {
      const MatrixXd A = K * reference::derivative(matrix, p, a, step),
                     B = K * reference::derivative(matrix, p, b, step);
      EXPECT_NEAR(F(a, b), 0.5 * (A * B).trace(), tolerance * F.norm());
    }
}

// F = ½ tr(R⁻¹Rₐ R⁻¹R_b) − tr(R⁻¹Rₐ) tr(R⁻¹R_b)/(2n), with Rₐ by differences of the whole matrix.
TEST(Likelihood, FisherInformationFollowsItsDefinition) {
  Likelihood likelihood = noisy_likelihood();
  const MatrixXd X = scaled(reference::training("noisy4", 100).X);
  const auto matrix = [&](const VectorXd& q) {
    MatrixXd R;
    fill_correlation(X, q.head(4).array().exp(), R);
    R = MatrixXd(R.selfadjointView<Eigen::Lower>());
    R.diagonal().array() += std::exp(q[4]);
    return R;
  };
  const VectorXd p = somewhere();
  const MatrixXd F = likelihood.fisher(p), K = matrix(p).inverse();
  for (Eigen::Index a = 0; a < 5; ++a) {
    for (Eigen::Index b = 0; b < 5; ++b) {
      const MatrixXd A = K * reference::derivative(matrix, p, a, step),
                     B = K * reference::derivative(matrix, p, b, step);
      const double expected = 0.5 * (A * B).trace() - A.trace() * B.trace() / 200.0;
      EXPECT_NEAR(F(a, b), expected, tolerance * F.norm());
    }
  }
}

// Runs at −1 and 1: c = exp(−4θ), μ = (a + b)/2, s² = δ²/(1 + λ − c) with δ = (b − a)/2, |R| = (1 + λ)² − c².
TEST(Likelihood, OfTwoRunsIsTheClosedForm) {
  const double a = 3.0, b = 4.5, delta = 0.5 * (b - a);
  Likelihood likelihood(Eigen::Vector2d(-1, 1), Eigen::Vector2d(a, b));
  for (const double theta : {0.05, 0.3, 2.0}) {
    for (const double nugget : {1e-6, 0.1, 3.0}) {
      const double c = std::exp(-4 * theta), s2 = delta * delta / (1 + nugget - c);
      const double expected =
          -std::log(2 * reference::pi * s2) - 0.5 * std::log((1 + nugget) * (1 + nugget) - c * c) - 1;
      // The condition (1 + λ + c)/(1 + λ − c) is at most 11: a few units in the last place.
      EXPECT_NEAR(likelihood.value(Eigen::Vector2d(std::log(theta), std::log(nugget))), expected, 1e-13);
      EXPECT_NEAR(likelihood.estimates().trend, 0.5 * (a + b), 1e-13);
      EXPECT_NEAR(likelihood.estimates().process_variance, s2, 1e-13);
    }
  }
}

TEST(Likelihood, IsMinusInfinityWhereTheMatrixIsSingular) {
  MatrixXd X(3, 1);
  X << 0, 0, 1;
  Likelihood likelihood(X, Eigen::Vector3d(1, 2, 3));
  const Eigen::Vector2d p(0, std::log(1e-300));
  EXPECT_EQ(likelihood.value(p), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(likelihood.gradient(p).isZero());
  EXPECT_TRUE(likelihood.hessian(p).isZero());
  EXPECT_TRUE(likelihood.fisher(p).isZero());
  EXPECT_TRUE(std::isfinite(likelihood.value(Eigen::Vector2d(0, -2)))) << "and recovers from it";
}
