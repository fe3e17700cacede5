// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/benchmarks/scenario/estimate.hpp>

using namespace drawpoint::benchmarks;

// Tabulated quantiles, rounded to 5e-4; the series beyond ten degrees of freedom is good to 0.2 %.
TEST(Estimate, StudentsT) {
  EXPECT_DOUBLE_EQ(t_975(4), 2.776);
  EXPECT_NEAR(t_975(11), 2.201, 0.002 * 2.201);
  EXPECT_NEAR(t_975(30), 2.042, 0.002 * 2.042);
  EXPECT_NEAR(t_975(1000000), 1.960, 5e-4);
  EXPECT_TRUE(std::isinf(t_975(0)));
}

// 1, 2, 3, 4, 5: mean 3, s² = 10/4, s/√n = √0.5.
TEST(Estimate, IntervalOfTheMean) {
  const Estimate e = estimate({1, 2, 3, 4, 5});
  EXPECT_DOUBLE_EQ(e.mean, 3);
  EXPECT_NEAR(e.half_width, 2.776 * std::sqrt(0.5), 1e-14);
  EXPECT_EQ(estimate({7}).mean, 7);
  EXPECT_TRUE(std::isinf(estimate({7}).half_width));
}

TEST(Estimate, PairsCancelWhatTheyShare) {
  const Estimate e = paired_difference({101, 1001, 10001}, {100, 1000, 10000});
  EXPECT_DOUBLE_EQ(e.mean, 1);
  EXPECT_DOUBLE_EQ(e.half_width, 0);
}

TEST(Estimate, BlocksLeaveOutTheIncompleteOne) {
  EXPECT_EQ(block_means({1, 3, 5, 7, 100}, 2), (std::vector<double>{2, 6}));
  EXPECT_TRUE(block_means({1}, 2).empty());
}

TEST(Estimate, PercentileIsTheNearestRank) {
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.5), 2);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.95), 4);
}
