// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The quantile of the standard normal distribution: x with P(Z <= x) = p.
///
/// Newton's steps on erfc from a logistic guess, each at most 0.5; ends when a step is below 1e-15 (1 + |x|).
/// Some five evaluations of erfc.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drawpoint::doe::detail {

/// 0 < p < 1.
inline double normal_quantile(double p) {
  double x = std::log(p / (1.0 - p)) / 1.702;
  for (int i = 0; i < 60; ++i) {
    const double miss = 0.5 * std::erfc(-x / std::numbers::sqrt2) - p;
    const double step = miss / (std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi));
    x -= std::clamp(step, -0.5, 0.5);
    if (std::abs(step) < 1e-15 * (1.0 + std::abs(x))) break;
  }
  return x;
}

}  // namespace drawpoint::doe::detail
