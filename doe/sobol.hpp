// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Scrambled Sobol points: low discrepancy, and unbiased because each point alone is uniform.
///
/// Sobol 1967 with the direction numbers of detail/sobol_directions.hpp, 32 bits, up to 1111 variables.
/// Scrambling is Owen's 1995 nested uniform one: bit k of a coordinate is flipped by a random bit that
/// depends on the variable and on the k-1 bits above it; below bit 32 the digits are random. A scrambled (t,
/// m, d)-net is again one: of the first 2^m runs, every one of 2^m equal strata of any variable holds exactly
/// one. Best with runs = 2^m; any number is allowed. Run i does not depend on `runs`. Cost O(32 n d) hashes.

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/detail/sobol_directions.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

namespace detail {

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

/// runs x d. Throws std::invalid_argument when runs < 1 or the problem has more than 1111 variables.
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
