// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The direction numbers of Sobol' sequences in up to 1111 dimensions.
///
/// Dimension j has a primitive polynomial x^s + a_1 x^(s-1) + ... + a_(s-1) x + 1 over GF(2) and s odd
/// initial numbers m_k < 2^k (Sobol 1967). Dimensions 2 to 37, all polynomials up to degree 7, are those of
/// Joe and Kuo 2008, "Constructing Sobol sequences with better two-dimensional projections" (new-joe-kuo-6).
/// Beyond, the polynomials of degree 8 to 13 follow in rising order, found by the order of x, and the initial
/// numbers are drawn by a rule: attempt t of a dimension is a stream of random bits, and of the attempts 0 to
/// 63 the dimension takes the one with the best two-dimensional projections with those before it
/// (sobol_attempts.hpp). Cost: the polynomials some milliseconds, once per program.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <drawpoint/doe/detail/sobol_attempts.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe::detail {

inline constexpr int sobol_max_degree = 13;

/// Degree s, inner coefficients a_1..a_(s-1) of the primitive polynomial as bits, and m_1..m_s.
struct SobolDimension {
  int degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, sobol_max_degree> initial;
};

/// Dimensions 2 to 37; the first is van der Corput's sequence and needs no numbers.
inline constexpr std::array<SobolDimension, 36> sobol_dimensions{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
    {7, 7, {1, 1, 3, 13, 7, 35, 63}},
    {7, 8, {1, 3, 5, 9, 1, 25, 53}},
    {7, 14, {1, 3, 1, 13, 9, 35, 107}},
    {7, 19, {1, 3, 1, 5, 27, 61, 31}},
    {7, 21, {1, 1, 5, 11, 19, 41, 61}},
    {7, 28, {1, 3, 5, 3, 3, 13, 69}},
    {7, 31, {1, 1, 7, 13, 1, 19, 1}},
    {7, 32, {1, 3, 7, 5, 13, 19, 59}},
    {7, 37, {1, 1, 3, 9, 25, 29, 41}},
    {7, 41, {1, 3, 5, 13, 23, 1, 55}},
    {7, 42, {1, 3, 7, 3, 13, 59, 17}},
    {7, 50, {1, 3, 1, 3, 5, 53, 69}},
    {7, 55, {1, 1, 5, 5, 23, 33, 13}},
    {7, 56, {1, 1, 7, 7, 1, 61, 123}},
    {7, 59, {1, 1, 7, 9, 13, 61, 49}},
    {7, 62, {1, 3, 3, 5, 3, 55, 33}},
}};

inline constexpr int sobol_max_dimensions =
    1 + static_cast<int>(sobol_dimensions.size() + sobol_attempts.size());

/// a b modulo the polynomial of this degree; all polynomials over GF(2) as bits.
constexpr std::uint32_t polynomial_product(std::uint32_t a, std::uint32_t b, std::uint32_t polynomial,
                                           int degree) {
  std::uint32_t product = 0;
  for (; b != 0; b >>= 1) {
    if (b & 1U) product ^= a;
    a <<= 1;
    if (a >> degree & 1U) a ^= polynomial;
  }
  return product;
}

/// Whether x has the order 2^degree - 1 modulo the polynomial: the least power of it that is 1.
constexpr bool is_primitive(std::uint32_t polynomial, int degree) {
  const auto power_is_one = [&](std::uint32_t exponent) {
    std::uint32_t result = 1, base = 2;
    for (; exponent != 0; exponent >>= 1) {
      if (exponent & 1U) result = polynomial_product(result, base, polynomial, degree);
      base = polynomial_product(base, base, polynomial, degree);
    }
    return result == 1;
  };
  const std::uint32_t order = (1U << degree) - 1;
  if (!power_is_one(order)) return false;
  std::uint32_t left = order;
  for (std::uint32_t prime = 2; left > 1; ++prime) {
    if (left % prime != 0) continue;
    if (power_is_one(order / prime)) return false;
    while (left % prime == 0) left /= prime;
  }
  return true;
}

/// Attempt `attempt` at the initial numbers of dimension j (0-based): m_k is odd and below 2^k, its other
/// bits those of the k-th draw of the stream run_seed(0, j, attempt).
inline SobolDimension sobol_attempt(SobolDimension dimension, int j, int attempt) {
  RandomStream random(run_seed(0, static_cast<std::uint64_t>(j), static_cast<std::uint64_t>(attempt)));
  for (int k = 0; k < dimension.degree; ++k)
    dimension.initial[k] = 2 * static_cast<std::uint32_t>(random.below(1 << k)) + 1;
  return dimension;
}

/// Dimensions from 38 on.
inline std::vector<SobolDimension> further_sobol_dimensions() {
  std::vector<SobolDimension> all;
  auto j = static_cast<int>(sobol_dimensions.size()) + 1;
  for (int degree = sobol_dimensions.back().degree + 1; degree <= sobol_max_degree; ++degree)
    for (std::uint32_t inner = 0; inner < 1U << (degree - 1); ++inner)
      if (is_primitive(1U << degree | inner << 1 | 1U, degree)) {
        all.push_back(sobol_attempt({degree, inner, {}}, j, sobol_attempts[all.size()]));
        ++j;
      }
  return all;
}

/// j: 1 (the second dimension) to sobol_max_dimensions - 1.
inline const SobolDimension& sobol_dimension(int j) {
  static const std::vector<SobolDimension> further = further_sobol_dimensions();
  const auto place = static_cast<std::size_t>(j) - 1;
  return place < sobol_dimensions.size() ? sobol_dimensions[place] : further[place - sobol_dimensions.size()];
}

using SobolDirections = std::array<std::uint32_t, 32>;

/// v_1..v_32 each left-aligned: v_k = m_k·2^(32-k) with
/// m_k = 2 a_1 m_(k-1) ⊕ ... ⊕ 2^(s-1) a_(s-1) m_(k-s+1) ⊕ 2^s m_(k-s) ⊕ m_(k-s).
constexpr SobolDirections directions_of(const SobolDimension& dimension) {
  const auto& [s, a, m] = dimension;
  SobolDirections v{};
  for (int k = 0; k < s; ++k) v[k] = m[k] << (31 - k);
  for (int k = s; k < 32; ++k) {
    v[k] = v[k - s] ^ (v[k - s] >> s);
    for (int i = 1; i < s; ++i)
      if ((a >> (s - 1 - i)) & 1U) v[k] ^= v[k - i];
  }
  return v;
}

/// The direction numbers of dimension j, 0-based; the first is van der Corput's sequence.
inline SobolDirections sobol_directions(int j) {
  if (j > 0) return directions_of(sobol_dimension(j));
  SobolDirections v{};
  for (int k = 0; k < 32; ++k) v[k] = 1U << (31 - k);
  return v;
}

}  // namespace drawpoint::doe::detail
