// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The equations of correlation.hpp, one pair of points and one input at a time.

#include <cmath>
#include <drawpoint/kriging/correlation.hpp>

namespace drawpoint::kriging::reference {

inline constexpr Correlation families[] = {Correlation::gaussian, Correlation::power_exponential,
                                           Correlation::matern32, Correlation::matern52};

inline double one_correlation(Correlation family, double theta, double exponent, double distance) {
  const double h = std::sqrt(2 * theta) * distance;
  switch (family) {
    case Correlation::gaussian:
      return std::exp(-theta * distance * distance);
    case Correlation::power_exponential:
      return std::exp(-theta * std::pow(distance, exponent));
    case Correlation::matern32:
      return (1 + std::sqrt(3.0) * h) * std::exp(-std::sqrt(3.0) * h);
    case Correlation::matern52:
      break;
  }
  return (1 + std::sqrt(5.0) * h + 5.0 / 3.0 * h * h) * std::exp(-std::sqrt(5.0) * h);
}

}  // namespace drawpoint::kriging::reference
