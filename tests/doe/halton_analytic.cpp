// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/halton.hpp>
#include <drawpoint/doe/quality.hpp>
#include <drawpoint/tests/doe/designs.hpp>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

// Digits mirrored by hand: 1/2, 1/4, 3/4, 1/8, 5/8 and 1/3, 2/3, 1/9, 4/9, 7/9. Sums of at most three terms.
TEST(Halton, PlainPointsAreMirroredDigits) {
  const Eigen::MatrixXd X = halton(support::unit_problem(2), 5, {.kind = HaltonKind::plain});
  Eigen::MatrixXd expected(5, 2);
  expected << 1 / 2., 1 / 3., 1 / 4., 2 / 3., 3 / 4., 1 / 9., 1 / 8., 4 / 9., 5 / 8., 7 / 9.;
  EXPECT_LE((X - expected).cwiseAbs().maxCoeff(), 4e-16);
}

TEST(Halton, BasesArePrimes) {
  for (const auto& [index, prime] : {std::pair{0, 2}, {1, 3}, {5, 13}, {24, 97}, {99, 541}})
    EXPECT_EQ(detail::nth_prime(index), prime);
}

/// Whether the rows first..first+b^k-1 of u meet each of b^k strata once.
bool one_per_stratum(const Eigen::VectorXd& u, int strata, Eigen::Index first) {
  std::vector<int> held(static_cast<std::size_t>(strata), 0);
  for (Eigen::Index i = first; i < first + strata; ++i)
    ++held[static_cast<std::size_t>(
        std::floor(u[i] * strata * (1.0 + 1e-14)))];  // a sum of digits may end an ulp low
  return std::all_of(held.begin(), held.end(), [](int count) { return count == 1; });
}

// In base b every block of b^k runs that starts at a multiple of b^k meets each of b^k strata once; permuting
// digits place by place keeps that.
TEST(Halton, EveryBlockMeetsEachStratumOnce) {
  const Eigen::MatrixXd X = halton(support::unit_problem(4), 4 * 343, {.seed = 8});
  for (int block = 0; block < 4; ++block) {
    EXPECT_TRUE(one_per_stratum(X.col(0), 256, 256 * block));
    EXPECT_TRUE(one_per_stratum(X.col(1), 243, 243 * block));
    EXPECT_TRUE(one_per_stratum(X.col(2), 125, 125 * block));
    EXPECT_TRUE(one_per_stratum(X.col(3), 343, 343 * block));
  }
}

// With bases 59 to 71 fifty plain runs only rise, all variables alike. Scrambled, two of the four columns
// correlate as little as independent ones: their correlation has standard deviation 1/7, and 0.7 is five of
// them.
TEST(Halton, ScramblingBreaksTheCorrelationOfLargeBases) {
  const Problem problem = support::unit_problem(20);
  const auto correlation = [&](HaltonKind kind) {
    return largest_correlation(halton(problem, 50, {.seed = 3, .kind = kind}).rightCols(4));
  };
  EXPECT_GT(correlation(HaltonKind::plain), 0.95);
  EXPECT_LT(correlation(HaltonKind::scrambled), 0.7);
}

// With f = Π (1 + (x_j - 1/2)) the exact mean is 1; independent points of this number have a standard error
// of sqrt(((13/12)^5 - 1)/4096) = 0.011, and a fifth of it is asked for.
TEST(Halton, IntegratesASmoothFunctionBetterThanRandomPoints) {
  const Eigen::MatrixXd X = halton(support::unit_problem(5), 4096, {.seed = 3});
  const double random_error = std::sqrt((std::pow(13.0 / 12.0, 5) - 1.0) / 4096.0);
  EXPECT_LT(std::abs((X.array() + 0.5).rowwise().prod().mean() - 1.0), 0.2 * random_error);
}

TEST(Halton, TooManyVariablesAreRefused) {
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([] { halton(support::unit_problem(101), 8); }),
            "doe::halton: the problem has 101 variables; allowed is up to 100; use latin_hypercube");
}

}  // namespace
