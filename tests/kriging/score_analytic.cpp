// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/kriging/score.hpp>
#include <limits>
#include <numbers>
#include <random>

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

// Gneiting, Raftery 2007, eq. 21: a standard normal prediction scores 2φ(0) − 1/√π = 0.2337 of its deviation
// at its own mean, and |t| − 1/√π far away.
TEST(Score, RanksANormalPrediction) {
  Validation v = example();
  v.observed = Eigen::Vector2d(4, 84);
  v.predicted = VectorXd::Constant(2, 4.0);
  v.observation_variance = VectorXd::Constant(2, 4.0);
  const double at_mean = 2 / std::sqrt(2 * std::numbers::pi) - 1 / std::sqrt(std::numbers::pi);
  EXPECT_NEAR(score(v, ErrorFunction::crps), 0.5 * 2 * (at_mean + 40 - 1 / std::sqrt(std::numbers::pi)),
              1e-12);
  v.observation_variance.setZero();
  EXPECT_DOUBLE_EQ(score(v, ErrorFunction::crps), 40.0) << "the absolute error of a sure prediction";
}

// Lognormal: y(2Φ(w) − 1) − 2e^(m + s²/2)(Φ(w − s) + Φ(s/√2) − 1), w = (ln y − m)/s (Baran, Lerch 2015, QJRMS
// 141). Midpoints of 200 levels: inside, h²/24 of second derivatives, 1e-6; in the cell of y, where the loss
// has a kink, h²/8 dq/dp, 1e-5; the last cell, whose quantiles grow like e^(s√(2 ln 1/p)), is missed by a
// tenth of its own part, which is h times the quantile there, 0.005·e^(2.8) of some 0.5 weighted by h/2: 1e-3
// for s = 1.
TEST(Score, RanksALognormalPrediction) {
  Validation v;
  v.transform = {Scale::logarithm, 0, 0, 0};
  for (const double s : {0.3, 1.0})
    for (const double y : {0.2, 1.0, 5.0}) {
      const double m = 0.4, w = (std::log(y) - m) / s;
      v.observed = VectorXd::Constant(1, y);
      v.scaled_mean = VectorXd::Constant(1, m);
      v.scaled_variance = VectorXd::Constant(1, s * s);
      v.predicted = VectorXd::Constant(1, std::exp(m));
      const double exact =
          y * (2 * detail::normal_probability(w) - 1) -
          2 * std::exp(m + s * s / 2) *
              (detail::normal_probability(w - s) + detail::normal_probability(s / std::numbers::sqrt2) - 1);
      EXPECT_NEAR(score(v, ErrorFunction::crps) / exact, 1, 1e-3) << s << " " << y;
      // Density of the lognormal distribution.
      EXPECT_NEAR(score(v, ErrorFunction::nlpd),
                  std::log(y * s) + 0.5 * std::log(2 * std::numbers::pi) + 0.5 * w * w, 1e-12);
    }
}

// A square root has a part of its distribution on the bound, a logarithm nothing: what cannot be is
// infinitely unlikely, and never a perfect score.
TEST(Score, KnowsBounds) {
  Validation v;
  v.observed = v.predicted = VectorXd::Zero(1);
  v.scaled_mean = v.scaled_variance = VectorXd::Ones(1);
  v.transform = {Scale::square_root, 0, 0, 0};
  EXPECT_NEAR(score(v, ErrorFunction::nlpd), -std::log(detail::normal_probability(-1.0)), 1e-14);
  v.transform = {Scale::logarithm, 0, 0, 0};
  EXPECT_EQ(score(v, ErrorFunction::nlpd), std::numeric_limits<double>::infinity());
  v.transform = {Scale::logit, 0, 1, 0.1, 0};
  EXPECT_TRUE(std::isfinite(score(v, ErrorFunction::nlpd)));
  v.observed[0] = 1;
  EXPECT_EQ(score(v, ErrorFunction::nlpd), std::numeric_limits<double>::infinity());
  v.observed[0] = -0.5;
  EXPECT_EQ(score(v, ErrorFunction::nlpd), std::numeric_limits<double>::infinity());
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
