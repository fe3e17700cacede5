// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/acquisition_gradient.hpp>
#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using doe::Goal;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Noisy {
  MatrixXd X = reference::design(14, 2, 3);
  VectorXd y = reference::values(reference::hilly2, X);
  Noisy() {
    doe::RandomStream random(5);
    for (double& value : y) value += 0.3 * random.normal();
  }
};

Model noisy_model(bool unknown = false, Trend trend = Trend::constant) {
  const Noisy data;
  FitOptions options;
  options.trend = trend;
  options.parameter_uncertainty = unknown;
  options.nugget_lower = 1e-2;
  return fit(data.X, data.y, options);
}

/// minᵢ aᵢ − E[minᵢ (aᵢ + bᵢZ)] by the midpoint rule on [-9, 9].
double by_integration(const VectorXd& a, const VectorXd& b) {
  constexpr int steps = 18000;
  constexpr double h = 18.0 / steps;
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double z = -9 + (k + 0.5) * h;
    sum += (a + b * z).minCoeff() * detail::normal_density(z);
  }
  return a.minCoeff() - sum * h;
}

}  // namespace

// Two lines, b h(−|a|/b), and one: nothing to choose. Lines above the others at all z change nothing.
TEST(KnowledgeGradient, OfLinesHasAClosedForm) {
  const double expected = std::log(0.5 * detail::normal_improvement(-0.6));
  EXPECT_NEAR(detail::log_gain_of_lines({{1.0, 0.2}, {1.3, 0.7}}), expected, 4e-15);
  EXPECT_NEAR(detail::log_gain_of_lines({{1.3, -0.3}, {1.0, 0.2}}), expected, 4e-15);
  EXPECT_NEAR(detail::log_gain_of_lines({{1.3, 0.7}, {9.0, 0.4}, {1.0, 0.2}, {2.0, 0.2}, {1.3, 0.7}}),
              expected, 4e-15);
  EXPECT_EQ(detail::log_gain_of_lines({{1.0, 0.3}, {2.0, 0.3}}), -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(detail::log_gain_of_lines({{0.0, 0.0}, {60.0, 1.0}}), detail::log_normal_improvement(-60.0),
              1e-12);
}

// The midpoint rule errs by h²/8 = 1.3e-7 times the change of slope at the kinks, max b − min b. The joint
// covariance at all runs and x comes from Model::covariance.
TEST(KnowledgeGradient, EqualsTheIntegral) {
  const MatrixXd points = reference::design(12, 2, 8);
  for (const bool unknown : {false, true})
    for (const Trend trend : {Trend::constant, Trend::linear}) {
      const Model model = noisy_model(unknown, trend);
      const VectorXd least = knowledge_gradient(model, Goal::minimize)(points),
                     most = knowledge_gradient(model, Goal::maximize)(points);
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        MatrixXd all(15, 2);
        all << points.row(i), Noisy().X;
        const VectorXd mean = model.mean(all);
        const VectorXd b = model.covariance(all).col(0) /
                           std::sqrt(model.predict(points.row(i), Target::observation).variance[0]);
        const double tolerance = 1.5e-7 * (b.maxCoeff() - b.minCoeff());
        EXPECT_NEAR(least[i], by_integration(mean, b), tolerance);
        EXPECT_NEAR(most[i], by_integration(-mean, b), tolerance);
      }
      EXPECT_GT(least.maxCoeff(), 1e-4) << "far above the tolerance";
    }
}

// The means that a run of value μ + √(s² + λs²) z gives are μ + b z: append finds them anew. Both solve
// systems of condition below 14 · 1e2/1e-2.
TEST(KnowledgeGradient, MovesTheMeansAsARunDoes) {
  const Model model = noisy_model();
  const MatrixXd x = reference::design(3, 2, 30).topRows(1), runs = Noisy().X;
  const double deviation = std::sqrt(model.predict(x, Target::observation).variance[0]), z = 0.8;
  const Model after = append(model, x, VectorXd(model.mean(x).array() + deviation * z));
  const VectorXd b = detail::CovarianceWith(std::make_shared<const Model>(model), x)(runs) / deviation;
  EXPECT_LT((after.mean(runs) - model.mean(runs) - z * b).cwiseAbs().maxCoeff(), 1e-10);
}

// Where there is no noise a run at a run teaches nothing, and where there is noise it does.
TEST(KnowledgeGradient, AsksForARunAgainForNoiseAlone) {
  const Noisy data;
  FitOptions exact;
  exact.nugget_lower = exact.nugget_upper = 1e-10;
  exact.theta_lower = exact.theta_upper = 2.0;
  const Model sure = fit(data.X, reference::values(reference::hilly2, data.X), exact);
  exact.nugget_lower = exact.nugget_upper = 0.3;
  const Model unsure = fit(data.X, data.y, exact);
  // At a run s² is below λs²(1 + 1/4), so b is below √λ s = 1e-5 s.
  EXPECT_LE(knowledge_gradient(sure, Goal::minimize)(data.X).maxCoeff(),
            1e-5 * std::sqrt(sure.process_variance()));
  EXPECT_GT(knowledge_gradient(unsure, Goal::minimize)(data.X).maxCoeff(),
            1e-3 * std::sqrt(unsure.process_variance()));
  const Model constant = fit(data.X, VectorXd::Ones(14));
  EXPECT_EQ(knowledge_gradient(constant, Goal::minimize)(data.X), VectorXd(VectorXd::Zero(14)));
}

TEST(KnowledgeGradient, RefusesLimits) {
  EXPECT_THROW(knowledge_gradient(noisy_model(), Goal::at_most), std::invalid_argument);
  EXPECT_THROW(predicted_value(noisy_model(), Goal::at_least), std::invalid_argument);
}

TEST(PredictedValue, IsTheMeanByItsGoal) {
  const Model model = noisy_model();
  const MatrixXd points = reference::design(12, 2, 8);
  EXPECT_EQ(predicted_value(model, Goal::maximize)(points), model.mean(points));
  EXPECT_EQ(predicted_value(model, Goal::minimize)(points), VectorXd(-model.mean(points)));
}
