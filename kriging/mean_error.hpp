// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// By how much a model misses the mean response, from n validation runs that are noisy themselves.
///
/// A run's error is the model's own and the run's noise: E[1/n Σ eᵢ²] = μ² + σ². No model gets an rmse below
/// σ, so a model is judged by μ = √max(0, 1/n Σ eᵢ² − σ²).
///
/// Interval of 95 %: Σ eᵢ² is about (μ² + σ²) χ²_m, where m = (Σ vᵢ)²/Σ vᵢ² <= n, with vᵢ the variance that
/// the model predicts of run i, counts runs of unequal variance; σ² is known as from a χ² of its own degrees.
/// Both intervals combine into that of the difference: an end is as far away as the root of the sum of the
/// squared distances of the two ends that move it (Ting et al. 1990). The upper end is counted from μ, not
/// from a negative difference. Normal errors that do not depend on each other are assumed; a model's own
/// errors have longer tails, and then the interval is somewhat short: tests/kriging/mean_error_statistical.cpp
/// has how often it holds. Source: Ting, Burdick, Graybill, Jeyaratnam, Lu 1990, Journal of Statistical
/// Computation and Simulation 35, "Confidence intervals on linear combinations of variance components".

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/score.hpp>
#include <limits>

namespace drawpoint::kriging {

/// σ² of single runs in the mean, unit of y squared, and how well it is known.
struct NoiseEstimate {
  double variance = 0;
  double degrees = std::numeric_limits<double>::infinity();  ///< of freedom, > 0; ∞: exactly
};

/// From the variances that runs report of their own noise: n entries, n >= 1, from 0 on. The degrees are those
/// of a χ² that scatters as these do, so that noise which differs from place to place counts as less known.
inline NoiseEstimate reported_noise(const Eigen::VectorXd& variances) {
  const double n = static_cast<double>(variances.size()), mean = detail::mean_of(variances);
  const double scatter = detail::square(detail::affine(variances, 1.0, -mean)) / std::max(n - 1, 1.0);
  if (n < 2) return {mean, 1.0};
  if (!(scatter > 0)) return {mean};
  return {mean, std::max(1.0, 2 * n * mean * mean / scatter)};
}

/// As the model has it; NaN where a variance is not finite. degrees: the number of runs that it was fitted to.
inline NoiseEstimate modelled_noise(const Validation& v, double degrees) {
  if (!detail::all_finite(v.variance) || !detail::all_finite(v.observation_variance))
    return {std::numeric_limits<double>::quiet_NaN(), degrees};
  return {std::max(detail::mean_of(detail::difference(v.observation_variance, v.variance)), 0.0), degrees};
}

/// All in the unit of y.
struct MeanError {
  double rmse = std::numeric_limits<double>::quiet_NaN();   ///< μ
  double lower = std::numeric_limits<double>::quiet_NaN();  ///< of the interval of 95 %
  double upper = std::numeric_limits<double>::quiet_NaN();
  double noise = 0;  ///< σ; 0: none, or unknown
  double range =
      std::numeric_limits<double>::quiet_NaN();  ///< of the observations, noise included, as of nrmse

  double share(double error) const { return error / range; }
  double nrmse() const { return share(rmse); }
};

namespace detail {

struct Ends {
  double lower, upper;
};

/// Quantile of χ² by Wilson and Hilferty 1931: within 1 % from 5 degrees on.
inline double chi_square_quantile(double p, double degrees) {
  const double a = 2.0 / (9.0 * degrees), root = 1 - a + normal_quantile(p) * std::sqrt(a);
  return degrees * std::max(root * root * root, 1e-3);
}

/// 95 % interval of a variance that was estimated with these degrees of freedom.
inline Ends variance_ends(double variance, double degrees) {
  if (!std::isfinite(degrees)) return {variance, variance};
  return {variance * degrees / chi_square_quantile(0.975, degrees),
          variance * degrees / chi_square_quantile(0.025, degrees)};
}

/// m of the head of this file; n where no variances are known.
inline double degrees_of_errors(const Validation& v) {
  const double n = static_cast<double>(v.observed.size());
  if (v.observation_variance.size() == 0 || !all_finite(v.observation_variance)) return n;
  const double sum = n * mean_of(v.observation_variance), squares = square(v.observation_variance);
  return squares > 0 ? std::max(1.0, sum * sum / squares) : n;
}

}  // namespace detail

/// Without noise, or with noise that is not finite, μ is rmse. Throws as score() for an empty validation.
inline MeanError mean_error(const Validation& v, NoiseEstimate noise = {}) {
  const double rmse = score(v, ErrorFunction::rmse), all = rmse * rmse;
  if (!(noise.variance > 0) || !std::isfinite(noise.variance)) noise = {};
  const detail::Ends total = detail::variance_ends(all, detail::degrees_of_errors(v));
  const detail::Ends runs = detail::variance_ends(noise.variance, noise.degrees);
  const double rest = std::max(all - noise.variance, 0.0);
  const double down = std::hypot(all - total.lower, runs.upper - noise.variance);
  const double up = std::hypot(total.upper - all, noise.variance - runs.lower);
  return {.rmse = std::sqrt(rest),
          .lower = std::sqrt(std::max(all - noise.variance - down, 0.0)),
          .upper = std::sqrt(rest + up),
          .noise = std::sqrt(noise.variance),
          .range = detail::largest_entry(v.observed) - detail::smallest_entry(v.observed)};
}

}  // namespace drawpoint::kriging
