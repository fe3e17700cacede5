// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Models of several responses one by one, beside the dense joint model of all; errors of known correlation.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/error_correlation.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/kriging/transformed_model.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <stdexcept>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double rate = 3.0, nugget = 1e-2;

FitOptions fixed_parameters() {
  FitOptions options;
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  options.theta_lower = options.theta_upper = rate / 4;  // of inputs scaled to [-1, 1]
  options.nugget_lower = options.nugget_upper = nugget;
  options.parameter_uncertainty = false;
  return options;
}

MatrixXd correlation_of(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd R(A.rows(), B.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < B.rows(); ++j)
      R(i, j) = std::exp(-rate * (A.row(i) - B.row(j)).squaredNorm());
  return R;
}

/// What a joint model of two responses with covariance B ⊗ (R + λ I) and a constant each says at Z, all first
/// of the first response, then of the second.
struct JointModel {
  VectorXd mean;
  MatrixXd covariance;
};

JointModel joint_model(const MatrixXd& X, const VectorXd& y, const Eigen::Matrix2d& B, const MatrixXd& Z) {
  const Eigen::Index n = X.rows(), m = Z.rows();
  const auto times = [&](const MatrixXd& M) {
    MatrixXd all(2 * M.rows(), 2 * M.cols());
    all << B(0, 0) * M, B(0, 1) * M, B(1, 0) * M, B(1, 1) * M;
    return all;
  };
  MatrixXd F = MatrixXd::Zero(2 * n, 2), G = MatrixXd::Zero(2 * m, 2);
  for (int j = 0; j < 2; ++j) F.block(j * n, j, n, 1).setOnes(), G.block(j * m, j, m, 1).setOnes();
  const Eigen::LLT<MatrixXd> K(times(correlation_of(X, X) + nugget * MatrixXd::Identity(n, n)));
  const MatrixXd C = times(correlation_of(X, Z)), KF = K.solve(F), KC = K.solve(C);
  const Eigen::Matrix2d spread = (F.transpose() * KF).inverse();
  const VectorXd beta = spread * (KF.transpose() * y);
  const MatrixXd rest = G - KC.transpose() * F;
  return {G * beta + KC.transpose() * (y - F * beta),
          times(correlation_of(Z, Z)) - C.transpose() * KC + rest * spread * rest.transpose()};
}

Validation with_errors(const VectorXd& errors) {
  const VectorXd ones = VectorXd::Ones(errors.size());
  return {.observed = errors, .predicted = 0 * errors, .variance = ones, .observation_variance = ones};
}

/// n errors of two responses with correlation r.
std::vector<Validation> two_responses(Eigen::Index n, double r, doe::Seed seed) {
  doe::RandomStream random(seed);
  VectorXd a(n), b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    a[i] = random.normal();
    b[i] = r * a[i] + std::sqrt(1 - r * r) * random.normal();
  }
  return {with_errors(a), with_errors(b)};
}

}  // namespace

// Autokrigeability: with one correlation function the joint means and variances are those of each model alone,
// and the draws have the joint covariance between the responses. Means to round-off times the condition, below
// 20/λ = 2000. The sample covariance of N draws has the standard error √((CᵢᵢCⱼⱼ + Cᵢⱼ²)/N); 5 of them are
// passed by chance once in a million for each entry.
TEST(ErrorCorrelation, DrawsAreThoseOfTheJointModel) {
  const MatrixXd X = reference::design(20, 2, 3), Z = reference::design(4, 2, 12);
  VectorXd y(40);
  for (Eigen::Index i = 0; i < 20; ++i) {
    y[i] = std::sin(5 * X(i, 0)) + X(i, 1);
    y[20 + i] = 100 * std::cos(4 * X(i, 1)) - 70 * X(i, 0);
  }
  const Model first = fit(X, VectorXd(y.head(20)), fixed_parameters()),
              second = fit(X, VectorXd(y.tail(20)), fixed_parameters());
  constexpr double r = -0.6;
  Eigen::Matrix2d B;
  B << first.process_variance(), 0, 0, second.process_variance();
  B(0, 1) = B(1, 0) = r * std::sqrt(B(0, 0) * B(1, 1));
  const JointModel joint = joint_model(X, y, B, Z);
  EXPECT_LT((joint.mean.head(4) - first.mean(Z)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((joint.mean.tail(4) - second.mean(Z)).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((joint.covariance.topLeftCorner(4, 4) - first.covariance(Z)).cwiseAbs().maxCoeff(),
            1e-10 * B(0, 0));

  constexpr int N = 8000;
  Eigen::Matrix2d R;
  R << 1, r, r, 1;
  const std::vector<MatrixXd> normals = correlated_normals(R, 4, N, 5);
  MatrixXd deviations(8, N);
  deviations << sample_paths(first, Z, normals[0]).colwise() - first.mean(Z),
      sample_paths(second, Z, normals[1]).colwise() - second.mean(Z);
  const MatrixXd found = deviations * deviations.transpose() / N, &C = joint.covariance;
  for (Eigen::Index i = 0; i < 8; ++i)
    for (Eigen::Index j = 0; j < 8; ++j)
      EXPECT_NEAR(found(i, j), C(i, j), 5 * std::sqrt((C(i, i) * C(j, j) + C(i, j) * C(i, j)) / N));
}

TEST(ErrorCorrelation, WithoutAnyDrawsAreThoseOfTheSeeds) {
  const std::vector<MatrixXd> normals = correlated_normals(MatrixXd::Identity(3, 3), 5, 7, 11);
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_EQ(normals[j], detail::standard_normals(5, 7, doe::run_seed(11, j, 0))) << j;
}

// A response and the same one turned over and stretched: the same errors in deviations, with the other sign.
TEST(ErrorCorrelation, OfAResponseTurnedOverIsMinusOne) {
  const MatrixXd X = reference::design(20, 2, 3);
  doe::RandomStream random(4);
  VectorXd y(20);
  for (Eigen::Index i = 0; i < 20; ++i) y[i] = X(i, 0) + 0.2 * random.normal();
  const Model model = fit(X, y, fixed_parameters()),
              other = fit(X, VectorXd((5 - 40 * y.array()).matrix()), fixed_parameters());
  const MatrixXd R = error_correlation({leave_one_out(model), leave_one_out(other)});
  EXPECT_NEAR(R(0, 1), -1.0, 1e-10);
  EXPECT_EQ(R(0, 1), R(1, 0));
}

// Where predictions are normal on a logarithmic scale errors are taken there: ln y and y on that scale have the
// same ones.
TEST(ErrorCorrelation, IsTakenOnTheScaleOfThePredictions) {
  const MatrixXd X = reference::design(20, 2, 3);
  doe::RandomStream random(4);
  VectorXd z(20);
  for (Eigen::Index i = 0; i < 20; ++i) z[i] = X(i, 0) + 0.5 * random.normal();
  FitOptions options;
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  const Model on_logarithm = fit(X, z, options);
  const TransformedModel itself =
      fit_transformed(X, VectorXd(z.array().exp().matrix()), Scale::logarithm, {.lower = 0.0}, options);
  EXPECT_NEAR(error_correlation({leave_one_out(on_logarithm), leave_one_out(itself)})(0, 1), 1.0, 1e-9);
}

// Of n = 400 normal errors the sample correlation has the standard error (1 − r²)/√n, and shrinking takes
// (1 − r²)²/(n − 1)/r² of it off. Four errors: one of correct code in 16 000.
TEST(ErrorCorrelation, IsFoundAsFarAsTheRunsTell) {
  for (const double r : {-0.8, 0.3, 0.6}) {
    const double error = (1 - r * r) / 20, off = error * error / (r * r);
    EXPECT_NEAR(error_correlation(two_responses(400, r, 3))(0, 1), r * (1 - off), 4 * error) << r;
  }
}

// Of unrelated errors the sample correlation is below 1/√(n − 1) in two of three designs, where all of it is
// taken off: of 200, 136 ± 6.6. What is left of the others is below their correlation, so that the root mean
// square of all is below a standard error, 1/√39 = 0.16: chance alone would give that.
TEST(ErrorCorrelation, OfUnrelatedErrorsIsMostlyNone) {
  int none = 0;
  double squares = 0;
  for (doe::Seed seed = 1; seed <= 200; ++seed) {
    const double r = error_correlation(two_responses(40, 0, seed))(0, 1);
    if (r == 0) ++none;
    squares += r * r;
  }
  EXPECT_NEAR(none, 136, 4 * 6.6);
  EXPECT_LT(std::sqrt(squares / 200), 0.16);
}

TEST(ErrorCorrelation, IsACorrelationWhateverTheErrors) {
  doe::RandomStream random(8);
  for (const Eigen::Index n : {1, 2, 5, 30}) {
    std::vector<Validation> responses;
    for (int j = 0; j < 6; ++j) {
      VectorXd errors(n);
      for (double& e : errors) e = j == 5 ? 0.0 : random.normal();
      responses.push_back(with_errors(errors));
    }
    const MatrixXd R = error_correlation(responses);
    EXPECT_EQ(R, MatrixXd(R.transpose()));
    EXPECT_TRUE((R.diagonal().array() == 1.0).all());
    EXPECT_GT(R.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12) << n;
    EXPECT_NO_THROW(correlated_normals(R, 2, 3, 1));
    if (n < 3) {
      EXPECT_EQ(R, MatrixXd::Identity(6, 6)) << "two runs tell nothing";
    }
  }
}

// The norms' round-off may put the correlation of equal errors above 1; draws still take it.
TEST(ErrorCorrelation, OfEqualErrorsIsOneAtMost) {
  doe::RandomStream random(9);
  for (int i = 0; i < 200; ++i) {
    VectorXd errors(6);
    for (double& e : errors) e = random.normal();
    const MatrixXd R = error_correlation({with_errors(errors), with_errors(3 * errors)});
    EXPECT_LE(R(0, 1), 1.0);
    EXPECT_GT(R(0, 1), 1 - 1e-14);
    EXPECT_NO_THROW(correlated_normals(R, 2, 3, 1));
  }
}

TEST(ErrorCorrelation, RefusesWhatIsNone) {
  EXPECT_EQ(error_correlation({}).size(), 0);
  EXPECT_THROW(error_correlation({with_errors(VectorXd(0))}), std::invalid_argument);
  EXPECT_THROW(error_correlation({with_errors(VectorXd::Ones(3)), with_errors(VectorXd::Ones(4))}),
               std::invalid_argument);
  EXPECT_THROW(correlated_normals(MatrixXd::Ones(2, 3), 2, 3, 1), std::invalid_argument);
  EXPECT_THROW(correlated_normals(MatrixXd::Constant(2, 2, 0.5), 2, 3, 1), std::invalid_argument);
  MatrixXd R = MatrixXd::Identity(2, 2);
  R(0, 1) = R(1, 0) = 1.5;
  EXPECT_THROW(correlated_normals(R, 2, 3, 1), std::invalid_argument);
  R(0, 1) = 0.5;
  EXPECT_THROW(correlated_normals(R, 2, 3, 1), std::invalid_argument) << "not symmetric";
  MatrixXd none = MatrixXd::Constant(3, 3, 0.9);  // of no three responses: an eigenvalue is -0.8
  none.diagonal().setOnes();
  none(1, 2) = none(2, 1) = -0.9;
  EXPECT_THROW(correlated_normals(none, 2, 3, 1), std::invalid_argument);
  EXPECT_TRUE(correlated_normals({}, 2, 3, 1).empty());
  const Model model = fit(reference::design(20, 2, 3), VectorXd::LinSpaced(20, 0, 1), fixed_parameters());
  EXPECT_THROW(sample_paths(model, MatrixXd::Zero(3, 2), MatrixXd::Zero(2, 10)), std::invalid_argument);
}
