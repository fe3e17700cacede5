// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/log/rainflow.hpp>
#include <map>
#include <numbers>

using namespace drawpoint::engine::loading;

namespace {

std::map<double, double> counts_by_range(const std::vector<CountedRange>& cycles) {
  std::map<double, double> counts;
  for (const CountedRange& cycle : cycles) counts[cycle.range] += cycle.count;
  return counts;
}

// The standard's own example, its figure 6 and table: whole numbers, so exact.
TEST(Rainflow, CountsTheExampleOfAstmE1049) {
  const std::vector<double> history{-2, 1, -3, 5, -1, 3, -4, 4, -2};
  const std::map<double, double> expected{{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1.0}, {9, 0.5}};
  EXPECT_EQ(counts_by_range(rainflow(history)), expected);
}

TEST(Rainflow, TakesTurningPointsOutOfAnySampling) {
  const std::vector<double> dense{-2, -1, -1, 0, 1, 1, 0.5, -3, 0, 2, 5, 5, -1, 3, -4, -4, 1, 4, 4, -2};
  const std::vector<double> sparse{-2, 1, -3, 5, -1, 3, -4, 4, -2};
  EXPECT_EQ(counts_by_range(rainflow(dense)), counts_by_range(rainflow(sparse)));
  EXPECT_TRUE(rainflow(std::vector<double>{}).empty());
  EXPECT_TRUE(rainflow(std::vector<double>{7, 7, 7}).empty());
}

// n periods of one amplitude, from peak to peak: n ranges of 2a down and n up, each half a cycle or paired to one.
TEST(Rainflow, ASineIsItsPeriods) {
  constexpr int periods = 25, samples = 40;
  constexpr double amplitude = 3, mean = 10;
  std::vector<double> sine;
  for (int k = 0; k <= periods * samples; ++k)
    sine.push_back(mean + amplitude * std::cos(2 * std::numbers::pi * k / samples));
  double count = 0;
  const std::vector<CountedRange> cycles = rainflow(sine);
  for (const CountedRange& cycle : cycles) {
    EXPECT_NEAR(cycle.range, 2 * amplitude, 1e-12);
    EXPECT_NEAR(cycle.mean, mean, 1e-12);
    count += cycle.count;
  }
  EXPECT_EQ(count, periods);
  EXPECT_NEAR(miner_sum(cycles, 3), periods * std::pow(2 * amplitude, 3), 1e-9 * periods * 216);
}

// A small ripple on a large swing is counted beside it and does not break it up: what counting of single ranges
// gets wrong.
TEST(Rainflow, ARippleLeavesTheSwingWhole) {
  const std::vector<CountedRange> cycles = rainflow(std::vector<double>{0, 50, 49, 100, 40, 41, 0});
  const std::map<double, double> expected{{1, 2}, {100, 1}};
  EXPECT_EQ(counts_by_range(cycles), expected);
}

}  // namespace
