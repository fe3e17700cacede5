// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/pareto/crowding.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/indicators.hpp>
#include <drawpoint/tests/doe/problems.hpp>

using namespace drawpoint;
using namespace drawpoint::pareto;

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
// other 3: the larger of 1 and 3.
TEST(Epsilon, IsTheLeastShiftThatCoversTheReference) {
  const Eigen::MatrixXd Y = points({{2, 6}, {4, 4}}), Z = points({{1, 5}, {4, 1}});
  EXPECT_EQ(additive_epsilon(Y, Z), 3.0);
  EXPECT_EQ(additive_epsilon(Z, Z), 0.0);
  EXPECT_EQ(additive_epsilon(Z.array() - 0.5, Z), -0.5);
}

/// Production is maximised, damage minimised; mass is only recorded.
const doe::Problem loading{{{"x", "1", 0.0, 1.0}},
                           {{"production", "kg/s", doe::Goal::maximize},
                            {"mass", "t", doe::Goal::record},
                            {"damage", "s", doe::Goal::minimize}}};

// Within production above 0 and damage below 5 the points (100, 1) and (250, 2) dominate 100·4 + 150·3; each
// loses what the other does not cover, 100·1 and 150·3; (90, 3) lies behind both.
TEST(Signs, VolumesInNaturalSigns) {
  const Eigen::MatrixXd Y = points({{100, 1}, {250, 2}, {90, 3}});
  EXPECT_EQ(hypervolume(loading, Y, Eigen::Vector2d(0, 5)), 850.0);
  EXPECT_EQ(hypervolume_contributions(loading, Y, Eigen::Vector2d(0, 5)), Eigen::Vector3d(100, 450, 0));
}

TEST(Signs, DominanceInNaturalSigns) {
  const Eigen::MatrixXd Y = points({{100, 1}, {250, 2}, {90, 3}});
  EXPECT_EQ(non_dominated(loading, Y), (std::vector<int>{0, 1}));
  EXPECT_EQ(non_dominated_sort(loading, Y), (std::vector<std::vector<int>>{{0, 1}, {2}}));
  EXPECT_TRUE(dominates(loading, Eigen::Vector2d(100, 1), Eigen::Vector2d(90, 3)));
  EXPECT_FALSE(dominates(loading, Eigen::Vector2d(90, 3), Eigen::Vector2d(100, 1)));
  EXPECT_EQ(crowding_distance(loading, Y.topRows(2)), crowding_distance(Y.topRows(2)));
}

// (3, 4) misses (6, 4) by 3 of production alone, and gives nothing for being better.
TEST(Signs, DistancesInNaturalSigns) {
  EXPECT_EQ(igd(loading, points({{3, 4}}), points({{6, 0}})), 5.0);
  EXPECT_EQ(igd_plus(loading, points({{3, 4}}), points({{6, 4}})), 3.0);
  EXPECT_EQ(igd_plus(loading, points({{6, 4}}), points({{3, 4}})), 0.0);
  EXPECT_EQ(additive_epsilon(loading, points({{3, 4}}), points({{6, 4}})), 3.0);
}

TEST(Signs, MinimisedIsItsOwnInverse) {
  const Eigen::MatrixXd Y = points({{100, 1}, {250, 2}});
  EXPECT_EQ(minimised(loading, Y), points({{-100, 1}, {-250, 2}}));
  EXPECT_EQ(minimised(loading, minimised(loading, Y)), Y);
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([] { minimised(loading, Eigen::MatrixXd::Zero(1, 3)); }),
      "pareto::minimised: Y has 3 columns, the problem has 2 objectives; give one column per objective");
}

TEST(Indicators, BadInputIsNamed) {
  const auto text = [](const auto& indicator, const Eigen::MatrixXd& Y, const Eigen::MatrixXd& Z) {
    return support::thrown_text<std::invalid_argument>([&] { indicator(Y, Z); });
  };
  const Eigen::MatrixXd two = Eigen::MatrixXd::Ones(2, 2), three = Eigen::MatrixXd::Ones(2, 3);
  const auto of_igd = [](const auto& Y, const auto& Z) { return igd(Y, Z); };
  const auto of_igd_plus = [](const auto& Y, const auto& Z) { return igd_plus(Y, Z); };
  const auto of_epsilon = [](const auto& Y, const auto& Z) { return additive_epsilon(Y, Z); };
  EXPECT_EQ(text(of_igd, Eigen::MatrixXd(0, 2), two), "pareto::igd: Y has no rows; give at least one point");
  EXPECT_EQ(text(of_igd_plus, two, three),
            "pareto::igd_plus: Y has 2 columns, Z has 3; both need one per objective");
  EXPECT_EQ(text(of_epsilon, two, NAN * two),
            "pareto::additive_epsilon: Z holds NaN or infinity; leave out failed runs");
}

}  // namespace
