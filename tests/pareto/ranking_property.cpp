// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// The ranking of a population that one point joins, from that of the others, against the sort of the whole.

#include <gtest/gtest.h>

#include <drawpoint/doe/seed.hpp>
#include <drawpoint/pareto/detail/newcomer.hpp>
#include <numeric>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

/// Points of whole numbers with copies; one limit, met.
detail::Population population(const Eigen::MatrixXd& Y) {
  detail::Population p{Y, Y, Y, Eigen::MatrixXd::Zero(Y.rows(), 1), {}};
  p.failed.assign(static_cast<std::size_t>(Y.rows()), 0);
  return p;
}

const Eigen::RowVectorXd largest = Eigen::RowVectorXd::Ones(1);

Eigen::MatrixXd whole_points(int n, int m, int values, doe::RandomStream& random) {
  Eigen::MatrixXd Y(n, m);
  for (double& y : Y.reshaped()) y = random.below(values);
  return Y;
}

/// p: feasible points and the newcomer.
void expect_the_sort(const detail::Population& p) {
  std::vector<int> others(static_cast<std::size_t>(p.size()) - 1);
  std::iota(others.begin(), others.end(), 0);
  const detail::Ranking before = detail::rank(detail::selected(p, others), largest);
  const detail::Ranking sorted = detail::rank(p, largest), quick = detail::rank_with_newcomer(p, before);
  EXPECT_EQ(quick.fronts, sorted.fronts);
  EXPECT_EQ(quick.feasible, sorted.feasible);
}

// Few values make copies and, with one objective, many fronts. The newcomer reaches beyond the others: it
// dominates some or all, is dominated, neither, a copy; beyond the limit; failed.
TEST(Ranking, WithANewcomerIsThatOfTheSort) {
  doe::RandomStream random(3);
  for (int m = 1; m <= 4; ++m)
    for (int trial = 0; trial < 300; ++trial) {
      const Eigen::MatrixXd Y = whole_points(20, m, 6, random);
      const Eigen::MatrixXd newcomer = whole_points(1, m, 8, random).array() - 1.0;
      detail::Population p = population(detail::stacked(Y, newcomer));
      expect_the_sort(p);
      p.violations(p.size() - 1, 0) = 0.5;
      expect_the_sort(p);
      p.failed.back() = 1;
      expect_the_sort(p);
    }
}

/// All fronts but the last that has room, of which some stay.
std::vector<int> survivors(const detail::Ranking& ranking, std::size_t places, doe::RandomStream& random) {
  std::vector<int> rows;
  for (std::vector<int> front : ranking.fronts) {
    while (front.size() > places - rows.size())
      front.erase(front.begin() + random.below(static_cast<int>(front.size())));
    rows.insert(rows.end(), front.begin(), front.end());
  }
  return rows;
}

TEST(Ranking, OfSurvivorsIsThatOfTheirSort) {
  doe::RandomStream random(4);
  for (int m = 1; m <= 4; ++m)
    for (int trial = 0; trial < 100; ++trial) {
      const detail::Population p = population(whole_points(30, m, 6, random));
      const detail::Ranking ranking = detail::rank(p, largest);
      const std::vector<int> rows =
          survivors(ranking, 1 + static_cast<std::size_t>(random.below(30)), random);
      const auto left = detail::ranking_of_survivors(ranking, rows, p.size());
      ASSERT_TRUE(left);
      const detail::Ranking sorted = detail::rank(detail::selected(p, rows), largest);
      EXPECT_EQ(left->fronts, sorted.fronts);
      EXPECT_EQ(left->feasible, sorted.feasible);
    }
}

// In one objective 0, 1, 2 are three fronts; without 1 its dominated 2 rises.
TEST(Ranking, OfSurvivorsIsUnknownWhereOneMayHaveRisenOrIsNotFeasible) {
  detail::Population p = population(Eigen::Vector3d(0, 1, 2));
  const detail::Ranking ranking = detail::rank(p, largest);
  EXPECT_TRUE(detail::ranking_of_survivors(ranking, {0, 1}, 3));
  EXPECT_FALSE(detail::ranking_of_survivors(ranking, {0, 2}, 3));
  EXPECT_FALSE(
      detail::ranking_of_survivors(detail::rank(population(Eigen::Vector3d::Zero()), largest), {1, 0}, 3));
  p.violations(2, 0) = 0.5;
  EXPECT_FALSE(detail::ranking_of_survivors(detail::rank(p, largest), {0, 1, 2}, 3));
}

}  // namespace
