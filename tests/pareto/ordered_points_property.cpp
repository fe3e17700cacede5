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

// Keys of three ways of sorting (63, 64 to 511, and more rows): spread evenly, over many powers of ten, close
// together far from a single other one, which leaves all but that to the insertion, and few values.
TEST(SortByKey, IsTheStableSort) {
  for (const int n : {1, 63, 64, 101, 511, 512, 2000})
    for (int kind = 0; kind < 4; ++kind) {
      doe::RandomStream random(static_cast<doe::Seed>(10 * n + kind));
      std::vector<detail::KeyedRow> rows;
      for (int i = 0; i < n; ++i) {
        const double u = random.uniform() - 0.5;
        const double lone = i == n / 2 ? -1e200 : 1.0 + 1e-9 * u;
        const double value = kind == 0   ? u
                             : kind == 1 ? std::pow(u, 99)
                             : kind == 2 ? lone
                                         : std::round(5.0 * u);
        rows.push_back({detail::rising_bits(value), i});
      }
      std::vector<detail::KeyedRow> expected = rows;
      std::stable_sort(expected.begin(), expected.end(),
                       [](const auto& a, const auto& b) { return a.key < b.key; });
      detail::sort_by_key(rows);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i].row, expected[i].row) << n << " " << kind;
        const bool tie = i > 0 && rows[i].key == rows[i - 1].key;
        ASSERT_EQ(tie, i > 0 && expected[i].key == expected[i - 1].key);
      }
    }
}

}  // namespace
