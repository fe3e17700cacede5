// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Laws of the lexicographic order that sorting by dominance and crowding rest on, against std::sort.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/pareto/detail/ordered_points.hpp>
#include <limits>
#include <numeric>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

std::vector<int> compared_order(const Eigen::MatrixXd& Y) {
  std::vector<int> rows(static_cast<std::size_t>(Y.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  std::sort(rows.begin(), rows.end(), [&](int a, int b) {
    for (Eigen::Index j = 0; j < Y.cols(); ++j)
      if (Y(a, j) != Y(b, j)) return Y(a, j) < Y(b, j);
    return a < b;
  });
  return rows;
}

/// n x m of `levels` values about 0, both zeros among them.
Eigen::MatrixXd levelled(int n, int m, int levels, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::MatrixXd Y(n, m);
  for (double& y : Y.reshaped())
    y = (random.below(levels) - levels / 2) * 0.1 * (random.uniform() < 0.5 ? -1.0 : 1.0);
  return Y;
}

// Few and many rows, no ties, some, nothing else: each of the three ways of sorting is taken.
TEST(OrderedPoints, AreInLexicographicOrderAndEqualOnesByIndex) {
  for (const int n : {0, 1, 2, 5, 63, 64, 65, 200, 1000})
    for (const int m : {0, 1, 2, 3, 5})
      for (const int levels : {1, 3, 40, 1000, 1000000}) {
        const Eigen::MatrixXd Y = levelled(n, m, levels, static_cast<doe::Seed>(n + 7 * m + levels));
        EXPECT_EQ(detail::sorted_points(Y).order, compared_order(Y)) << n << " " << m << " " << levels;
      }
}

TEST(OrderedPoints, BitsRiseWithTheNumber) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<double> rising{-infinity, -1e300, -1.0, -1.0 + 1e-16, -1e-300, -tiny,   0.0,
                                   tiny,      1e-300, 1.0,  1.0 + 3e-16,  1e300,   infinity};
  for (std::size_t i = 1; i < rising.size(); ++i)
    EXPECT_LT(detail::rising_bits(rising[i - 1]), detail::rising_bits(rising[i])) << rising[i];
  EXPECT_EQ(detail::rising_bits(0.0), detail::rising_bits(-0.0));
}

}  // namespace
