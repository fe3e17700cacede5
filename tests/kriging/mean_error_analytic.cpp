// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/kriging/mean_error.hpp>
#include <limits>
#include <stdexcept>

using namespace drawpoint::kriging;

namespace {

/// Errors of 3 and 4 in turn: rmse² = 12.5, range 9.
Validation example(int runs) {
  Validation v{.observed = Eigen::VectorXd::Zero(runs),
               .predicted = Eigen::VectorXd::Zero(runs),
               .variance = Eigen::VectorXd::Constant(runs, 1.0),
               .observation_variance = Eigen::VectorXd::Constant(runs, 5.0)};
  for (int i = 0; i < runs; ++i) {
    v.observed[i] = i % 2 ? 9 : 0;
    v.predicted[i] = v.observed[i] + (i % 2 ? 4 : 3);
  }
  return v;
}

}  // namespace

// χ² of 10 degrees: 3.247 and 20.483 (tables); the approximation is within 1 %, its root within 0.5 %.
TEST(MeanError, IsTheErrorOfRunsWhereThereIsNoNoise) {
  const MeanError error = mean_error(example(10));
  EXPECT_DOUBLE_EQ(error.rmse, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(error.nrmse(), std::sqrt(12.5) / 9);
  EXPECT_NEAR(error.lower, std::sqrt(12.5 * 10 / 20.483), 0.005 * error.lower);
  EXPECT_NEAR(error.upper, std::sqrt(12.5 * 10 / 3.247), 0.005 * error.upper);
  EXPECT_EQ(error.noise, 0);
  EXPECT_EQ(mean_error(example(10), {std::numeric_limits<double>::quiet_NaN()}).rmse, error.rmse);
}

// 12.5 − 4; known noise moves both ends of the square by the same 4.
TEST(MeanError, LeavesKnownNoiseOut) {
  const MeanError all = mean_error(example(10)), error = mean_error(example(10), {4.0});
  EXPECT_DOUBLE_EQ(error.rmse, std::sqrt(8.5));
  EXPECT_DOUBLE_EQ(error.noise, 2);
  EXPECT_NEAR(error.lower * error.lower, all.lower * all.lower - 4, 1e-12);
  EXPECT_NEAR(error.upper * error.upper, all.upper * all.upper - 4, 1e-12);
}

TEST(MeanError, WidensWhereNoiseIsKnownFromFewSamples) {
  const MeanError known = mean_error(example(10), {4.0}), guessed = mean_error(example(10), {4.0, 10.0});
  EXPECT_EQ(guessed.rmse, known.rmse);
  EXPECT_LT(guessed.lower, known.lower);
  EXPECT_GT(guessed.upper, known.upper);
}

TEST(MeanError, IsNoneBelowTheNoiseButHasAnUpperEnd) {
  const MeanError error = mean_error(example(10), {20.0});
  EXPECT_EQ(error.rmse, 0);
  EXPECT_EQ(error.lower, 0);
  EXPECT_GT(error.upper, 0);
}

// Two runs whose variances are 1 and 3: of mean 2 and scatter 2, 2·2·2²/2 = 8 degrees.
TEST(MeanError, CountsTheDegreesOfReportedNoise) {
  const NoiseEstimate noise = reported_noise(Eigen::Vector2d(1, 3));
  EXPECT_DOUBLE_EQ(noise.variance, 2);
  EXPECT_DOUBLE_EQ(noise.degrees, 8);
  EXPECT_TRUE(std::isinf(reported_noise(Eigen::Vector2d(2, 2)).degrees));
  EXPECT_EQ(reported_noise(Eigen::VectorXd::Constant(1, 2.0)).degrees, 1);
}

TEST(MeanError, TakesTheNoiseOfTheModel) {
  Validation v = example(10);
  EXPECT_DOUBLE_EQ(modelled_noise(v, 30).variance, 4);
  EXPECT_EQ(modelled_noise(v, 30).degrees, 30);
  v.variance[1] = v.observation_variance[1] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(modelled_noise(v, 30).variance));
  EXPECT_THROW(mean_error(Validation{}), std::invalid_argument);
}
