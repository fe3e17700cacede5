// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Scatter of cycles about run and number, on tables whose answers are known. Round-off of a few terms: 1e-12.

#include <drawpoint/studies/loading/statistics/cycle_scatter.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace drawpoint::studies;

namespace {

constexpr double round_off = 1e-12;

// What is a sum of run and number has no scatter, whichever cycles a run lacks.
TEST(CycleScatter, SumsOfRunAndNumberHaveNone) {
  CycleScatter scatter;
  scatter.add({1, 2, 3}, {7.2, 6.0, 5.5});
  scatter.add({1, 3}, {17.2, 15.5});
  scatter.add({2, 3}, {3.0, 2.5});
  scatter.add({2}, {40});
  EXPECT_EQ(scatter.degrees(), 4 - 2);
  EXPECT_NEAR(scatter.variance(), 0, round_off);
}

// Of two cycles the second less the first is 1, 2 and 6: mean 3, Σ (d − 3)²/2 = 7 over 3 − 1 degrees.
TEST(CycleScatter, OfTwoCyclesIsThatOfTheirDifferences) {
  CycleScatter scatter;
  scatter.add({1, 2}, {0, 1});
  scatter.add({1, 2}, {10, 12});
  scatter.add({1, 2}, {-3, 3});
  EXPECT_EQ(scatter.degrees(), 2);
  EXPECT_NEAR(scatter.variance(), 3.5, round_off);
}

// Only one run has a third cycle, so that its value says nothing of noise.
TEST(CycleScatter, ANumberOfOneRunTakesADegreeOfFreedom) {
  CycleScatter scatter;
  scatter.add({1, 2}, {0, 1});
  scatter.add({1, 2}, {0, 3});
  scatter.add({1, 2, 3}, {0, 2, 90});
  EXPECT_EQ(scatter.degrees(), 4 - 2);
  EXPECT_NEAR(scatter.variance(), 0.5 * (1 + 1 + 0) / 2, round_off);
}

TEST(CycleScatter, OneRunOrOneCycleKnowsNone) {
  CycleScatter one_run, one_cycle;
  one_run.add({1, 2, 3}, {1, 5, 2});
  one_cycle.add({1}, {1});
  one_cycle.add({1}, {3});
  EXPECT_EQ(one_run.degrees(), 0);
  EXPECT_EQ(one_cycle.degrees(), 0);
  EXPECT_TRUE(std::isnan(one_run.variance()) && std::isnan(one_cycle.variance()));
}

}  // namespace
