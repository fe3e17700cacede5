// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Scrambled Sobol points: low discrepancy, and unbiased because each point alone is uniform.
///
/// Sobol 1967 with the direction numbers of Joe and Kuo 2008, "Constructing Sobol sequences with better
/// two-dimensional projections" (new-joe-kuo-6, first 37 dimensions), 32 bits. Scrambling is Owen's 1995
/// nested uniform one: bit k of a coordinate is flipped by a random bit that depends on the variable and on
/// the k-1 bits above it; below bit 32 the digits are random. A scrambled (t, m, d)-net is again one: of the
/// first 2^m runs, every one of 2^m equal strata of any variable holds exactly one. Best with runs = 2^m; any
/// number is allowed. Run i does not depend on `runs`. Cost O(32 n d) hashes.

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

namespace detail {

/// Degree s, inner coefficients of the primitive polynomial as bits, and m_1..m_s of one dimension.
struct SobolDimension {
  int degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 7> initial;
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

inline constexpr int sobol_max_dimensions = static_cast<int>(sobol_dimensions.size()) + 1;

using SobolDirections = std::array<std::uint32_t, 32>;

/// v_1..v_32 of dimension j (0-based), each left-aligned: v_k = m_k·2^(32-k) with
/// m_k = 2 a_1 m_(k-1) ⊕ ... ⊕ 2^(s-1) a_(s-1) m_(k-s+1) ⊕ 2^s m_(k-s) ⊕ m_(k-s).
constexpr SobolDirections sobol_directions(int j) {
  SobolDirections v{};
  if (j == 0) {
    for (int k = 0; k < 32; ++k) v[k] = 1U << (31 - k);
    return v;
  }
  const auto& [s, a, m] = sobol_dimensions[j - 1];
  for (int k = 0; k < s; ++k) v[k] = m[k] << (31 - k);
  for (int k = s; k < 32; ++k) {
    v[k] = v[k - s] ^ (v[k - s] >> s);
    for (int i = 1; i < s; ++i)
      if ((a >> (s - 1 - i)) & 1U) v[k] ^= v[k - i];
  }
  return v;
}

/// Owen's scrambling of one coordinate; `key` is the variable's own.
constexpr double owen_scrambled(std::uint32_t digits, std::uint64_t key) {
  std::uint32_t scrambled = 0;
  std::uint64_t node = 1;  // the digits above, behind a leading one that tells how many they are
  for (int bit = 31; bit >= 0; --bit) {
    const std::uint32_t digit = (digits >> bit) & 1U;
    const auto flip = static_cast<std::uint32_t>(mix(key + node * golden_gamma) >> 63);
    scrambled |= (digit ^ flip) << bit;
    node = node << 1 | digit;
  }
  const std::uint64_t below = mix(key + node * golden_gamma) >> 32;
  return to_unit(std::uint64_t{scrambled} << 32 | below);
}

}  // namespace detail

struct ScrambledSobolOptions {
  Seed seed = 1;
};

/// runs x d. Throws std::invalid_argument when runs < 1 or the problem has more than 37 variables.
inline Eigen::MatrixXd scrambled_sobol(const Problem& problem, int runs,
                                       const ScrambledSobolOptions& options = {}) {
  detail::check_design("doe::scrambled_sobol", problem, runs);
  const auto d = static_cast<int>(problem.variables.size());
  if (d > detail::sobol_max_dimensions)
    throw std::invalid_argument("doe::scrambled_sobol: the problem has " + std::to_string(d) +
                                " variables; allowed is up to " +
                                std::to_string(detail::sobol_max_dimensions) + "; use latin_hypercube");
  Eigen::MatrixXd U(runs, d);
  for (int j = 0; j < d; ++j) {
    const detail::SobolDirections v = detail::sobol_directions(j);
    const std::uint64_t key = run_seed(options.seed, static_cast<std::uint64_t>(j), 0);
    std::uint32_t digits = 0;
    for (int i = 0; i < runs; ++i) {
      if (i > 0) digits ^= v[std::countr_zero(static_cast<std::uint32_t>(i))];  // Gray code order
      U(i, j) = detail::owen_scrambled(digits, key);
    }
  }
  return detail::to_natural(std::move(U), problem);
}

}  // namespace drawpoint::doe
