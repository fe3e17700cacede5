// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Surrogates of different kinds in one set, as a comparison of fits leaves them: searched, polished and
/// drawn.
///
/// |x - a|² is fitted by a Kriging model and |x - b|² by a polynomial, both exact for a quadratic response:
/// the Pareto set is the segment from a to b.

#include <gtest/gtest.h>

#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/polynomial.hpp>
#include <drawpoint/pareto/draws.hpp>
#include <drawpoint/pareto/non_domination.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/polish.hpp>
#include <drawpoint/tests/doe/problems.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

const Eigen::Vector3d a(0.2, 0.3, 0.5), b(0.8, 0.6, 0.4);
const doe::Problem problem = support::unit_problem(3, 2);

using Set = std::vector<kriging::AnySurrogate>;

/// The means at once for a whole population.
struct Means {
  const Set& set;

  std::vector<doe::Outcome> operator()(const Eigen::MatrixXd& X, std::span<const doe::Seed>) const {
    Eigen::MatrixXd Y(X.rows(), static_cast<Eigen::Index>(set.size()));
    for (std::size_t j = 0; j < set.size(); ++j) Y.col(static_cast<Eigen::Index>(j)) = set[j].mean(X);
    std::vector<doe::Outcome> outcomes;
    for (Eigen::Index i = 0; i < Y.rows(); ++i) outcomes.emplace_back(Eigen::VectorXd(Y.row(i).transpose()));
    return outcomes;
  }
};

/// The means with their slopes by central differences, for kinds without gradients.
struct Slopes {
  const Set& set;

  pareto::ValueAndJacobian operator()(const Eigen::VectorXd& x) const {
    constexpr double step = 1e-5;
    const Eigen::Index d = x.size();
    Eigen::MatrixXd X = x.transpose().replicate(2 * d + 1, 1);
    X.topRows(d).diagonal().array() += step;
    X.middleRows(d, d).diagonal().array() -= step;
    pareto::ValueAndJacobian y{Eigen::VectorXd(set.size()), Eigen::MatrixXd(set.size(), d)};
    for (std::size_t j = 0; j < set.size(); ++j) {
      const Eigen::VectorXd means = set[j].mean(X);
      const auto row = static_cast<Eigen::Index>(j);
      y.values[row] = means[2 * d];
      y.jacobian.row(row) = (means.head(d) - means.segment(d, d)).transpose() / (2.0 * step);
    }
    return y;
  }
};

/// Means and standard deviations.
struct Predictions {
  const Set& set;

  pareto::PredictedResponses operator()(const Eigen::MatrixXd& X) const {
    pareto::PredictedResponses p{Eigen::MatrixXd(X.rows(), set.size()),
                                 Eigen::MatrixXd(X.rows(), set.size())};
    for (std::size_t j = 0; j < set.size(); ++j) {
      const kriging::Prediction one = set[j].predict(X);
      p.mean.col(static_cast<Eigen::Index>(j)) = one.mean;
      p.deviation.col(static_cast<Eigen::Index>(j)) = one.variance.cwiseMax(0.0).cwiseSqrt();
    }
    return p;
  }
};

static_assert(doe::BatchFunction<Means>);
static_assert(pareto::DifferentiableFunction<Slopes>);
static_assert(pareto::PredictiveFunction<Predictions>);

Set fitted() {
  const Eigen::MatrixXd X = doe::latin_hypercube(problem, 40);
  Eigen::VectorXd near_a(X.rows()), near_b(X.rows());
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    near_a[i] = (X.row(i).transpose() - a).squaredNorm();
    near_b[i] = (X.row(i).transpose() - b).squaredNorm();
  }
  kriging::FitOptions options;
  options.trend = kriging::Trend::quadratic;
  return {kriging::fit(X, near_a, options), kriging::fit_polynomial(X, near_b)};
}

double distance_to_segment(const Eigen::Vector3d& x) {
  const double along = (x - a).dot(b - a) / (b - a).squaredNorm();
  return (x - a - std::clamp(along, 0.0, 1.0) * (b - a)).norm();
}

// The slopes are those of the quadratics to about 1e-10 (rounding 1e-16 over a step of 1e-5, and the fits'
// own), so that the certificate of 1e-6 bounds the distance as in front_analytic.cpp: by 2e-6.
TEST(MixedSurrogates, AreSearchedAndPolished) {
  const Set set = fitted();
  const pareto::Front front = pareto::nsga2(
      Means{set}, problem, {.search = {.population = 40, .stopping = {.generations = 60}, .seed = 3}});
  ASSERT_EQ(front.X.rows(), 40);
  const pareto::Polished polished = pareto::polish(Slopes{set}, problem, front);
  EXPECT_EQ(polished.status, pareto::PolishStatus::completed) << polished.message;
  int certified = 0;
  for (Eigen::Index i = 0; i < polished.front.X.rows(); ++i) {
    if (polished.residual[i] > 1e-6) continue;
    ++certified;
    EXPECT_LE(distance_to_segment(polished.front.X.row(i).transpose()), 2e-6);
  }
  EXPECT_GT(certified, 20);
}

// Both fits are exact, so the draws hardly differ from the means: of the points of a front every one is on it
// in nearly every draw.
TEST(MixedSurrogates, AreDrawn) {
  const Set set = fitted();
  Eigen::MatrixXd X(5, 3);
  for (int i = 0; i < 5; ++i) X.row(i) = (a + 0.25 * i * (b - a)).transpose();
  const pareto::Draws draws = pareto::draws_at(Predictions{set}, X, {.draws = 64});
  ASSERT_EQ(draws.size(), 64u);
  EXPECT_NEAR(draws[0](0, 0), 0.0, 1e-4);
  EXPECT_GT(pareto::probability_non_dominated(problem, draws).probability.minCoeff(), 0.95);
}

}  // namespace
