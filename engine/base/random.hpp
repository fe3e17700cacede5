// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <drawpoint/engine/base/eigen.hpp>

/// Counter-based random numbers for the engine: draw k of seed s is a hash of (s, k), the same on every
/// machine. Mix: splitmix64 (G. L. Steele et al., "Fast splittable pseudorandom number generators", 2014).
namespace drawpoint::engine {

class CounterRandom {
 public:
  explicit CounterRandom(std::uint64_t seed, std::uint64_t counter = 0)
      : seed_(mix(seed)), counter_(counter) {}

  std::uint64_t counter() const { return counter_; }
  std::uint64_t bits() { return mix(seed_ + 0x9E3779B97F4A7C15ull * ++counter_); }
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }  ///< in [0, 1)
  std::size_t index(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

  /// Uniform over all rotations (K. Shoemake, "Uniform random rotations", 1992).
  Eigen::Quaterniond rotation() {
    const double u = uniform(), a = 2 * M_PI * uniform(), b = 2 * M_PI * uniform();
    return {std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
            std::sqrt(u) * std::sin(b)};
  }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  std::uint64_t seed_, counter_;
};

}  // namespace drawpoint::engine
