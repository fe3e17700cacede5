// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How well predictions met what was then observed, in one number.
///
/// With errors eᵢ = yᵢ − ŷᵢ and σᵢ² the variance of observation i as predicted:
///   rmse      √(1/n Σ eᵢ²), unit of y              mae   1/n Σ |eᵢ|, unit of y
///   nrmse     rmse/(max y − min y)                 q2    1 − Σ eᵢ²/Σ (yᵢ − ȳ)²
///   nlpd      1/n Σ [½ ln(2π σᵢ²) + eᵢ²/(2σᵢ²)]    coverage  share of |eᵢ| <= z σᵢ, z the normal quantile of
///   (1 + level)/2
/// nrmse and q2 are NaN when the observations are all equal. nlpd punishes error bars that are too narrow and
/// too wide; coverage of a sound model is near `level`. Source: Rasmussen, Williams 2006, section 2.5.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/detail/normal_quantile.hpp>
#include <drawpoint/kriging/detail/dense.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>

namespace drawpoint::kriging {

/// What was observed beside what was predicted without it, one entry per run.
struct Validation {
  double rmse = std::numeric_limits<double>::quiet_NaN(), nrmse = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd observed, predicted;   ///< unit of y
  Eigen::VectorXd variance;              ///< of the latent function, unit of y squared
  Eigen::VectorXd observation_variance;  ///< of a noisy run there, unit of y squared
};

enum class ErrorFunction { rmse, nrmse, mae, q2, nlpd, coverage };

inline std::string_view to_string(ErrorFunction error) {
  switch (error) {
    case ErrorFunction::rmse:
      return "rmse";
    case ErrorFunction::nrmse:
      return "nrmse";
    case ErrorFunction::mae:
      return "mae";
    case ErrorFunction::q2:
      return "q2";
    case ErrorFunction::nlpd:
      return "nlpd";
    case ErrorFunction::coverage:
      return "coverage";
  }
  return "unknown";
}

namespace detail {

using doe::detail::normal_quantile;

inline double negative_log_density(const Eigen::VectorXd& error, const Eigen::VectorXd& variance) {
  double sum = 0;
  for (Index i = 0; i < error.size(); ++i)
    sum += 0.5 * std::log(2.0 * std::numbers::pi * variance[i]) + 0.5 * error[i] * error[i] / variance[i];
  return sum / static_cast<double>(error.size());
}

/// Share of the errors within z deviations.
inline double covered(const Eigen::VectorXd& error, const Eigen::VectorXd& variance, double level) {
  const double z = normal_quantile(0.5 + 0.5 * level);
  Index count = 0;
  for (Index i = 0; i < error.size(); ++i)
    if (std::abs(error[i]) <= z * std::sqrt(variance[i])) ++count;
  return static_cast<double>(count) / static_cast<double>(error.size());
}

}  // namespace detail

/// `level` is of coverage alone, between 0 and 1. Throws std::invalid_argument for an empty validation and
/// another level.
inline double score(const Validation& v, ErrorFunction error, double level = 0.95) {
  if (v.observed.size() == 0)
    throw std::invalid_argument(
        "kriging::score: the validation holds 0 runs; allowed is 1 or more; validate first");
  if (!(level > 0 && level < 1))
    throw std::invalid_argument("kriging::score: level is " + std::to_string(level) +
                                "; allowed are numbers between 0 and 1; use 0.95");
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd e = detail::difference(v.observed, v.predicted);
  const double range = detail::largest_entry(v.observed) - detail::smallest_entry(v.observed);
  const double n = static_cast<double>(e.size()), rmse = std::sqrt(detail::square(e) / n);
  switch (error) {
    case ErrorFunction::rmse:
      return rmse;
    case ErrorFunction::nrmse:
      return range > 0 ? rmse / range : none;
    case ErrorFunction::mae:
      return std::accumulate(e.begin(), e.end(), 0.0,
                             [](double sum, double x) { return sum + std::abs(x); }) /
             n;
    case ErrorFunction::q2: {
      const Eigen::VectorXd centred = detail::affine(v.observed, 1.0, -detail::mean_of(v.observed));
      return range > 0 ? 1.0 - detail::square(e) / detail::square(centred) : none;
    }
    case ErrorFunction::nlpd:
      return detail::negative_log_density(e, v.observation_variance);
    case ErrorFunction::coverage:
      return detail::covered(e, v.observation_variance, level);
  }
  return none;
}

/// Whether higher numbers are better ones.
inline bool higher_is_better(ErrorFunction error) {
  return error == ErrorFunction::q2 || error == ErrorFunction::coverage;
}

}  // namespace drawpoint::kriging
