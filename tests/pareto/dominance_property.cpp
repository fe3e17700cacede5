// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/tests/pareto/generators.hpp>
#include <limits>
#include <numeric>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

Eigen::MatrixXd arbitrary_points() {
  return support::whole_points(*rc::gen::inRange(0, 60), *rc::gen::inRange(1, 7), *rc::gen::inRange(1, 8));
}

/// Fronts by the definition: peel off, again and again, what nothing left dominates.
std::vector<std::vector<int>> peeled(const Eigen::MatrixXd& Y) {
  std::vector<int> left(static_cast<std::size_t>(Y.rows()));
  std::iota(left.begin(), left.end(), 0);
  std::vector<std::vector<int>> fronts;
  while (!left.empty()) {
    std::vector<int> front, rest;
    for (const int i : left) {
      const bool beaten =
          std::any_of(left.begin(), left.end(), [&](int k) { return dominates(Y.row(k), Y.row(i)); });
      (beaten ? rest : front).push_back(i);
    }
    fronts.push_back(front);
    left = rest;
  }
  return fronts;
}

RC_GTEST_PROP(Dominance, IsAStrictOrder, ()) {
  const Eigen::MatrixXd Y = support::whole_points(3, *rc::gen::inRange(1, 5), 3);
  RC_ASSERT(!dominates(Y.row(0), Y.row(0)));
  RC_ASSERT(!(dominates(Y.row(0), Y.row(1)) && dominates(Y.row(1), Y.row(0))));
  if (dominates(Y.row(0), Y.row(1)) && dominates(Y.row(1), Y.row(2)))
    RC_ASSERT(dominates(Y.row(0), Y.row(2)));
}

RC_GTEST_PROP(NonDominatedSort, IsPeelingByTheDefinition, ()) {
  const Eigen::MatrixXd Y = arbitrary_points();
  RC_ASSERT(non_dominated_sort(Y) == peeled(Y));
}

RC_GTEST_PROP(NonDominated, IsTheFirstFront, ()) {
  const Eigen::MatrixXd Y = arbitrary_points();
  RC_ASSERT(non_dominated(Y) == (Y.rows() == 0 ? std::vector<int>{} : peeled(Y).front()));
}

RC_GTEST_PROP(NonDominatedSort, OrderOfTheRowsDoesNotMatter, ()) {
  const Eigen::MatrixXd Y = arbitrary_points();
  const std::vector<int> rows = support::shuffled_rows(Y.rows());
  auto fronts = non_dominated_sort(Y(rows, Eigen::all));
  for (auto& front : fronts) {
    for (int& i : front) i = rows[i];
    std::sort(front.begin(), front.end());
  }
  RC_ASSERT(fronts == non_dominated_sort(Y));
}

// More points than 16 bits have ranks for take the wider ones. 33 000 points x with x_4 = 1 - x_1 are one
// front; 300 of them with 20 added to all are another, behind it, and every rank of the last objective
// differs.
TEST(NonDominatedSort, RanksOfMoreThanSixteenBits) {
  const int n = 33000;
  Eigen::MatrixXd Y(n, 4);
  for (int i = 0; i < n; ++i) {
    const double x = static_cast<double>(i) / n;
    Y.row(i) = Eigen::RowVector4d(x, i % 7, i % 5, 1.0 - x).array() + (i < 300 ? 20.0 : 0.0);
  }
  const auto fronts = non_dominated_sort(Y);
  ASSERT_EQ(fronts.size(), 2u);
  EXPECT_EQ(fronts[1].size(), 300u);
  EXPECT_EQ(fronts[1].front(), 0);
  EXPECT_EQ(fronts[0].front(), 300);
}

TEST(NonDominatedSort, TakesInfinityAndRefusesNaN) {
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd Y(3, 3), wide(3, 4);
  Y << infinity, 0, 0, infinity, 0, 1, -infinity, 5, 5;
  EXPECT_EQ(non_dominated_sort(Y), (std::vector<std::vector<int>>{{0, 2}, {1}}));
  wide << Y, Y.col(0);
  EXPECT_EQ(non_dominated_sort(wide), non_dominated_sort(Y));
  Y(1, 1) = std::nan("");
  EXPECT_THROW(non_dominated_sort(Y), std::invalid_argument);
  EXPECT_THROW(non_dominated(Y), std::invalid_argument);
}

}  // namespace
