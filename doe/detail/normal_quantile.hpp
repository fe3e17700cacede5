// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The standard normal distribution: Φ(x) = P(Z <= x), and its quantile, x with Φ(x) = p.
///
/// The quantile by Newton's steps on Φ from a logistic guess, each at most 0.5; ends when a step is below
/// 1e-15 (1 + |x|). Some five evaluations of erfc.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drawpoint::doe::detail {

/// Φ(z).
inline double normal_probability(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// 0 < p < 1.
inline double normal_quantile(double p) {
  double x = std::log(p / (1.0 - p)) / 1.702;
  for (int i = 0; i < 60; ++i) {
    const double miss = normal_probability(x) - p;
    const double step = miss / (std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi));
    x -= std::clamp(step, -0.5, 0.5);
    if (std::abs(step) < 1e-15 * (1.0 + std::abs(x))) break;
  }
  return x;
}

}  // namespace drawpoint::doe::detail
