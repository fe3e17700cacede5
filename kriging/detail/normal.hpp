// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The standard normal distribution as searches need it: correct to about 14 digits far into its lower tail.
///
/// With t = −z, φ the density and K(t) = 1/(t + 2/(t + 3/(t + ...))), Laplace's continued fraction:
///   Φ(z)                    = φ(z)/(t + K)
///   h(z) = φ(z) + z Φ(z)    = φ(z) K/(t + K)
/// Nothing cancels in the second forms, which are used below z = −2 with 120 terms: the truncation error
/// there is below exp(−2t√(2·120)) = 1e-26. h is the expected improvement of a normal variable of mean −z and
/// deviation 1. The logarithms stay finite where the numbers themselves underflow, below z = −38.
/// Source: Abramowitz, Stegun 1964, 26.2.14.

#include <algorithm>
#include <cmath>
#include <drawpoint/doe/detail/normal_quantile.hpp>
#include <limits>
#include <numbers>

namespace drawpoint::kriging::detail {

inline constexpr double tail_begins = -2.0;

inline double log_normal_density(double z) { return -0.5 * z * z - 0.5 * std::log(2.0 * std::numbers::pi); }

inline double normal_density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }

/// K(t), t >= 2.
inline double laplace_fraction(double t) {
  double K = 0.0;
  for (int k = 120; k >= 1; --k) K = k / (t + K);
  return K;
}

using doe::detail::normal_probability;

/// ln Φ(z).
inline double log_normal_probability(double z) {
  if (z >= tail_begins) return std::log(normal_probability(z));
  if (z == -std::numeric_limits<double>::infinity()) return z;
  return log_normal_density(z) - std::log(laplace_fraction(-z) - z);
}

/// h(z) = φ(z) + z Φ(z).
inline double normal_improvement(double z) {
  if (z >= tail_begins) return normal_density(z) + z * normal_probability(z);
  if (z < -40.0) return 0.0;  // below the smallest double
  const double K = laplace_fraction(-z);
  return normal_density(z) * (K / (K - z));
}

/// ln h(z).
inline double log_normal_improvement(double z) {
  if (z >= tail_begins) return std::log(normal_improvement(z));
  if (z < -1e150) return -std::numeric_limits<double>::infinity();
  const double K = laplace_fraction(-z);
  return log_normal_density(z) + std::log(K / (K - z));
}

/// E[(a − Y)⁺] for Y of this mean and standard deviation; the deviation may be 0.
inline double expected_shortfall(double a, double mean, double deviation) {
  if (!(deviation > 0.0)) return std::max(a - mean, 0.0);
  return deviation * normal_improvement((a - mean) / deviation);
}

}  // namespace drawpoint::kriging::detail
