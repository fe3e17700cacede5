// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What one run says of a latent value f when it gives no number with normal noise: p(run | f) N(f; mean,
/// variance), its integral, mean and variance.
///
///   SuccessRun  y = ±1, Φ(y f): closed form (Rasmussen, Williams 2006, equations 3.58 and 3.85 to 3.87)
///   CountRun    Poisson of mean exp(f + offset): trapezoidal rule with 128 points over all where the integrand
///               is above e⁻⁴⁰ of its maximum. It is smooth and falls off on both sides, so the rule's error
///               falls exponentially with the points: below 1e-9 for variances up to 10, 1e-5 up to 100
///               (tests/kriging/count_analytic.cpp).

#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/normal.hpp>
#include <numbers>

namespace drawpoint::kriging::detail {

struct TiltedMoments {
  double mean, variance, log_integral;
};

struct SuccessRun {
  double y;  ///< +1 or −1

  TiltedMoments tilted(double mean, double variance) const {
    const double width = std::sqrt(1.0 + variance), z = y * mean / width;
    const double log_integral = log_normal_probability(z);
    const double ratio = std::exp(log_normal_density(z) - log_integral);
    return {mean + y * variance * ratio / width,
            variance - variance * variance * ratio * (z + ratio) / (1.0 + variance), log_integral};
  }
};

struct CountRun {
  double count;   ///< 0, 1, 2, ...
  double offset;  ///< ln of the mean where f = 0

  TiltedMoments tilted(double mean, double variance) const {
    const Peak peak = highest(mean, variance);
    const double left = reach(peak, mean, variance, -1.0), right = reach(peak, mean, variance, 1.0);
    constexpr int points = 128;
    const double spacing = (left + right) / (points - 1);
    double sum = 0, first = 0, second = 0;
    for (int k = 0; k < points; ++k) {
      const double f = peak.place - left + k * spacing;
      const double weight = std::exp(log_integrand(f, mean, variance) - peak.value);
      sum += weight;
      first += weight * (f - peak.place);
      second += weight * (f - peak.place) * (f - peak.place);
    }
    const double shift = first / sum;
    const double constant = -std::lgamma(count + 1.0) - 0.5 * std::log(2.0 * std::numbers::pi * variance);
    return {peak.place + shift, second / sum - shift * shift,
            std::log(sum * spacing) + peak.value + constant};
  }

 private:
  struct Peak {
    double place, value, width;
  };

  /// But for what does not depend on f.
  double log_integrand(double f, double mean, double variance) const {
    return count * (f + offset) - std::exp(f + offset) - 0.5 * (f - mean) * (f - mean) / variance;
  }

  /// The logarithm is concave: Newton's steps, shortened where the exponential would overshoot, end.
  Peak highest(double mean, double variance) const {
    double f = std::min(mean, std::log(count + 1.0) - offset);
    double curvature = 1.0;
    for (int k = 0; k < 100; ++k) {
      const double rate = std::exp(f + offset);
      curvature = rate + 1.0 / variance;
      const double step = (count - rate - (f - mean) / variance) / curvature;
      f += std::clamp(step, -5.0, 5.0);
      if (std::abs(step) < 1e-10) break;
    }
    return {f, log_integrand(f, mean, variance), 1.0 / std::sqrt(curvature)};
  }

  /// How far on one side the integrand stays above e⁻⁴⁰ of its maximum, to a quarter.
  double reach(const Peak& peak, double mean, double variance, double side) const {
    double distance = peak.width;
    while (log_integrand(peak.place + side * distance, mean, variance) > peak.value - 40.0) distance *= 1.25;
    return distance;
  }
};

}  // namespace drawpoint::kriging::detail
