// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// The ranking of a population that one point joins, against the sort of the whole.

#include <gtest/gtest.h>

#include <drawpoint/doe/seed.hpp>
#include <drawpoint/pareto/detail/population.hpp>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

/// Points of whole numbers with copies; one limit, met.
detail::Population population(const Eigen::MatrixXd& Y) {
  detail::Population p{Y, Y, Y, Eigen::MatrixXd::Zero(Y.rows(), 1), {}};
  p.failed.assign(static_cast<std::size_t>(Y.rows()), 0);
  return p;
}

void expect_the_sort(const detail::Population& p) {
  const Eigen::RowVectorXd largest = Eigen::RowVectorXd::Ones(1);
  const detail::Ranking sorted = detail::rank(p, largest), quick = detail::rank_with_newcomer(p);
  EXPECT_EQ(quick.fronts, sorted.fronts);
  EXPECT_EQ(quick.feasible, sorted.feasible);
}

// Dominated, dominating some or all, neither, a copy; beyond the limit; failed.
TEST(Ranking, WithANewcomerIsThatOfTheSort) {
  doe::RandomStream random(3);
  for (int m = 1; m <= 4; ++m)
    for (int trial = 0; trial < 300; ++trial) {
      Eigen::MatrixXd Y(20, m);
      for (double& y : Y.reshaped()) y = random.below(6);
      Eigen::RowVectorXd newcomer(m);
      for (double& y : newcomer) y = random.below(8) - 1;
      detail::Population p = population(detail::stacked(Y(non_dominated(Y), Eigen::all), newcomer));
      expect_the_sort(p);
      p.violations(p.size() - 1, 0) = 0.5;
      expect_the_sort(p);
      p.failed.back() = 1;
      expect_the_sort(p);
    }
}

}  // namespace
