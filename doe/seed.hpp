// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Seeds and the counter-based random numbers of the toolkit.
///
/// A stream is a pure function of (seed, counter): draw k is mix(seed + k·γ) with γ = 0x9E3779B97F4A7C15,
/// which is splitmix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators"). A run's
/// seed is a hash of (study seed, run, replicate), so neither the number of threads nor the order of the runs
/// can change a result. Period 2⁶⁴ draws a stream. Not for cryptography.

#include <cmath>
#include <cstdint>
#include <numbers>

namespace drawpoint::doe {

using Seed = std::uint64_t;

namespace detail {

inline constexpr std::uint64_t golden_gamma = 0x9E3779B97F4A7C15ULL;

/// splitmix64's output function: a bijection on 64 bits in which each input bit flips each output bit half
/// the time.
constexpr std::uint64_t mix(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// The upper 53 bits as a number in [0, 1).
constexpr double to_unit(std::uint64_t bits) noexcept { return static_cast<double>(bits >> 11) * 0x1p-53; }

}  // namespace detail

/// The seed of one replicate of one run. Distinct runs of a study, and distinct replicates of a run, have
/// distinct seeds.
constexpr Seed run_seed(Seed study, std::uint64_t run, std::uint64_t replicate) noexcept {
  const std::uint64_t of_study = detail::mix(study + detail::golden_gamma);
  const std::uint64_t of_run = detail::mix(of_study + (run + 1) * detail::golden_gamma);
  return detail::mix(of_run + (replicate + 1) * detail::golden_gamma);
}

/// A stream of random numbers: a seed and a counter, cheap to copy, usable with the distributions of `<random>`.
class RandomStream {
 public:
  using result_type = std::uint64_t;

  explicit constexpr RandomStream(Seed seed) noexcept : state_(seed) {}

  static constexpr result_type min() noexcept { return 0; }
  static constexpr result_type max() noexcept { return ~result_type{0}; }

  constexpr result_type operator()() noexcept { return detail::mix(state_ += detail::golden_gamma); }

  /// Uniform in [0, 1), 53 bits.
  constexpr double uniform() noexcept { return detail::to_unit((*this)()); }

  /// Uniform in 0..n-1, n >= 1; the bias is below n·2⁻⁵³.
  constexpr int below(int n) noexcept { return static_cast<int>(uniform() * n); }

  /// Standard normal by Box and Muller's cosine branch: two uniforms a draw, no hidden state.
  double normal() noexcept {
    const double radius = std::sqrt(-2.0 * std::log1p(-uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace drawpoint::doe
