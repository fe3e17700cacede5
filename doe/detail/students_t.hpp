// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Quantiles of Student's t distribution.
///
/// With t = √ν tan θ the probability within ±t is ∫₀^θ cos^(ν-1) φ dφ over the same integral to π/2, which is
/// √π Γ(ν/2) / (2 Γ((ν+1)/2)). Simpson's rule on 400 intervals, θ by bisection. Relative error below 1e-9 for
/// levels up to 0.95, below 3e-8 up to 0.99. Beyond 1e4 degrees of freedom, whose peak the intervals would
/// miss, t from the normal quantile z with its terms in 1/ν and 1/ν² (Abramowitz, Stegun 1964, 26.7.5); the
/// next is below 1e-12.

#include <cmath>
#include <drawpoint/doe/detail/normal_quantile.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::doe::detail {

/// ∫₀^θ cos^(ν-1) φ dφ.
inline double cosine_power_integral(double theta, double degrees_of_freedom) {
  constexpr int intervals = 400;
  const double h = theta / intervals;
  double sum = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double weight = i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::pow(std::cos(i * h), degrees_of_freedom - 1.0);
  }
  return sum * h / 3.0;
}

/// The t within whose ± lies the share `level` (0 to 0.99) of the distribution. degrees_of_freedom: 1 or
/// more, not necessarily whole. Throws std::invalid_argument for others.
inline double students_t_within(double level, double degrees_of_freedom) {
  if (!(level >= 0.0 && level <= 0.99) || !(degrees_of_freedom >= 1.0))
    throw std::invalid_argument("doe::detail::students_t_within: level " + std::to_string(level) + " and " +
                                std::to_string(degrees_of_freedom) +
                                " degrees of freedom; allowed are 0 to 0.99 and 1 or more");
  if (degrees_of_freedom > 1e4) {
    const double z = normal_quantile(0.5 + 0.5 * level), z3 = z * z * z, n = degrees_of_freedom;
    return z + (z3 + z) / (4.0 * n) + (5.0 * z3 * z * z + 16.0 * z3 + 3.0 * z) / (96.0 * n * n);
  }
  const double half = 0.5 * degrees_of_freedom;
  const double half_pi = std::acos(0.0);
  const double all = std::sqrt(0.5 * half_pi) * std::exp(std::lgamma(half) - std::lgamma(half + 0.5));
  double low = 0.0, high = half_pi;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (cosine_power_integral(middle, degrees_of_freedom) < level * all ? low : high) = middle;
  }
  return std::sqrt(degrees_of_freedom) * std::tan(0.5 * (low + high));
}

}  // namespace drawpoint::doe::detail
