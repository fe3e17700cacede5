// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

FitOptions additive(Eigen::Index d) {
  FitOptions options;
  options.structure = Structure::additive;
  options.lower = VectorXd::Constant(d, -1);
  options.upper = VectorXd::Ones(d);
  return options;
}

FitOptions with_nugget(double nugget) {
  FitOptions options = additive(2);
  options.theta_lower = options.theta_upper = 0.5;
  options.nugget_lower = options.nugget_upper = nugget;
  options.parameter_uncertainty = false;
  return options;
}

MatrixXd corners() {
  MatrixXd X(4, 2);
  X << -1, -1, 1, -1, -1, 1, 1, 1;
  return X;
}

// Of ten inputs, one function each.
double sum_of_functions(const VectorXd& x) {
  double sum = 0;
  for (Eigen::Index k = 0; k < x.size(); ++k)
    sum += std::sin((1.5 + 0.25 * static_cast<double>(k)) * x[k] + static_cast<double>(k));
  return sum;
}

double nrmse(const Model& model, const MatrixXd& X, const VectorXd& y) {
  return std::sqrt((model.mean(X) - y).squaredNorm() / (y.array() - y.mean()).square().sum());
}

}  // namespace

// c(00) − c(10) − c(01) + c(11) = 0 whatever θ and the weights are, so a rectangle of points has no
// interaction: z = (1, −1, −1, 1) spans the null space of C. 2.5e-16 a term of four.
TEST(AdditiveCorrelation, IsSingularOnRectangles) {
  for (const Correlation family : {Correlation::gaussian, Correlation::matern32, Correlation::matern52}) {
    CorrelationFunction f{family, Eigen::Vector2d(0.7, 3.0), {}};
    f.structure = Structure::additive;
    f.weight = Eigen::Vector2d(0.3, 0.7);
    MatrixXd C;
    fill_correlation(corners(), f, C);
    C = MatrixXd(C.selfadjointView<Eigen::Lower>());
    EXPECT_LT((C * Eigen::Vector4d(1, -1, -1, 1)).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(C).eigenvalues()[1], 0.1) << "and nothing else does";
  }
}

// On a rectangle the nugget decides: y = x₁x₂ is all in the null space, so it is noise, whatever λ: the mean
// is the trend, 0, everywhere, and s² λ = y² (s² = yᵀR⁻¹y/4 = 4/λ/4). Round-off is the condition, 4/λ, times
// 1e-16: 4e-8.
TEST(AdditiveCorrelation, TakesInteractionsOfRectanglesForNoise) {
  const VectorXd y = Eigen::Vector4d(1, -1, -1, 1);
  for (const double nugget : {1e-8, 1e-2}) {
    const Model model = fit(corners(), y, with_nugget(nugget));
    EXPECT_LT(model.mean(corners()).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_NEAR(model.noise_variance(), 1.0, 1e-7);
  }
  // Estimated, λ cannot leave it either; the model is valid and says what it took for noise.
  const Model model = fit(corners(), y, additive(2));
  EXPECT_NE(model.status(), Status::ill_conditioned) << model.message();
  EXPECT_LT(model.mean(corners()).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_TRUE(model.predict(corners()).variance.allFinite());
}

// Three corners tell the fourth, y₄ = y₂ + y₃ − y₁, of any additive function, and are sure of it. The nugget
// moves it by some λ: with w = 0.5 the smallest eigenvalue of C but 0 is 0.8, so y₄ moves by less than
// 4λ·4/0.8 of the largest y, 4.
TEST(AdditiveCorrelation, ThreeCornersTellTheFourth) {
  const Eigen::Vector3d y(1, 4, -2);
  constexpr double nugget = 1e-9;
  const Model model = fit(corners().topRows(3), y, with_nugget(nugget));
  const Prediction p = model.predict(corners().bottomRows(1));
  EXPECT_NEAR(p.mean[0], 1.0, 80 * nugget);
  EXPECT_LT(p.variance[0], 80 * nugget * model.process_variance());
  FitOptions product = with_nugget(nugget);
  product.structure = Structure::product;
  const Prediction other = fit(corners().topRows(3), y, product).predict(corners().bottomRows(1));
  EXPECT_GT(other.variance[0], 0.01) << "a product does not know";
}

// 80 runs of a sum of ten functions, each less than one and a half waves, which polynomials of degree 5 meet
// to 1 %: some 50 coefficients, so that the runs tell the sum, to less than 0.1 % with an analytic kernel. To
// products, with a θ each or one, it is a function of ten inputs: eight runs per input leave a fifth and
// more.
TEST(AdditiveCorrelation, FindsASumThatProductsDoNot) {
  const MatrixXd X = 2.0 * reference::design(80, 10, 4).array() - 1.0,
                 Z = 2.0 * reference::design(1000, 10, 5).array() - 1.0;
  const VectorXd y = reference::values(sum_of_functions, X), truth = reference::values(sum_of_functions, Z);
  FitOptions options = additive(10);
  const Model sum = fit(X, y, options);
  options.structure = Structure::product;
  const double product = nrmse(fit(X, y, options), Z, truth);
  options.structure = Structure::isotropic;
  const double isotropic = nrmse(fit(X, y, options), Z, truth);
  EXPECT_LT(nrmse(sum, Z, truth), 0.001) << sum.message();
  EXPECT_GT(product, 0.2);
  EXPECT_GT(isotropic, 0.2);
}

// Inputs that never vary weigh nothing, and what is constant stays so.
TEST(AdditiveCorrelation, LeavesOutWhatNeverVaries) {
  MatrixXd X(12, 3);
  X << 2.0 * reference::design(12, 1, 4).array() - 1.0, VectorXd::Constant(12, 0.3),
      VectorXd::Constant(12, 1.0);
  const VectorXd y = X.col(0).array().sin();
  FitOptions options = additive(3);
  options.levels = {0, 0, 2};
  const Model model = fit(X, y, options);
  EXPECT_EQ(model.correlation().weight, Eigen::Vector3d(1, 0, 0));
  MatrixXd Z = X;
  Z.col(1).setConstant(-0.7);
  Z.col(2).setConstant(0.0);
  EXPECT_EQ(model.mean(Z), model.mean(X));
  EXPECT_NE(model.message().find("input 2: predictions there ignore it"), std::string::npos)
      << model.message();
  const Model constant = fit(X, VectorXd::Constant(12, 2.0), options);
  EXPECT_EQ(constant.status(), Status::constant_response);
  EXPECT_EQ(constant.mean(Z), VectorXd::Constant(12, 2.0));
  const Model nowhere = fit(X.topRows(1).replicate(3, 1), Eigen::Vector3d(1, 2, 3), options);
  EXPECT_TRUE(nowhere.predict(Z).variance.allFinite());
}

// Without a prior the weights have a gauge alone, which is 0 at the maximum: the value there is LL.
TEST(AdditiveCorrelation, HasAMaximumOfTheLikelihoodAlone) {
  const MatrixXd X = 2.0 * reference::design(30, 3, 4).array() - 1.0;
  VectorXd y = X.col(0).array().sin() + X.col(1).array().square() + 0.2 * (3.0 * X.col(2).array()).cos();
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] += 0.05 * std::cos(1e3 * static_cast<double>(i));
  FitOptions options = additive(3);
  options.estimation = Estimation::maximum_likelihood;
  const Model model = fit(X, y, options);
  EXPECT_EQ(model.status(), Status::converged) << model.message();
  EXPECT_NEAR(model.correlation().weight.sum(), 1.0, 1e-15);
  options.estimation = Estimation::penalized_likelihood;
  EXPECT_GE(model.log_likelihood(), fit(X, y, options).log_likelihood() - 1e-3);
}
