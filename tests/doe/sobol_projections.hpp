// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How even the two-dimensional projections of a Sobol' sequence are, by their t-values.
///
/// The first 2^m points in two dimensions are a (t, m, 2)-net: each elementary box of area 2^(t-m) holds 2^t
/// of them; t is the least such number, from 0 to m - 1. Over GF(2), with C_1 and C_2 the generating matrices
/// (row i: the i-th digit of each of the first m direction numbers), m - t is the largest k for which the
/// first i rows of C_1 and k - i rows of C_2 are independent for every i (Niederreiter 1992, theorem 4.28).

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <drawpoint/doe/detail/sobol_directions.hpp>
#include <vector>

namespace drawpoint::support {

constexpr int projected_digits = 16;

/// Row i: digit i of the first 16 direction numbers, bit k of the k-th. Upper triangular, the diagonal 1.
using GeneratingRows = std::array<std::uint32_t, projected_digits>;

inline GeneratingRows generating_rows(const doe::detail::SobolDirections& v) {
  GeneratingRows rows{};
  for (int i = 0; i < projected_digits; ++i)
    for (int k = 0; k < projected_digits; ++k) rows[i] |= (v[k] >> (31 - i) & 1U) << k;
  return rows;
}

/// How many rows of b are independent of each other and of the first i of a, up to m - i, all cut to m
/// columns.
inline int independent_rows(const GeneratingRows& a, const GeneratingRows& b, int i, int m) {
  const std::uint32_t columns = (1U << m) - 1;
  GeneratingRows with_lowest{};  // by their lowest bit; row k of a has it at k
  for (int k = 0; k < i; ++k) with_lowest[k] = a[k] & columns;
  for (int k = 0; k < m - i; ++k) {
    std::uint32_t row = b[k] & columns;
    while (row != 0 && with_lowest[std::countr_zero(row)] != 0) row ^= with_lowest[std::countr_zero(row)];
    if (row == 0) return k;
    with_lowest[std::countr_zero(row)] = row;
  }
  return m - i;
}

inline int t_value(const GeneratingRows& a, const GeneratingRows& b, int m) {
  int k = m;
  for (int i = 0; i <= m; ++i) k = std::min(k, i + independent_rows(a, b, i, m));
  return m - k;
}

/// Of a dimension behind others, the nearest last: Σ_i w_i Σ_m 4^t, m = 4, 6, ..., 16, w_i = 1/(how many
/// dimensions ago). Above `enough` the sum is given up.
inline double projection_cost(const std::vector<GeneratingRows>& before, const GeneratingRows& rows,
                              double enough) {
  double cost = 0.0;
  for (std::size_t ago = 1; ago <= before.size() && cost < enough; ++ago) {
    double sum = 0.0;
    for (int m = 4; m <= projected_digits; m += 2)
      sum += std::ldexp(1.0, 2 * t_value(before[before.size() - ago], rows, m));
    cost += sum / static_cast<double>(ago);
  }
  return cost;
}

inline constexpr int sobol_attempts_tried = 64;

/// The attempt of least cost for dimension j, the first of equals; before: rows of dimensions 0..j-1.
inline int best_sobol_attempt(const std::vector<GeneratingRows>& before, int j) {
  int best = 0;
  double least = 1e300;
  for (int attempt = 0; attempt < sobol_attempts_tried; ++attempt) {
    const auto tried = doe::detail::sobol_attempt(doe::detail::sobol_dimension(j), j, attempt);
    const double cost = projection_cost(before, generating_rows(doe::detail::directions_of(tried)), least);
    if (cost >= least) continue;
    least = cost;
    best = attempt;
  }
  return best;
}

}  // namespace drawpoint::support
