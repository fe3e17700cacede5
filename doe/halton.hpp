// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Halton points: a sequence in any number of variables up to 100, with a net in every prime base.
///
/// Coordinate j of run i is the radical inverse φ_b of i in the j-th prime base b: the digits of i mirrored
/// at the point (Halton 1960). Plain, its variables with large bases move together at first. The cure,
/// `scrambled`, permutes each digit at random, one permutation per base and digit (Owen 2017, "A randomized
/// Halton algorithm in R"), with as many digits as 53 bits hold; it makes every single point uniform. Run i
/// does not depend on `runs`. Cost O(n d log n).

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/doe/detail/scaling.hpp>
#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe {

enum class HaltonKind { scrambled, plain };

struct HaltonOptions {
  Seed seed = 1;
  HaltonKind kind = HaltonKind::scrambled;  ///< plain ignores the seed and starts at run 1, not at the origin
};

namespace detail {

inline constexpr int halton_max_dimensions = 100;

inline int nth_prime(int index) {
  int prime = 2;
  for (int found = 0;; ++prime) {
    bool divisible = false;
    for (int k = 2; k * k <= prime; ++k) divisible = divisible || prime % k == 0;
    if (!divisible && found++ == index) return prime;
  }
}

/// φ_b(i).
constexpr double radical_inverse(std::uint64_t i, int base) {
  double value = 0.0, place = 1.0 / base;
  for (; i > 0; i /= static_cast<unsigned>(base), place /= base)
    value += place * static_cast<double>(i % static_cast<unsigned>(base));
  return value;
}

/// One random permutation of the digits for each place of one base.
class DigitScrambling {
 public:
  DigitScrambling(int base, Seed seed) : base_(base) {
    RandomStream random(seed);
    for (double place = 1.0; place > 0x1p-53; place /= base)
      permutations_.push_back(permutation(base, random));
  }

  /// The scrambled φ_b(i), in [0, 1).
  double operator()(std::uint64_t i) const {
    double value = 0.0, place = 1.0 / base_;
    for (const std::vector<int>& digits : permutations_) {
      value += place * digits[i % static_cast<unsigned>(base_)];
      i /= static_cast<unsigned>(base_);
      place /= base_;
    }
    return std::min(value, 1.0 - 0x1p-53);
  }

 private:
  int base_;
  std::vector<std::vector<int>> permutations_;
};

/// u of `runs` runs from run `first` of one variable.
inline Eigen::VectorXd halton_column(int first, int runs, int variable, Seed seed, HaltonKind kind) {
  const int base = nth_prime(variable);
  Eigen::VectorXd u(runs);
  if (kind == HaltonKind::scrambled) {
    const DigitScrambling scrambled(base, run_seed(seed, static_cast<std::uint64_t>(variable), 0));
    for (int i = 0; i < runs; ++i) u[i] = scrambled(static_cast<std::uint64_t>(first + i));
    return u;
  }
  for (int i = 0; i < runs; ++i) u[i] = radical_inverse(static_cast<std::uint64_t>(1 + first + i), base);
  return u;
}

}  // namespace detail

/// runs x d. Throws std::invalid_argument when runs < 1 or the problem has more than 100 variables.
inline Eigen::MatrixXd halton(const Problem& problem, int runs, const HaltonOptions& options = {}) {
  detail::check_design("doe::halton", problem, runs);
  const auto d = static_cast<int>(problem.variables.size());
  if (d > detail::halton_max_dimensions)
    throw std::invalid_argument("doe::halton: the problem has " + std::to_string(d) +
                                " variables; allowed is up to " +
                                std::to_string(detail::halton_max_dimensions) + "; use latin_hypercube");
  Eigen::MatrixXd U(runs, d);
  for (int j = 0; j < d; ++j) U.col(j) = detail::halton_column(0, runs, j, options.seed, options.kind);
  return detail::to_natural(std::move(U), problem);
}

}  // namespace drawpoint::doe
