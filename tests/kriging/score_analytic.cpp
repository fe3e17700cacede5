// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/score.hpp>

using namespace drawpoint::kriging;
using Eigen::VectorXd;

namespace {

// Errors −3, 0, 1, 4 around the prediction 4; standard deviations 2.
Validation example() {
  Validation v;
  v.observed = Eigen::Vector4d(1, 4, 5, 8);
  v.predicted = VectorXd::Constant(4, 4.0);
  v.variance = VectorXd::Constant(4, 3.0);
  v.observation_variance = VectorXd::Constant(4, 4.0);
  return v;
}

}  // namespace

// Σ e² = 26, range 7, mean of y 4.5 with squares 3.5² + 0.5² + 0.5² + 3.5² = 25.
TEST(Score, FollowsItsDefinitions) {
  const Validation v = example();
  EXPECT_DOUBLE_EQ(score(v, ErrorFunction::rmse), std::sqrt(6.5));
  EXPECT_DOUBLE_EQ(score(v, ErrorFunction::nrmse), std::sqrt(6.5) / 7);
  EXPECT_DOUBLE_EQ(score(v, ErrorFunction::mae), 2.0);
  EXPECT_DOUBLE_EQ(score(v, ErrorFunction::q2), 1 - 26.0 / 25.0);
  EXPECT_DOUBLE_EQ(score(v, ErrorFunction::nlpd), 0.5 * std::log(8 * 3.14159265358979323846) + 26.0 / 4 / 8);
  EXPECT_EQ(score(v, ErrorFunction::coverage), 0.75) << "4 > 1.96·2 > 3";
  EXPECT_EQ(score(v, ErrorFunction::coverage, 0.5), 0.5) << "3 > 0.674·2 > 1";
  EXPECT_EQ(score(v, ErrorFunction::coverage, 0.99), 1.0) << "2.576·2 > 4";
}

TEST(Score, HasNoValueWithoutARange) {
  Validation v = example();
  v.observed.setConstant(4.0);
  EXPECT_TRUE(std::isnan(score(v, ErrorFunction::nrmse)));
  EXPECT_TRUE(std::isnan(score(v, ErrorFunction::q2)));
}

TEST(Score, RejectsWhatIsNoShare) {
  EXPECT_THROW(score(example(), ErrorFunction::coverage, 1.0), std::invalid_argument);
  EXPECT_THROW(score({}, ErrorFunction::rmse), std::invalid_argument);
}

// Tabulated to 15 digits (Abramowitz and Stegun, and Wichura's AS 241 test values).
TEST(NormalQuantile, AgreesWithTables) {
  EXPECT_NEAR(detail::normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(detail::normal_quantile(0.25), -0.674489750196082, 1e-14);
  EXPECT_NEAR(detail::normal_quantile(0.001), -3.090232306167814, 1e-13);
  EXPECT_NEAR(detail::normal_quantile(0.5), 0.0, 1e-16);
}
