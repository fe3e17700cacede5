// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The first two derivatives of ln Γ, and the inverse of the second.
///
/// The recurrence leads to x >= 10, then the asymptotic series hold (Abramowitz, Stegun 1964, 6.3.18 and 6.4.12). The
/// first terms left out are at most 5/660 1e-10 = 7.6e-13.

#include <cmath>

namespace drawpoint::kriging::detail {

/// ψ(x), x > 0.
inline double digamma(double x) {
  double below = 0;
  for (; x < 10; x += 1) below += 1 / x;
  const double q = 1 / (x * x);
  return std::log(x) - 0.5 / x - q * (1.0 / 12 - q * (1.0 / 120 - q * (1.0 / 252 - q / 240))) - below;
}

/// ψ'(x), x > 0.
inline double trigamma(double x) {
  double below = 0;
  for (; x < 10; x += 1) below += 1 / (x * x);
  const double q = 1 / (x * x);
  return (1 + 0.5 / x + q * (1.0 / 6 - q * (1.0 / 30 - q * (1.0 / 42 - q / 30)))) / x + below;
}

/// The x at which ψ'(x) = y, y > 0, to 1e-12 of it: ψ' falls from 1/x² to 1/x, so that x lies between 1/(y + 1) and
/// 1/y + 1/√y + 1.
inline double inverse_trigamma(double y) {
  double low = std::log(1 / (y + 1)), high = std::log(1 / y + 1 / std::sqrt(y) + 1);
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (trigamma(std::exp(middle)) > y ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace drawpoint::kriging::detail
