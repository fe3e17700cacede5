// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <numeric>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

std::uint64_t leading_bits(double u, int bits) { return static_cast<std::uint64_t>(std::ldexp(u, bits)); }

/// Whether each elementary interval of 2^-bits[j] in variable j holds the same number of the rows
/// first..first+count-1.
bool equidistributed(const Eigen::MatrixXd& X, const std::vector<int>& bits, Eigen::Index first,
                     Eigen::Index count) {
  const int total = std::accumulate(bits.begin(), bits.end(), 0);
  std::vector<Eigen::Index> held(std::size_t{1} << total, 0);
  for (Eigen::Index i = first; i < first + count; ++i) {
    std::uint64_t cell = 0;
    for (std::size_t j = 0; j < bits.size(); ++j)
      cell = cell << bits[j] | leading_bits(X(i, static_cast<Eigen::Index>(j)), bits[j]);
    ++held[cell];
  }
  for (const Eigen::Index h : held)
    if (h != count >> total) return false;
  return true;
}

// Dimensions 1 and 2 form a (0, 2)-sequence: every block of 2^m points is a (0, m, 2)-net, and Owen's
// scrambling keeps nets.
TEST(ScrambledSobol, TheFirstTwoVariablesFormANet) {
  constexpr int m = 10;
  const Eigen::MatrixXd X = scrambled_sobol(support::unit_problem(2), 3 << m, {.seed = 7});
  for (int block = 0; block < 3; ++block)
    for (int k = 0; k <= m; ++k)
      EXPECT_TRUE(equidistributed(X, {k, m - k}, block << m, 1 << m)) << "block " << block << ", split " << k;
}

// Sobol's property A, which Joe and Kuo's numbers have in every prefix of the dimensions: of 2^d points each
// of the 2^d halves-of-each-variable boxes holds one. A single wrong direction number below bit d breaks it
// with probability 1/2 or more.
TEST(ScrambledSobol, PropertyAHoldsInEveryNumberOfVariables) {
  for (int d = 1; d <= 16; ++d) {
    const Eigen::MatrixXd X =
        scrambled_sobol(support::unit_problem(d), 1 << d, {.seed = static_cast<Seed>(d)});
    EXPECT_TRUE(equidistributed(X, std::vector<int>(static_cast<std::size_t>(d), 1), 0, 1 << d))
        << d << " variables";
  }
}

/// Rank over GF(2) of the matrix with these rows.
int binary_rank(std::vector<std::uint64_t> rows) {
  int rank = 0;
  for (int bit = 63; bit >= 0; --bit)
    for (std::size_t i = static_cast<std::size_t>(rank); i < rows.size(); ++i) {
      if (!(rows[i] >> bit & 1U)) continue;
      std::swap(rows[i], rows[static_cast<std::size_t>(rank)]);
      for (std::size_t k = 0; k < rows.size(); ++k)
        if (k != static_cast<std::size_t>(rank) && rows[k] >> bit & 1U)
          rows[k] ^= rows[static_cast<std::size_t>(rank)];
      ++rank;
      break;
    }
  return rank;
}

// The same for all dimensions without their 2^37 points: property A in d variables means that the d x d
// matrix of the first digits of the first d direction numbers is regular over GF(2).
TEST(SobolDirections, PropertyAHoldsUpToTheLastDimension) {
  for (int d = 1; d <= 32; ++d) {
    std::vector<std::uint64_t> first_digits;
    for (int j = 0; j < d; ++j) {
      std::uint64_t row = 0;
      const detail::SobolDirections v = detail::sobol_directions(j);
      for (int k = 0; k < d; ++k) row = row << 1 | v[k] >> 31;
      first_digits.push_back(row);
    }
    EXPECT_EQ(binary_rank(first_digits), d) << d << " dimensions";
  }
}

/// Order of x modulo the polynomial x^s + ... + 1: 2^s - 1 exactly when it is primitive.
int order_of_x(std::uint32_t polynomial, int degree) {
  std::uint32_t power = 1;
  for (int order = 1;; ++order) {
    power <<= 1;
    if (power >> degree & 1U) power ^= polynomial;
    if (power == 1) return order;
    if (order > 1 << degree) return 0;
  }
}

TEST(SobolDirections, PolynomialsArePrimitiveAndDifferAndNumbersAreOddAndSmall) {
  std::vector<std::uint32_t> seen;
  for (const auto& [degree, coefficients, initial] : detail::sobol_dimensions) {
    const std::uint32_t polynomial = 1U << degree | coefficients << 1 | 1U;
    EXPECT_EQ(order_of_x(polynomial, degree), (1 << degree) - 1) << "polynomial " << polynomial;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), polynomial), 0);
    seen.push_back(polynomial);
    for (int k = 0; k < degree; ++k) {
      EXPECT_EQ(initial[k] % 2, 1U);
      EXPECT_LT(initial[k], 2U << k);
    }
  }
}

// With f = Π (1 + (x_j - 1/2)) the exact mean is 1. For independent points the error has standard deviation
// sqrt(((13/12)^5 - 1)/n) = 0.011 at n = 4096; a scrambled net of smooth f does far better, so a tenth of it
// is asked for.
TEST(ScrambledSobol, IntegratesASmoothFunctionBetterThanRandomPoints) {
  const Eigen::MatrixXd X = scrambled_sobol(support::unit_problem(5), 4096, {.seed = 3});
  const double mean = (X.array() + 0.5).rowwise().prod().mean();
  const double random_error = std::sqrt((std::pow(13.0 / 12.0, 5) - 1.0) / 4096.0);
  EXPECT_LT(std::abs(mean - 1.0), 0.1 * random_error);
}

}  // namespace
