// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The figures that decide findings, on numbers whose answers are known. Round-off of a few terms: 1e-12.

#include <drawpoint/studies/loading/statistics/finding_statistics.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace drawpoint::studies;
using Eigen::VectorXd;

namespace {

constexpr double round_off = 1e-12;

VectorXd values(std::initializer_list<double> list) {
  return Eigen::Map<const VectorXd>(list.begin(), static_cast<Eigen::Index>(list.size()));
}

TEST(FindingStatistics, AnEffectIsThereOrNotOrUnclear) {
  EXPECT_EQ(verdict_of({"e", {0.5, 0.2}}), Verdict::reproduced);
  EXPECT_EQ(verdict_of({"e", {0.3, 0.2}}), Verdict::unclear);
  EXPECT_EQ(verdict_of({"e", {-0.5, 0.2}}), Verdict::not_reproduced);
  EXPECT_EQ(verdict_of({"e", {0.05, 0.01}, 0.1}), Verdict::not_reproduced);  // there, but too small to matter
  EXPECT_EQ(verdict_of({"e", {}}), Verdict::unclear);
}

TEST(FindingStatistics, AFindingNeedsAllOfItsEffects) {
  const Criterion holds{"a", {1, 0.1}}, fails{"b", {-1, 0.1}}, open{"c", {0.1, 0.1}}, unknown{"d", {}};
  EXPECT_EQ(decided("F", "c", {holds, holds}).verdict, Verdict::reproduced);
  EXPECT_EQ(decided("F", "c", {holds, open}).verdict, Verdict::unclear);
  EXPECT_EQ(decided("F", "c", {open, fails}).verdict, Verdict::not_reproduced);
  EXPECT_EQ(decided("F", "c", {fails, open}).verdict, Verdict::not_reproduced);
  EXPECT_EQ(decided("F", "c", {holds, unknown}).grounds,
            "a: 1 ± 0.2, reproduced; d: too few runs, or nothing to compare with");
}

// Ranks 1 2 3 4 5 against 1 3 2 5 4: 1 − 6 Σd²/(n (n² − 1)) = 1 − 24/120. Ties share their mean rank.
TEST(FindingStatistics, RankCorrelation) {
  const Estimate r = rank_correlation(values({1, 2, 3, 4, 50}), values({0, 2, 1, 9, 8}));
  EXPECT_NEAR(r.value, 0.8, round_off);
  EXPECT_DOUBLE_EQ(r.error, 0.5);
  EXPECT_NEAR(rank_correlation(values({1, 1, 2, 2, 2}), values({3, 3, 7, 7, 7})).value, 1, round_off);
  EXPECT_TRUE(std::isnan(rank_correlation(values({1, 2, 3, 4}), values({1, 2, 3, 4})).value));
  EXPECT_TRUE(std::isnan(rank_correlation(values({1, 2, 3, 4, 5}), values({1, 1, 1, 1, 1})).value));
}

// 0, 1 .. 1000 about their median: 500 ± 2 · 238.5, where 2.3 % end; one draw that is farther off changes nothing.
TEST(FindingStatistics, AnEstimateIsTheMedianOfDraws) {
  std::vector<double> draws(1001);
  for (std::size_t k = 0; k < draws.size(); ++k) draws[k] = static_cast<double>(k);
  EXPECT_DOUBLE_EQ(estimate_of(draws).value, 500);
  EXPECT_DOUBLE_EQ(estimate_of(draws).error, 0.5 * (500 - 23));
  draws.back() = 1e9;
  EXPECT_DOUBLE_EQ(estimate_of(draws).error, 0.5 * (500 - 23));
}

// Errors reach as far on both sides as on the longer one: squares of 0 .. 10 have 25 and 100.
TEST(FindingStatistics, AnEstimateOfSkewedDrawsIsUnsureToTheLongerSide) {
  std::vector<double> draws;
  for (int k = 0; k <= 10; ++k) draws.push_back(k * k);
  EXPECT_DOUBLE_EQ(estimate_of(draws).error, 0.5 * (100 - 25));
}

TEST(FindingStatistics, DrawsThatAreNoNumbersLeaveAnEstimateOpen) {
  std::vector<double> draws(100, 1.0);
  draws[0] = std::nan("");
  EXPECT_EQ(estimate_of(draws).value, 1);
  std::fill(draws.begin(), draws.begin() + 6, std::nan(""));
  EXPECT_TRUE(std::isnan(estimate_of(draws).value));
  EXPECT_TRUE(std::isnan(estimate_of({}).value));
}

/// 18 points, 6 in each third of [0, 3]; y is the third's number plus or minus `scatter`.
VectorXd steps(double scatter) {
  VectorXd y(18);
  for (int i = 0; i < 18; ++i) y[i] = i / 6 + (i % 2 == 0 ? scatter : -scatter);
  return y;
}
VectorXd places() { return VectorXd::LinSpaced(18, 0.05, 2.95); }

// Variance between the thirds Σ 6 (0, 1, 2 less 1)² = 12, within 18 scatter².
TEST(FindingStatistics, ThirdsAndWhatTheyExplain) {
  EXPECT_LT((means_of_thirds(places(), steps(0.5), 0, 3) - Eigen::Vector3d(0, 1, 2)).norm(), round_off);
  EXPECT_NEAR(explained_share(places(), steps(0.5), 0, 3), 12 / (12 + 18 * 0.25), round_off);
  EXPECT_NEAR(deviation_of(steps(0.5)), std::sqrt((12 + 18 * 0.25) / 18), round_off);
  EXPECT_TRUE(std::isnan(explained_share(places(), VectorXd::Ones(18), 0, 3)));
}

// 0 2 1 3: 2 and 1 are pooled to 1.5, residual 0.5 of 5.
TEST(FindingStatistics, RisingResidual) {
  EXPECT_NEAR(rising_residual(values({1, 2, 3, 4}), values({0, 2, 1, 3})), 0.1, round_off);
  EXPECT_NEAR(rising_residual(values({4, 3, 2, 1}), values({9, 5, 5, 1})), 0, round_off);
  EXPECT_NEAR(rising_residual(values({1, 2, 3}), values({3, 2, 1})), 1, round_off);
}

// The middles of n strata are 1/(2n) from uniform; all at one end are 1 from it.
TEST(FindingStatistics, DistanceFromUniform) {
  EXPECT_NEAR(distance_from_uniform(values({0.125, 0.875, 0.375, 0.625}), 0, 1), 0.25, round_off);
  EXPECT_NEAR(distance_from_uniform(VectorXd::Constant(4, 2), 0, 2), 2, round_off);
}

}  // namespace
