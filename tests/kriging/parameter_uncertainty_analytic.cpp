// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/detail/fit_prepared.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/reinterpolation.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <vector>

using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double hill(const VectorXd& x) {
  return std::sin(4 * x[0]) + std::exp(x[1]) + 0.3 * std::cos(9 * x[0] * x[1]);
}

// A ripple of half a per cent keeps λ off its bounds and the condition of R near 1e7.
reference::Data runs() {
  reference::Data data{reference::design(40, 2, 21), {}};
  data.y = reference::values(hill, data.X);
  for (Eigen::Index i = 0; i < data.y.size(); ++i) data.y[i] += 0.02 * std::cos(1e3 * double(i));
  return data;
}

std::vector<FitOptions> kinds() {
  std::vector<FitOptions> all;
  for (const Correlation family :
       {Correlation::gaussian, Correlation::matern52, Correlation::matern32, Correlation::power_exponential})
    for (const Trend trend : {Trend::constant, Trend::linear}) {
      FitOptions options;
      options.correlation = family;
      options.trend = trend;
      options.may_be_exact = false;  // by one explanation of the runs
      all.push_back(options);
    }
  all.front().noise = Noise::proportional;
  all.front().noise_variance = VectorXd::LinSpaced(40, 0.5, 1.5);
  return all;
}

VectorXd parameters(const Model& model, const Likelihood& likelihood) {
  const Eigen::Index d = model.variables();
  VectorXd p(likelihood.parameters());
  p.head(d) = model.theta().array().log();
  if (likelihood.estimates_exponents()) p.segment(d, d) = model.correlation().exponent;
  p[p.size() - 1] = std::log(model.nugget());
  return p;
}

// The model that θ, exponents and λ of p make of the same runs.
class Refitted {
 public:
  explicit Refitted(const FitOptions& options)
      : data_(detail::prepare(runs().X, runs().y, options)),
        likelihood_(detail::likelihood_problem(data_, options)) {}

  Likelihood& likelihood() { return likelihood_; }
  /// ∂ŷ/∂p at the rows of Z by central differences and Richardson's extrapolation, one column a parameter.
  MatrixXd slopes(const VectorXd& p, const MatrixXd& Z) {
    MatrixXd G(Z.rows(), p.size());
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      const bool exponent = k >= 2 && k + 1 < p.size();  // the model changes on the scale of 2 − exponent
      const double step = exponent ? std::min(0.02, 0.05 * (2.0 - p[k])) : 0.02;
      G.col(k) = step > 0 ? VectorXd((4.0 * central(p, Z, k, 0.5 * step) - central(p, Z, k, step)) / 3.0)
                          : VectorXd::Zero(Z.rows());
    }
    return G;
  }

 private:
  VectorXd central(const VectorXd& p, const MatrixXd& Z, Eigen::Index k, double h) {
    VectorXd up = p, down = p;
    up[k] += h;
    down[k] -= h;
    return (mean(up, Z) - mean(down, Z)) / (2 * h);
  }

  VectorXd mean(const VectorXd& p, const MatrixXd& Z) {
    likelihood_.value(p);
    return Model(detail::state_of(data_, likelihood_, {})).mean(Z);
  }

  detail::TrainingData data_;
  Likelihood likelihood_;
};

Model without(const Model& model) {
  detail::ModelState s = model.state();
  s.parameter_spread.resize(0, 0);
  return Model(s);
}

}  // namespace

// What the variance has beyond that of known parameters is gᵀVg with g by central differences of models of
// other parameters. Richardson's steps of 0.02 and 0.01 leave h⁴ f⁽⁵⁾/480, below 1e-6 of g as for the
// likelihood; round-off is the condition, 1e7, times 1e-16 over the step: 1e-7, and with the steps of 6e-4 at
// exponents near 2 2e-6 of y, which is 1e-4 of the g of these. So 1e-5 of the largest, and 1e-4 with
// exponents.
TEST(ParameterUncertainty, IsTheVarianceOfTheMeanToFirstOrder) {
  const MatrixXd Z = reference::design(12, 2, 5);
  for (const FitOptions& options : kinds()) {
    const Model model = fit(runs().X, runs().y, options);
    Refitted other(options);
    const VectorXd p = parameters(model, other.likelihood());
    const MatrixXd G = other.slopes(p, Z);
    const VectorXd expected = (G * model.state().parameter_spread).rowwise().squaredNorm();
    ASSERT_GE(model.state().parameter_spread.cols(), 2) << "nothing was free: this tests nothing";
    const double tolerance = options.correlation == Correlation::power_exponential ? 1e-4 : 1e-5;
    const VectorXd added = model.predict(Z).variance - without(model).predict(Z).variance;
    EXPECT_LT((added - expected).cwiseAbs().maxCoeff(), tolerance * expected.maxCoeff())
        << to_string(options.correlation) << ", trend " << static_cast<int>(options.trend);
    EXPECT_EQ(model.predict(Z).mean, without(model).predict(Z).mean);
  }
}

// V (H + D) = I for the free parameters; solving loses the condition of that matrix, below 1e4.
TEST(ParameterUncertainty, SpreadIsTheInverseOfTheCurvature) {
  for (const FitOptions& options : kinds()) {
    const Model model = fit(runs().X, runs().y, options);
    Refitted other(options);
    const MatrixXd H = other.likelihood().hessian(parameters(model, other.likelihood()));
    const MatrixXd& S = model.state().parameter_spread;
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < S.rows(); ++k)
      if (S.row(k).norm() > 0) free.push_back(k);
    const MatrixXd V = (S * S.transpose())(free, free);
    MatrixXd information = -H(free, free);
    for (std::size_t i = 0; i < free.size(); ++i) {
      const bool exponent = free[i] >= 2 && free[i] + 1 < S.rows();
      information(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) += exponent ? 12.0 : 0.25;
    }
    const MatrixXd product = V * information;
    EXPECT_LT((product - MatrixXd::Identity(V.rows(), V.rows())).norm(), 1e-9)
        << to_string(options.correlation);
    EXPECT_LE(V.diagonal().maxCoeff(), 4.0 + 1e-9);
  }
}

// The gradient of the variance by Richardson's differences in x; the covariance has the variances on its
// diagonal.
TEST(ParameterUncertainty, HasItsGradientAndCovariance) {
  const MatrixXd Z = reference::design(6, 2, 6);
  for (const FitOptions& options : kinds()) {
    const Model model = fit(runs().X, runs().y, options);
    const VectorXd variance = model.predict(Z).variance;
    EXPECT_LT((model.covariance(Z).diagonal() - variance).cwiseAbs().maxCoeff(),
              1e-9 * model.process_variance());
    for (Eigen::Index i = 0; i < Z.rows(); ++i) {
      const VectorXd x = Z.row(i).transpose(), g = model.gradient(x).variance;
      for (Eigen::Index k = 0; k < 2; ++k) {
        const auto central = [&](double h) {
          MatrixXd pair(2, 2);
          pair << x.transpose(), x.transpose();
          pair(0, k) += h;
          pair(1, k) -= h;
          const VectorXd v = model.predict(pair).variance;
          return (v[0] - v[1]) / (2 * h);
        };
        // h = 1e-3: truncation 1e-12·f⁽⁵⁾/480, f⁽⁵⁾ up to 20⁵ of the variance; round-off 1e-10 s²/h.
        EXPECT_NEAR(g[k], (4.0 * central(5e-4) - central(1e-3)) / 3.0,
                    1e-6 * (g.norm() + model.process_variance()))
            << to_string(options.correlation);
      }
    }
  }
}

TEST(ParameterUncertainty, IsNoneWhereAllIsGivenOrNotAskedFor) {
  FitOptions options;
  options.parameter_uncertainty = false;
  const Model off = fit(runs().X, runs().y, options);
  EXPECT_EQ(off.state().parameter_spread.cols(), 0);
  const Model on = fit(runs().X, runs().y);
  EXPECT_EQ(on.theta(), off.theta());
  EXPECT_GT(on.predict(runs().X).variance.sum(), off.predict(runs().X).variance.sum());
  options.parameter_uncertainty = true;
  options.theta_lower = options.theta_upper = 1.0;
  options.nugget_lower = options.nugget_upper = 1e-3;
  EXPECT_EQ(fit(runs().X, runs().y, options).state().parameter_spread.cols(), 0);
  EXPECT_EQ(reinterpolated(on).state().parameter_spread.cols(), 0);
}

// More runs leave V as it is, and what it does to the mean is found anew: as by differences of the mean of
// all runs.
TEST(ParameterUncertainty, IsOfAllRunsAfterAppending) {
  const reference::Data data = runs();
  FitOptions options;
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  const Model some = fit(data.X.topRows(30), data.y.head(30), options);
  const Model all = append(some, data.X.bottomRows(10), data.y.tail(10));
  EXPECT_EQ(all.state().parameter_spread, some.state().parameter_spread);
  Refitted other(options);
  const MatrixXd Z = reference::design(5, 2, 7);
  const MatrixXd G = other.slopes(parameters(all, other.likelihood()), Z);
  const VectorXd expected = (G * all.state().parameter_spread).rowwise().squaredNorm();
  EXPECT_LT((all.predict(Z).variance - without(all).predict(Z).variance - expected).cwiseAbs().maxCoeff(),
            1e-5 * expected.maxCoeff());
}

// Fits of more runs than 250 take the information of 250 of them: more is unknown than by all, never less.
TEST(ParameterUncertainty, OfManyRunsIsNoLessThanThatOfAll) {
  const MatrixXd X = reference::design(400, 2, 21);
  VectorXd y = reference::values(hill, X);
  for (Eigen::Index i = 0; i < y.size(); ++i) y[i] += 0.05 * std::cos(1e3 * static_cast<double>(i));
  FitOptions options;
  options.noise = Noise::proportional;
  options.noise_variance = VectorXd::LinSpaced(400, 0.5, 1.5);
  options.trend = Trend::linear;
  const Model model = fit(X, y, options);
  const MatrixXd& S = model.state().parameter_spread;
  ASSERT_EQ(S.cols(), 3);
  const detail::TrainingData data = detail::prepare(X, y, options);
  Likelihood all(detail::likelihood_problem(data, options));
  const MatrixXd few = S * S.transpose(),
                 full = (0.25 * MatrixXd::Identity(3, 3) - all.hessian(parameters(model, all))).inverse();
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_GE(few(k, k), full(k, k));
    EXPECT_LE(few(k, k), 4.0 * full(k, k))
        << "250 of 400 runs tell 0.6 of it, and noise is no worse than that twice";
  }
}

// Runs so far away that powers of their distance overflow: nothing is correlated with them, and all is
// finite.
TEST(ParameterUncertainty, IsFiniteFarAway) {
  const reference::Data data = runs();
  for (FitOptions options : kinds()) {
    options.lower = VectorXd::Zero(2);
    options.upper = VectorXd::Ones(2);
    options.noise = Noise::nugget;
    options.noise_variance.resize(0);
    MatrixXd X = data.X;
    X.row(7).setConstant(1e70);
    if (options.trend != Trend::constant) continue;
    EXPECT_TRUE(fit(X, data.y, options).predict(data.X).variance.allFinite());
    const Model model = fit(data.X, data.y, options);
    for (const double far : {1e60, 1e103, 1e150})
      EXPECT_TRUE(model.predict(MatrixXd::Constant(1, 2, far)).variance.allFinite()) << far;
    const Model more = append(model, MatrixXd::Constant(1, 2, 1e150), VectorXd::Zero(1));
    EXPECT_TRUE(more.predict(data.X).variance.allFinite()) << to_string(options.correlation);
  }
}
