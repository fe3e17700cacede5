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
///   crps      1/n Σ ∫ (F(t) − 1{t >= yᵢ})² dt, unit of y, F the predicted distribution: mae of a prediction
///             that knows how wrong it may be
/// Where predictions are normal on another scale (transform.hpp), nlpd, coverage and crps are those of the
/// distribution that this makes on the scale of y; crps is then a sum over 200 quantiles, exact to 1 %. nrmse
/// and q2 are NaN when the observations are all equal. nlpd and crps punish error bars that are too narrow
/// and too wide; coverage of a sound model is near `level`. Sources: Rasmussen, Williams 2006, section 2.5;
/// Gneiting, Raftery 2007, JASA 102(477), "Strictly proper scoring rules, prediction, and estimation" (crps).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/detail/normal_quantile.hpp>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/normal.hpp>
#include <drawpoint/kriging/transform.hpp>
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
  /// Where predictions are normal on another scale: that, and mean and variance of a noisy run on it.
  Transform transform = {};
  Eigen::VectorXd scaled_mean = {}, scaled_variance = {};
};

enum class ErrorFunction { rmse, nrmse, mae, q2, nlpd, coverage, crps };

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
    case ErrorFunction::crps:
      return "crps";
  }
  return "unknown";
}

namespace detail {

using doe::detail::normal_quantile;

/// What is predicted of one run: a normal distribution on the scale of `transform`.
struct PredictedRun {
  const Transform& transform;
  double mean, deviation;

  /// t: the normal quantile; unit of y.
  double quantile(double t) const {
    return back_transformed(transform, t == 0 ? mean : mean + t * deviation);
  }
};

inline PredictedRun predicted_run(const Validation& v, Index i) {
  if (v.transform.scale == Scale::linear)
    return {v.transform, v.predicted[i], std::sqrt(std::max(v.observation_variance[i], 0.0))};
  return {v.transform, v.scaled_mean[i], std::sqrt(std::max(v.scaled_variance[i], 0.0))};
}

/// +∞ where no prediction reaches. On the bound of a square root, where part of the distribution is, of the
/// probability of that.
inline double negative_log_density(const PredictedRun& p, double y) {
  if (!reaches(p.transform, y)) return std::numeric_limits<double>::infinity();
  const double z = transformed(p.transform, y);
  if (p.deviation == 0 && !std::isnan(p.mean))
    return (z == p.mean ? -1 : 1) * std::numeric_limits<double>::infinity();
  const double t = (z - p.mean) / p.deviation;
  if (p.transform.scale == Scale::square_root && z <= 0) return -log_normal_probability(t);
  return std::log(p.deviation * back_slope(p.transform, z)) - log_normal_density(t);
}

/// Whether y lies within t deviations.
inline bool covers(const PredictedRun& p, double y, double t) {
  return p.quantile(-t) <= y && y <= p.quantile(t);
}

/// ∫ (F(s) − 1{s >= y})² ds: in closed form for a normal distribution, else twice the mean quantile loss.
inline double ranked_probability_score(const PredictedRun& p, double y) {
  if (p.transform.scale == Scale::linear) {
    if (!(p.deviation > 0)) return std::abs(y - p.mean);
    const double t = (y - p.mean) / p.deviation;
    return p.deviation * (t * (2.0 * normal_probability(t) - 1.0) + 2.0 * normal_density(t) -
                          1.0 / std::sqrt(std::numbers::pi));
  }
  constexpr int levels = 200;
  double sum = 0;
  for (int k = 0; k < levels; ++k) {
    const double level = (k + 0.5) / levels, q = p.quantile(normal_quantile(level));
    sum += ((y < q ? 1.0 : 0.0) - level) * (q - y);
  }
  return 2.0 * sum / levels;
}

/// Mean over the runs of f(what was predicted, what was observed).
template <class F>
double mean_over_runs(const Validation& v, const F& f) {
  double sum = 0;
  for (Index i = 0; i < v.observed.size(); ++i) sum += f(predicted_run(v, i), v.observed[i]);
  return sum / static_cast<double>(v.observed.size());
}

}  // namespace detail

/// What run i of a validation is predicted to be at most with this probability, unit of y.
inline double predicted_quantile(const Validation& v, Eigen::Index i, double probability) {
  return detail::predicted_run(v, i).quantile(detail::normal_quantile(probability));
}

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
      return detail::mean_over_runs(v, detail::negative_log_density);
    case ErrorFunction::coverage: {
      const double t = detail::normal_quantile(0.5 + 0.5 * level);
      return detail::mean_over_runs(
          v, [t](const detail::PredictedRun& p, double y) { return detail::covers(p, y, t) ? 1.0 : 0.0; });
    }
    case ErrorFunction::crps:
      return detail::mean_over_runs(v, detail::ranked_probability_score);
  }
  return none;
}

/// Whether higher numbers are better ones.
inline bool higher_is_better(ErrorFunction error) {
  return error == ErrorFunction::q2 || error == ErrorFunction::coverage;
}

}  // namespace drawpoint::kriging
