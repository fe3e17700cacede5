// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <drawpoint/pareto/reference_directions.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <set>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

int binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return static_cast<int>(value + 0.5);
}

RC_GTEST_PROP(SimplexLattice, HoldsEveryMultipleOnceAndNothingElse, ()) {
  const int m = *rc::gen::inRange(1, 6), p = *rc::gen::inRange(1, 7);
  const Eigen::MatrixXd W = simplex_lattice(m, p);
  RC_ASSERT(W.rows() == binomial(p + m - 1, m - 1));
  std::set<std::vector<int>> seen;
  for (const auto& w : W.rowwise()) {
    std::vector<int> counts;
    int sum = 0;
    for (const double share : w) {
      counts.push_back(static_cast<int>(std::lround(share * p)));
      RC_ASSERT(counts.back() >= 0 && share == static_cast<double>(counts.back()) / p);
      sum += counts.back();
    }
    RC_ASSERT(sum == p);
    RC_ASSERT(seen.insert(counts).second);
  }
}

RC_GTEST_PROP(ReferenceDirections, LieOnTheSimplexAndKeepTheLimit, ()) {
  const int m = *rc::gen::inRange(1, 12), at_most = m + *rc::gen::inRange(0, 300);
  const Eigen::MatrixXd W = reference_directions(m, at_most);
  RC_ASSERT(W.rows() <= at_most);
  RC_ASSERT(W.minCoeff() >= 0.0);
  RC_ASSERT((W.rowwise().sum().array() - 1.0).abs().maxCoeff() <= m * 1e-15);  // m roundings
}

// The sizes of Deb and Jain 2014, table I: 91, 210 (one layer), 156, 275, 135 (two).
TEST(ReferenceDirections, HaveTheSizesOfThePaper) {
  EXPECT_EQ(reference_directions(3, 91).rows(), 91);
  EXPECT_EQ(reference_directions(5, 210).rows(), 210);
  EXPECT_EQ(reference_directions(8, 156).rows(), 156);
  EXPECT_EQ(reference_directions(10, 275).rows(), 275);
  EXPECT_EQ(reference_directions(15, 135).rows(), 135);
}

TEST(ReferenceDirections, BadInputIsNamed) {
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([] { reference_directions(3, 2); }),
      "pareto::reference_directions: at_most is 2 for 3 objectives; allowed is one per objective or more");
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([] { simplex_lattice(3, 0); }),
            "pareto::simplex_lattice: 3 objectives and 0 divisions; allowed is 1 or more of both");
}

}  // namespace
