// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/pareto/indicators.hpp>
#include <drawpoint/tests/doe/problems.hpp>

namespace drawpoint::pareto {
namespace {

Eigen::MatrixXd points(std::initializer_list<std::pair<double, double>> list) {
  Eigen::MatrixXd Y(static_cast<Eigen::Index>(list.size()), 2);
  Eigen::Index i = 0;
  for (const auto& [a, b] : list) Y.row(i++) << a, b;
  return Y;
}

// From (0,4) the nearest of Y is (3,4), 3 away, of which all is worse; from (4,0) it is (4,0) itself: the
// mean of 3 and 0. (0,0) is 4 from (4,0) and 5 from (3,4).
TEST(Igd, IsTheMeanDistanceFromTheReference) {
  const Eigen::MatrixXd Y = points({{3, 4}, {4, 0}});
  EXPECT_EQ(igd(Y, points({{0, 4}, {4, 0}})), 1.5);
  EXPECT_EQ(igd(Y, points({{0, 0}})), 4.0);
}

// Y = (3,4) against z = (6,0): the difference (-3, 4) counts 5 in igd, and 4 in igd_plus, for being better by
// 3 is no loss.
TEST(IgdPlus, CountsOnlyWhatIsWorse) {
  EXPECT_EQ(igd(points({{3, 4}}), points({{6, 0}})), 5.0);
  EXPECT_EQ(igd_plus(points({{3, 4}}), points({{6, 0}})), 4.0);
  EXPECT_EQ(igd_plus(points({{3, 4}}), points({{3, 5}, {4, 4}})), 0.0);
}

// To cover (1,5) the point (2,6) has to shift by 1, the point (4,4) by 3; to cover (4,1) the one needs 5, the
// other 3: the larger of 1 and 3. As factors: max(2, 6/5) = 2 and 4 for (1,5); 6 and max(1, 4) = 4 for (4,1).
TEST(Epsilon, IsTheLeastShiftOrFactorThatCoversTheReference) {
  const Eigen::MatrixXd Y = points({{2, 6}, {4, 4}}), Z = points({{1, 5}, {4, 1}});
  EXPECT_EQ(additive_epsilon(Y, Z), 3.0);
  EXPECT_EQ(multiplicative_epsilon(Y, Z), 4.0);
  EXPECT_EQ(additive_epsilon(Z, Z), 0.0);
  EXPECT_EQ(multiplicative_epsilon(Z, Z), 1.0);
  EXPECT_EQ(additive_epsilon(Z.array() - 0.5, Z), -0.5);
}

// Points on the line (0,12) - (12,0) at x = 0, 3, 4, 12: gaps √2·(3, 1, 8), mean √2·4, deviations √2·(1, 3,
// 4). With the ends met: 8/(3·4). With the reference's ends √2·3 beyond: (3 + 3 + 8)/(3 + 3 + 12). The budget
// is a few roundings of numbers below 20.
TEST(Spread, IsDebsDelta) {
  const Eigen::MatrixXd Y = points({{4, 8}, {0, 12}, {12, 0}, {3, 9}});
  EXPECT_NEAR(spread(Y, points({{0, 12}, {12, 0}})), 8.0 / 12.0, 1e-15);
  EXPECT_NEAR(spread(Y, points({{-3, 15}, {15, -3}})), 14.0 / 18.0, 1e-15);
  EXPECT_NEAR(spread(points({{0, 2}, {1, 1}, {2, 0}}), points({{0, 2}, {2, 0}})), 0.0, 1e-15);
}

// Points (0,8), (1,4), (3,2), (7,1), (8,0): finite crowding distances 9/8, 9/8, 7/8 (crowding_analytic.cpp):
// mean 25/24, variance (2·(2/24)² + (4/24)²)/3 = 1/72. The extremes moved by 5 in each objective: from (3,12)
// to (0,8) and from (12,3) to (8,0).
TEST(MovingSpread, IsThatOfGamultiobj) {
  const Eigen::MatrixXd Y = points({{0, 8}, {1, 4}, {3, 2}, {7, 1}, {8, 0}});
  const double deviation = std::sqrt(1.0 / 72.0), way = 5.0 * 25.0 / 24.0;
  EXPECT_NEAR(moving_spread(Y, Y), deviation / way, 1e-15);
  EXPECT_NEAR(moving_spread(Y, points({{3, 12}, {12, 3}})), (10.0 + deviation) / (10.0 + way), 1e-15);
}

TEST(Indicators, BadInputIsNamed) {
  const auto text = [](const auto& indicator, const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
    return support::thrown_text<std::invalid_argument>([&] { indicator(Y, Z); });
  };
  const Eigen::MatrixXd two = Eigen::MatrixXd::Ones(2, 2), three = Eigen::MatrixXd::Ones(2, 3);
  EXPECT_EQ(text(igd, Eigen::MatrixXd(0, 2), two), "pareto::igd: Y has no rows; give at least one point");
  EXPECT_EQ(text(igd_plus, two, three),
            "pareto::igd_plus: Y has 2 columns, Z has 3; both need one an objective");
  EXPECT_EQ(text(additive_epsilon, two, NAN * two),
            "pareto::additive_epsilon: Z holds NaN or infinity; leave out failed runs");
  EXPECT_EQ(text(multiplicative_epsilon, -two, two),
            "pareto::multiplicative_epsilon: Y holds -1; allowed is above 0; shift the objectives or use "
            "additive_epsilon");
  EXPECT_EQ(text(spread, three, three),
            "pareto::spread: Y is 2 x 3; allowed is two objectives and two points or more; use "
            "crowding_distance or moving_spread for others");
}

}  // namespace
}  // namespace drawpoint::pareto
