// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <drawpoint/pareto/detail/elitism.hpp>
#include <numeric>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

int total(const std::vector<int>& counts) { return std::accumulate(counts.begin(), counts.end(), 0); }

std::vector<int> arbitrary_sizes() { return *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 40)); }

RC_GTEST_PROP(Elitism, EveryPlaceIsGivenOnceAndNoFrontGetsMoreThanItHas, ()) {
  const std::vector<int> sizes = arbitrary_sizes();
  const int places = *rc::gen::inRange(0, 300);
  const std::vector<int> taken = elitist_places(sizes, places, *rc::gen::inRange(0, 100) / 100.0);
  RC_ASSERT(total(taken) == std::min(places, total(sizes)));
  for (std::size_t i = 0; i < sizes.size(); ++i) RC_ASSERT(taken[i] >= 0 && taken[i] <= sizes[i]);
}

RC_GTEST_PROP(Elitism, RatioZeroTakesTheBestFrontsWhole, ()) {
  const std::vector<int> sizes = arbitrary_sizes();
  int left = *rc::gen::inRange(0, 300);
  const std::vector<int> taken = elitist_places(sizes, left, 0.0);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    RC_ASSERT(taken[i] == std::min(left, sizes[i]));
    left -= taken[i];
  }
}

// Fronts that can fill their quotas get N (1-r)/(1-r^K) r^(i-1) places each, to the rounding of a half place,
// and the last and the first what the roundings leave, at most a half place a front.
RC_GTEST_PROP(Elitism, LargeFrontsShareGeometrically, ()) {
  const int K = *rc::gen::inRange(1, 9), places = *rc::gen::inRange(1, 1000);
  const double ratio = *rc::gen::inRange(1, 100) / 100.0;
  const std::vector<int> taken =
      elitist_places(std::vector<int>(static_cast<std::size_t>(K), places), places, ratio);
  for (int i = 0; i < K; ++i) {
    const double quota = places * (1.0 - ratio) / (1.0 - std::pow(ratio, K)) * std::pow(ratio, i);
    RC_ASSERT(std::abs(taken[static_cast<std::size_t>(i)] - quota) <= 0.5 * K + 1e-9);
  }
}

// N = 100, r = 0.65, K = 3: quotas 48.25, 31.36, 20.38. The first front has 10 points only, so 38 places pass
// on to the second, which takes 31 + 38 = 69; the third takes its 20; the one place that rounding left goes
// to the best front with points to spare, the second.
TEST(Elitism, WhatAFrontCannotFillPassesOn) {
  EXPECT_EQ(elitist_places({10, 200, 200}, 100, 0.65), (std::vector<int>{10, 70, 20}));
}

// The fronts behind the first are too small for their quotas; the rest comes back to the first.
TEST(Elitism, WhatIsLeftIsFilledFromTheBestFront) {
  EXPECT_EQ(elitist_places({200, 3, 2}, 100, 0.65), (std::vector<int>{95, 3, 2}));
}

RC_GTEST_PROP(ParetoFraction, EveryPlaceIsGivenAndTheBestFrontGetsMoreThanItsShareOnlyForWantOfOthers, ()) {
  const std::vector<int> sizes = arbitrary_sizes();
  const int places = *rc::gen::inRange(0, 300);
  const double fraction = *rc::gen::inRange(1, 101) / 100.0;
  const std::vector<int> taken = fraction_places(sizes, places, fraction);
  RC_ASSERT(total(taken) == std::min(places, total(sizes)));
  for (std::size_t i = 0; i < sizes.size(); ++i) RC_ASSERT(taken[i] >= 0 && taken[i] <= sizes[i]);
  if (!sizes.empty() && taken[0] > std::ceil(fraction * places))
    RC_ASSERT(std::equal(taken.begin() + 1, taken.end(), sizes.begin() + 1));
}

// 35 of 100 places for the best front, the second whole, the rest to the third; with small fronts behind, the
// best fills up.
TEST(ParetoFraction, IsTheShareOfTheBestFront) {
  EXPECT_EQ(fraction_places({80, 40, 80}, 100, 0.35), (std::vector<int>{35, 40, 25}));
  EXPECT_EQ(fraction_places({80, 10, 5}, 100, 0.35), (std::vector<int>{80, 10, 5}));
  EXPECT_EQ(fraction_places({20, 90}, 100, 0.35), (std::vector<int>{20, 80}));
}

}  // namespace
