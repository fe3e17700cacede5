// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/detail/fit_prepared.hpp>
#include <drawpoint/kriging/fit_fidelities.hpp>
#include <drawpoint/tests/kriging/derivatives.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/kriging/structures.hpp>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using structures::Reference;

namespace {

std::vector<Reference> all_kinds(Eigen::Index n = 16) {
  std::vector<Reference> all;
  for (const Structure structure : structures::others)
    for (const Correlation family : reference::families)
      all.push_back(structures::some_runs(structure, family, n));
  return all;
}

std::string name(const Reference& r) {
  return std::string(to_string(r.structure)) + " " + std::string(to_string(r.family));
}

Likelihood likelihood_of(const Reference& r, bool prior = false, double known_noise = 0) {
  LikelihoodProblem problem;
  problem.X = r.X;
  problem.y = r.y;
  problem.family = r.family;
  problem.structure = r.structure;
  problem.levels = {0, 0, 4};
  problem.prior = prior;
  problem.nugget_power = 0.5;
  problem.known_noise = known_noise;
  return Likelihood(problem);
}

Model without_spread(const Model& model) {
  detail::ModelState s = model.state();
  s.parameter_spread.resize(0, 0);
  return Model(s);
}

}  // namespace

// λ = 0.05 keeps R's condition below n/λ = 320, so both agree to some 1e-13 of LL, which is about 20.
TEST(Structures, LikelihoodIsThatOfADenseReference) {
  for (const Reference& r : all_kinds()) {
    Likelihood likelihood = likelihood_of(r);
    const VectorXd p = r.somewhere();
    ASSERT_EQ(likelihood.parameters(), p.size()) << name(r);
    EXPECT_NEAR(likelihood.value(p), r.log_likelihood(p), 1e-10) << name(r);
  }
}

// With and without a prior and known noise. Steps of 0.02 and 0.01 leave h⁴ f⁽⁵⁾/480, 3e-10 of f⁽⁵⁾; a
// derivative by a logarithm multiplies terms by 4 at most (2(1 + θh²), θh² below 5 where c is not nothing,
// and weights by less), so f⁽⁵⁾ is below 4⁴ f' and the error below 1e-7 of the derivatives. Round-off is
// 1e-13/h.
TEST(Structures, DerivativesAreDifferenceQuotients) {
  for (const Reference& r : all_kinds())
    for (const bool prior : {false, true})
      for (const double known : {0.0, 0.05}) {
        Likelihood likelihood = likelihood_of(r, prior, known);
        VectorXd p = r.somewhere();
        if (r.structure == Structure::additive) p[p.size() - 2] += 0.4;  // Σv ≠ 0
        const VectorXd g = likelihood.gradient(p);
        const MatrixXd H = likelihood.hessian(p);
        EXPECT_LT((H - H.transpose()).norm(), 1e-15 * H.norm());
        for (Eigen::Index k = 0; k < p.size(); ++k) {
          const auto value = [&](const VectorXd& q) { return likelihood.value(q); };
          const auto gradient = [&](const VectorXd& q) { return likelihood.gradient(q); };
          EXPECT_NEAR(g[k], reference::derivative(value, p, k, 0.02), 1e-6 * g.norm()) << name(r) << " " << k;
          EXPECT_LT((H.col(k) - reference::derivative(gradient, p, k, 0.02)).norm(), 1e-6 * H.norm())
              << name(r) << " " << k;
        }
      }
}

// ½ tr(R⁻¹Rₐ R⁻¹R_b) − tr(R⁻¹Rₐ) tr(R⁻¹R_b)/(2n), with Rₐ by the same differences.
TEST(Structures, InformationIsThatOfADenseReference) {
  for (const Reference& r : all_kinds()) {
    const VectorXd p = r.somewhere();
    const MatrixXd K = r.matrix(p).inverse(), F = likelihood_of(r).fisher(p);
    std::vector<MatrixXd> slopes;
    for (Eigen::Index k = 0; k < p.size(); ++k)
      slopes.push_back(K * reference::derivative([&](const VectorXd& q) { return r.matrix(q); }, p, k, 0.02));
    for (std::size_t a = 0; a < slopes.size(); ++a)
      for (std::size_t b = 0; b < slopes.size(); ++b)
        EXPECT_NEAR(F(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)),
                    0.5 * (slopes[a] * slopes[b]).trace() - slopes[a].trace() * slopes[b].trace() / 32.0,
                    1e-6 * F.norm())
            << name(r);
  }
}

// Mean, variance and covariance of a fit by their equations with R inverted. λ is above 1e-6 here: the
// condition is below 16/1e-6, which leaves nine digits.
TEST(Structures, PredictionsAreThoseOfADenseReference) {
  for (const Reference& r : all_kinds()) {
    FitOptions options = structures::options_of(r);
    options.parameter_uncertainty = false;
    options.may_be_exact = false;  // by one explanation of the runs
    const Model model = fit(r.X, r.y, options);
    const VectorXd p = r.parameters(model);
    ASSERT_GT(model.nugget(), 1e-6);
    MatrixXd Z(4, 3), c(16, 4), prior(4, 4);
    Z << 0.1, -0.3, 0, 0.1, -0.3, 1, 0.1, -0.3, 2, -0.9, 0.7, 3;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 16; ++i) c(i, j) = r.correlation(p, r.X.row(i), Z.row(j));
      for (int i = 0; i < 4; ++i) prior(i, j) = r.correlation(p, Z.row(i), Z.row(j));
    }
    const MatrixXd K = r.matrix(p).inverse();
    const VectorXd u = VectorXd::Ones(4) - c.transpose() * K * VectorXd::Ones(16);
    const double beta = (K * r.y).sum() / K.sum();
    const VectorXd residual = r.y.array() - beta, mean = (c.transpose() * K * residual).array() + beta;
    const double s2 = residual.dot(K * residual) / 16.0;
    const MatrixXd covariance = s2 * (prior - c.transpose() * K * c + u * u.transpose() / K.sum());
    const Prediction predicted = model.predict(Z);
    EXPECT_LT((predicted.mean - mean).cwiseAbs().maxCoeff(), 1e-8) << name(r);
    EXPECT_LT((model.mean(Z) - mean).cwiseAbs().maxCoeff(), 1e-8) << name(r);
    EXPECT_LT((predicted.variance - covariance.diagonal()).cwiseAbs().maxCoeff(), 1e-8) << name(r);
    EXPECT_LT((model.covariance(Z) - covariance).cwiseAbs().maxCoeff(), 1e-8) << name(r);
    EXPECT_NEAR(model.log_likelihood(), r.log_likelihood(p), 1e-7) << name(r);
  }
}

// What the variance has beyond that of known parameters is gᵀVg, g by differences of models of other
// parameters: as in parameter_uncertainty_analytic.cpp 1e-5 of the largest, and 1e-4 with exponents.
TEST(Structures, ParameterUncertaintyIsOfFirstOrder) {
  MatrixXd Z = categories::points(12, 4, 5);
  Z.leftCols(2) = 2.0 * Z.leftCols(2).array() - 1.0;
  for (const Reference& r : all_kinds(32)) {
    FitOptions options = structures::options_of(r);
    options.may_be_exact = false;  // by one explanation of the runs
    const Model model = fit(r.X, r.y, options);
    const VectorXd p = r.parameters(model);
    const MatrixXd& S = model.state().parameter_spread;
    ASSERT_GE(S.cols(), 2) << name(r);
    const detail::TrainingData data = detail::prepare(r.X, r.y, options);
    Likelihood likelihood(detail::likelihood_problem(data, options));
    const auto mean = [&](const VectorXd& q) {
      likelihood.value(q);
      return Model(detail::state_of(data, likelihood, {})).mean(Z);
    };
    MatrixXd G = MatrixXd::Zero(Z.rows(), p.size());
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      const bool exponent = r.exponents() && k >= r.thetas() && k < 2 * r.thetas();
      const double step = exponent ? std::min(0.02, 0.05 * (2.0 - p[k])) : 0.02;
      if (step > 0 && S.row(k).norm() > 0) G.col(k) = reference::derivative(mean, p, k, step);
    }
    const VectorXd expected = (G * S).rowwise().squaredNorm();
    const VectorXd added = model.predict(Z).variance - without_spread(model).predict(Z).variance;
    EXPECT_LT((added - expected).cwiseAbs().maxCoeff(), (r.exponents() ? 1e-4 : 1e-5) * expected.maxCoeff())
        << name(r);
  }
}

// h = 1e-3: truncation 1e-12·f⁽⁵⁾/480 with f⁽⁵⁾ up to 20⁵, round-off 1e-10 s²/h, as for products.
TEST(Structures, GradientsAreDifferenceQuotients) {
  MatrixXd Z = categories::points(6, 4, 6);
  Z.leftCols(2) = 1.8 * Z.leftCols(2).array() - 0.9;
  for (const Reference& r : all_kinds(32)) {
    const Model model = fit(r.X, r.y, structures::options_of(r));
    for (Eigen::Index i = 0; i < Z.rows(); ++i) {
      const VectorXd x = Z.row(i).transpose();
      const PredictionGradient g = model.gradient(x);
      EXPECT_EQ(g.mean, model.mean_gradient(x));
      EXPECT_EQ(g.mean[2], 0.0);
      EXPECT_EQ(g.variance[2], 0.0);
      for (Eigen::Index k = 0; k < 2; ++k) {
        const auto mean = [&](const VectorXd& at) { return model.predict(at.transpose()).mean[0]; };
        const auto variance = [&](const VectorXd& at) { return model.predict(at.transpose()).variance[0]; };
        EXPECT_NEAR(g.mean[k], reference::derivative(mean, x, k, 1e-3), 1e-6 * (g.mean.norm() + 1))
            << name(r);
        EXPECT_NEAR(g.variance[k], reference::derivative(variance, x, k, 1e-3),
                    1e-6 * (g.variance.norm() + model.process_variance()))
            << name(r);
      }
    }
  }
}

// The same arithmetic on the same numbers.
TEST(Structures, IsotropicIsTheProductOfEqualThetas) {
  const Reference r = structures::some_runs(Structure::isotropic, Correlation::gaussian);
  for (const Correlation family : reference::families) {
    FitOptions product = categories::box_options();
    product.correlation = family;
    product.theta_lower = product.theta_upper = 0.8;
    product.nugget_lower = product.nugget_upper = 0.01;
    if (family == Correlation::power_exponential) product.exponent = VectorXd::Constant(3, 1.9);
    FitOptions isotropic = product;
    isotropic.structure = Structure::isotropic;
    const Model a = fit(r.X, r.y, product), b = fit(r.X, r.y, isotropic);
    EXPECT_EQ(a.predict(r.X).mean, b.predict(r.X).mean) << to_string(family);
    EXPECT_EQ(a.predict(r.X).variance, b.predict(r.X).variance) << to_string(family);
    EXPECT_EQ(a.log_likelihood(), b.log_likelihood()) << to_string(family);
  }
}

// Of one number that varies there is nothing to share: the same fit, bit for bit, prior and all.
TEST(Structures, OneNumberIsIsotropic) {
  const Reference r = structures::some_runs(Structure::isotropic, Correlation::gaussian);
  for (const Correlation family : reference::families) {
    FitOptions product;
    product.correlation = family;
    FitOptions isotropic = product;
    isotropic.structure = Structure::isotropic;
    const Model a = fit(r.X.leftCols(1), r.y, product), b = fit(r.X.leftCols(1), r.y, isotropic);
    EXPECT_EQ(a.theta(), b.theta());
    EXPECT_EQ(a.predict(r.X.leftCols(1)).variance, b.predict(r.X.leftCols(1)).variance);
  }
}

TEST(Structures, IsotropicNumbersShareAndCategoriesDoNot) {
  const Reference r = structures::some_runs(Structure::isotropic, Correlation::power_exponential, 32);
  const Model model = fit(r.X, r.y, structures::options_of(r));
  EXPECT_EQ(model.theta()[0], model.theta()[1]);
  EXPECT_NE(model.theta()[0], model.theta()[2]);
  EXPECT_EQ(model.correlation().exponent[0], model.correlation().exponent[1]);
  EXPECT_EQ(model.correlation().exponent[2], 2.0) << "at one distance it says what theta says";
}

TEST(Structures, SeveralLevelsRefuseThem) {
  const MatrixXd X = reference::design(12, 2, 3);
  const VectorXd y = X.col(0) + X.col(1).cwiseAbs2();
  FitOptions options;
  options.structure = Structure::additive;
  try {
    fit_fidelities({{"cheap", X, y, options}, {"true", X.topRows(6), y.head(6), {}}});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(),
                 "kriging::fit_fidelities: level \"cheap\": its options.structure is additive; allowed with "
                 "several levels is product; leave it at that");
  }
}
