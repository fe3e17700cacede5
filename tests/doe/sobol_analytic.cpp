// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/doe/sobol_projections.hpp>
#include <numeric>
#include <set>
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

// There are φ(2^s - 1)/s primitive polynomials of degree s, each used once.
TEST(SobolDirections, PolynomialsArePrimitiveAndAllOfTheirDegree) {
  std::set<std::uint32_t> seen;
  std::vector<int> of_degree(detail::sobol_max_degree + 1, 0);
  for (int j = 1; j < detail::sobol_max_dimensions; ++j) {
    const auto& [degree, coefficients, initial] = detail::sobol_dimension(j);
    const std::uint32_t polynomial = 1U << degree | coefficients << 1 | 1U;
    ASSERT_EQ(order_of_x(polynomial, degree), (1 << degree) - 1) << "polynomial " << polynomial;
    EXPECT_TRUE(seen.insert(polynomial).second);
    ++of_degree[static_cast<std::size_t>(degree)];
  }
  EXPECT_EQ(of_degree, (std::vector<int>{0, 1, 1, 2, 2, 6, 6, 18, 16, 48, 60, 176, 144, 630}));
}

// v_k has its lowest digit at place k: then the generating matrix is upper triangular with ones on its
// diagonal, so regular, and so is its m x m corner for every m: each variable alone is a (0, 1)-sequence.
TEST(SobolDirections, GeneratingMatricesAreRegular) {
  for (int j = 0; j < detail::sobol_max_dimensions; ++j) {
    const detail::SobolDirections v = detail::sobol_directions(j);
    for (int k = 0; k < 32; ++k) ASSERT_EQ(std::countr_zero(v[k]), 31 - k) << "dimension " << j + 1;
  }
}

TEST(ScrambledSobol, EveryVariableAloneIsANet) {
  constexpr int m = 9;
  const int d = detail::sobol_max_dimensions;
  const Eigen::MatrixXd X = scrambled_sobol(support::unit_problem(d), 2 << m, {.seed = 5});
  for (int j = 0; j < d; ++j)
    for (int block = 0; block < 2; ++block)
      ASSERT_TRUE(equidistributed(X.col(j), {m}, block << m, 1 << m)) << "variable " << j + 1;
}

// The hash of the numbers of Joe and Kuo as version 24fb1a3 had them: designs stay the same bit for bit.
TEST(SobolDirections, OfTheFirst37DimensionsAreThoseOfJoeAndKuo) {
  std::uint64_t hash = 0;
  for (int j = 0; j < 37; ++j)
    for (const std::uint32_t v : detail::sobol_directions(j)) hash = detail::mix(hash ^ v);
  EXPECT_EQ(hash, 0x6fc56b78085d2fcbULL);
}

std::vector<support::GeneratingRows> rows_of_dimensions(int d) {
  std::vector<support::GeneratingRows> rows;
  for (int j = 0; j < d; ++j) rows.push_back(support::generating_rows(detail::sobol_directions(j)));
  return rows;
}

// The rule by which the numbers were chosen, anew: the first dimensions, some in the middle, the last.
TEST(SobolDirections, AreTheAttemptsOfLeastCost) {
  const auto rows = rows_of_dimensions(detail::sobol_max_dimensions);
  for (const int j : {37, 38, 39, 40, 60, 99, 359, 700, 1110})
    EXPECT_EQ(support::best_sobol_attempt({rows.begin(), rows.begin() + j}, j),
              detail::sobol_attempts[static_cast<std::size_t>(j) - 37])
        << "dimension " << j + 1;
}

// t by its definition: the points of each elementary box are counted.
TEST(SobolProjections, TValuesAreThoseOfTheCountedBoxes) {
  constexpr int m = 8;
  const Eigen::MatrixXd X = scrambled_sobol(support::unit_problem(120), 1 << m, {.seed = 11});
  const auto rows = rows_of_dimensions(120);
  for (int j = 1; j < 120; j += 7) {
    const Eigen::MatrixXd pair = X(Eigen::all, std::vector<int>{j - 1, j});
    int t = 0;
    for (int k = m; k > 0; --k)  // boxes of area 2^-k
      for (int i = 0; i <= k; ++i)
        if (!equidistributed(pair, {i, k - i}, 0, 1 << m)) t = std::max(t, m - k + 1);
    EXPECT_EQ(support::t_value(rows[static_cast<std::size_t>(j) - 1], rows[static_cast<std::size_t>(j)], m),
              t);
  }
}

/// 12 Σ_j (x_j - 1/2)(x_(j+1) - 1/2), by row.
Eigen::VectorXd sum_of_neighbour_products(const Eigen::MatrixXd& X) {
  const Eigen::ArrayXXd centred = X.array() - 0.5;
  return 12.0 * (centred.leftCols(X.cols() - 1) * centred.rightCols(X.cols() - 1)).rowwise().sum().matrix();
}

/// Most of the expected squared error of one product over 2^-m, that of independent points. Digit k of x -
/// 1/2 has the variance 4^-k/4, so digits k and l of the two factors have 9·4^-(k+l) of the product's
/// variance 1. Scrambling a (t, m, 2)-net leaves no error of those with k + l <= m - t, and of others 2^(t+1)
/// times that of independent points at most (Owen 1998; Pan, Owen 2023: 2^(t+s-1) for digital nets).
double most_of_a_product(int t, int m) {
  double left = 0.0;
  for (int sum = std::max(m - t + 1, 2); sum < 60; ++sum) left += 9.0 * (sum - 1) * std::pow(4.0, -sum);
  return std::min(std::ldexp(left, t + 1), std::ldexp(1.0, t + 1));
}

// The exact mean is 0 and the products are uncorrelated, so that the expected squared error of independent
// points is (d - 1)/n, and that of scrambled ones at most the sum of the bounds of the products. Over 16
// scrambles the mean of squares is some χ²(16)/16 of its expectation: beyond 4 with probability 1e-9. The
// bound itself is below a tenth of that of independent points in all three.
TEST(ScrambledSobol, IntegratesProductsOfNeighboursInManyDimensions) {
  constexpr int m = 10, scrambles = 16;
  for (const int d : {50, 100, 360}) {
    const auto rows = rows_of_dimensions(d);
    double most = 0.0, squares = 0.0;
    for (std::size_t j = 1; j < rows.size(); ++j)
      most += most_of_a_product(support::t_value(rows[j - 1], rows[j], m), m);
    for (int s = 1; s <= scrambles; ++s) {
      const Eigen::MatrixXd X =
          scrambled_sobol(support::unit_problem(d), 1 << m, {.seed = static_cast<Seed>(s)});
      squares += std::pow(sum_of_neighbour_products(X).mean(), 2) / scrambles;
    }

    EXPECT_LT(most / (d - 1), 0.1) << d << " variables";
    EXPECT_LT(squares, 4.0 * most / (1 << m)) << d << " variables";
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
