// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/pareto/crowding.hpp>
#include <numeric>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

// Points (0,8), (1,4), (3,2), (7,1), (8,0) span 8 in both objectives: the inner ones get (3-0 + 8-2)/8, (7-1
// + 4-1)/8 and (8-3 + 2-0)/8. Multiples of 1/8 are exact.
Eigen::MatrixXd five_points() {
  Eigen::MatrixXd Y(5, 2);
  Y << 0, 8, 1, 4, 3, 2, 7, 1, 8, 0;
  return Y;
}

TEST(Crowding, IsTheSumOfTheRelativeGapsAndInfiniteAtTheExtremes) {
  Eigen::VectorXd expected(5);
  expected << INFINITY, 9.0 / 8, 9.0 / 8, 7.0 / 8, INFINITY;
  EXPECT_EQ(crowding_distance(five_points()), expected);
}

TEST(Crowding, CopiesAreIgnoredAndHaveNoDistance) {
  const std::vector<int> with_copies{2, 0, 1, 2, 3, 4, 2, 0};
  Eigen::VectorXd expected(8);
  expected << 9.0 / 8, INFINITY, 9.0 / 8, 0, 7.0 / 8, INFINITY, 0, 0;
  EXPECT_EQ(crowding_distance(five_points()(with_copies, Eigen::all)), expected);
}

TEST(Crowding, ChangingUnitsChangesNothing) {
  const Eigen::MatrixXd scaled = five_points() * Eigen::Vector2d(1024.0, 0.0625).asDiagonal();
  EXPECT_EQ(crowding_distance(scaled), crowding_distance(five_points()));
}

TEST(Crowding, AnObjectiveThatAllShareDoesNotCount) {
  Eigen::MatrixXd Y(5, 3);
  Y << five_points().leftCols(1), Eigen::VectorXd::Constant(5, 3.0), five_points().rightCols(1);
  EXPECT_EQ(crowding_distance(Y), crowding_distance(five_points()));
}

TEST(Crowding, OneOrTwoDistinctPointsAreExtremes) {
  EXPECT_EQ(crowding_distance(five_points().topRows(1))[0], INFINITY);
  EXPECT_EQ(crowding_distance(five_points().topRows(2)), Eigen::VectorXd::Constant(2, INFINITY));
  EXPECT_EQ(crowding_distance(five_points()(std::vector<int>{1, 1}, Eigen::all)),
            Eigen::Vector2d(INFINITY, 0.0));
  EXPECT_EQ(crowding_distance(Eigen::MatrixXd(0, 2)).size(), 0);
}

// Copies, ties and three objectives; half of the points leave at a time.
TEST(Crowding, IsThatOfTheRestWhenPointsLeave) {
  doe::RandomStream random(5);
  Eigen::MatrixXd Y(60, 3);
  for (double& y : Y.reshaped()) y = random.below(6);
  detail::CrowdingLines lines(Y);
  std::vector<int> left(60);
  std::iota(left.begin(), left.end(), 0);
  while (!left.empty()) {
    EXPECT_EQ(lines.distances()(left), crowding_distance(Y(left, Eigen::all)));
    std::erase_if(left, [&](int) { return random.uniform() < 0.5; });
    lines.keep(left);
  }
}

}  // namespace
