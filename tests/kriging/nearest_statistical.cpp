// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Errors and intervals of fits by nearest runs, and whether the error that they report is theirs.

#include <gtest/gtest.h>

#include <drawpoint/kriging/fit_nearest.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double root_mean_square(const VectorXd& x) { return x.norm() / std::sqrt(static_cast<double>(x.size())); }

double share_held(const Prediction& p, const VectorXd& truth) {
  return ((p.mean - truth).array().abs() <= 1.96 * p.variance.array().sqrt()).cast<double>().mean();
}

}  // namespace

TEST(Nearest, SmoothFunctionOfSixInputsIsMet) {
  const MatrixXd X = reference::design(1800, 6, 1), points = reference::design(2000, 6, 2);
  const VectorXd y = reference::values(reference::circuit6, X),
                 truth = reference::values(reference::circuit6, points);
  const NearestModel model = fit_nearest(X, y, {.noise = Noise::none, .threads = 2});
  EXPECT_EQ(model.status(), Status::converged) << model.message();
  const double range = truth.maxCoeff() - truth.minCoeff();
  EXPECT_LT(root_mean_square(model.mean(points) - truth), 1e-4 * range);
}

// 2000 latent values lie close together, so the share held varies more between data sets than 0.5 %: some 2
// %.
TEST(Nearest, IntervalsOfTheLatentFunctionHold) {
  const MatrixXd X = reference::design(1800, 5, 3), points = reference::design(2000, 5, 4);
  const VectorXd truth = reference::values(reference::friedman5, points);
  doe::RandomStream random(5);
  VectorXd y = reference::values(reference::friedman5, X);
  for (double& value : y) value += random.normal();
  const NearestModel model = fit_nearest(X, y, {.threads = 2});
  EXPECT_NEAR(std::sqrt(model.noise_variance()), 1.0, 0.05);
  EXPECT_NEAR(share_held(model.predict(points), truth), 0.95, 0.05);
  EXPECT_LT(root_mean_square(model.mean(points) - truth), 0.3);
}

// The error is told from 128 points of eight cells at most; over the box it is the same within a factor of
// two.
TEST(Nearest, ErrorThatIsToldIsThatOfPredictions) {
  const MatrixXd X = reference::design(1800, 6, 1), points = reference::design(2000, 6, 2);
  const VectorXd y = reference::values(reference::hartmann6, X);
  constexpr NearestOptions own{.neighbours = 64, .neighbourhood = 100};
  const NearestModel model = fit_nearest(X, y, {.threads = 2}, own);
  NearestState doubled = model.state();
  doubled.neighbourhood = 200;
  const double change = root_mean_square(NearestModel(doubled).mean(points) - model.mean(points));
  EXPECT_GT(model.error().mean, 0.5 * change);
  EXPECT_LT(model.error().mean, 2.0 * change);
  EXPECT_NEAR(model.error().deviation, root_mean_square(model.predict(points).variance.cwiseSqrt()),
              0.3 * model.error().deviation);
  EXPECT_GT(model.error().log_density, 0.0);
}
