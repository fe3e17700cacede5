// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Checks of what a fit is given, and the scales it works on.
///
/// Inputs go to [-1, 1] by the box or the range of the data, the response to mean 0 and standard deviation 1
/// (n − 1 in the denominator). An input that never varies is scaled to 0 everywhere, so that predictions
/// ignore it; a category keeps the indices of its levels. Noise becomes wᵢ = τᵢ²/mean τ², and the mean is
/// kept when the variances are known.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/detail/dense.hpp>
#include <drawpoint/kriging/detail/levels.hpp>
#include <drawpoint/kriging/options.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::kriging::detail {

/// x_scaled = (x − centre)·factor, column by column.
struct InputScale {
  Eigen::VectorXd centre, factor;

  Eigen::MatrixXd apply(const Eigen::MatrixXd& X) const {
    Eigen::MatrixXd scaled = X;
    for (Index k = 0; k < X.cols(); ++k)
      for (Index i = 0; i < X.rows(); ++i) scaled(i, k) = (X(i, k) - centre[k]) * factor[k];
    return scaled;
  }

  /// Natural units a scaled one; 0 for an input that never varies.
  Eigen::VectorXd half_range() const {
    Eigen::VectorXd range = factor;
    for (double& entry : range) entry = entry > 0 ? 1.0 / entry : 0.0;
    return range;
  }
};

struct TrainingData {
  Eigen::MatrixXd X;        ///< scaled
  std::vector<int> levels;  ///< of the correlation
  Structure structure = Structure::product;
  Eigen::VectorXd y;         ///< standardised; empty when the response is constant
  Eigen::MatrixXd F;         ///< n x q, the trend's terms at the runs
  Eigen::VectorXd observed;  ///< y in its unit
  TrendFunction trend;
  InputScale input;
  double y_centre = 0, y_scale = 0;
  Eigen::VectorXd noise;       ///< wᵢ, mean 1; empty: all 1
  double known_noise = 0;      ///< mean noise variance of the standardised response; 0: estimated
  double noise_unit = 1;       ///< noise variance in natural units that w = 1 stands for
  bool trend_reduced = false;  ///< to a constant, because the runs are fewer than the terms asked for
  int terms_dropped = 0;       ///< that the runs cannot tell apart
};

// Squares of numbers beyond these leave the range of double.
inline constexpr double largest = 1e150, smallest_range = 1e-150;

[[noreturn]] inline void reject(const std::string& what) {
  throw std::invalid_argument("kriging::fit: " + what);
}

inline std::string text(double value) { return doe::detail::number_text(value); }

/// A number with three digits.
inline std::string brief_text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g", value);
  return buffer;
}

inline bool is_usable(double value) { return std::abs(value) <= largest; }

inline void check_number(double value, const std::string& place) {
  if (!std::isfinite(value))
    reject(place + " is " + text(value) + "; allowed are finite numbers; leave failed runs out");
  if (std::abs(value) > largest)
    reject(place + " is " + text(value) + "; allowed are magnitudes up to 1e150; change the unit");
}

inline void check_runs(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  if (X.rows() != y.size())
    reject("X has " + std::to_string(X.rows()) + " rows but y has " + std::to_string(y.size()) +
           " entries; give one response a run");
  if (X.cols() < 1) reject("X has 0 columns; allowed is 1 or more; give one column per variable");
  if (X.rows() < 1) reject("X has 0 runs; allowed is 1 or more; give one row per run");
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    for (Eigen::Index k = 0; k < X.cols(); ++k)
      if (!is_usable(X(i, k)))
        check_number(X(i, k), "X(" + std::to_string(i) + ", " + std::to_string(k) + ")");
    if (!is_usable(y[i])) check_number(y[i], "y[" + std::to_string(i) + "]");
  }
}

/// `of` begins the message: the variable that the bounds are of.
inline void check_bounds(const std::string& name, double lower, double upper, const std::string& of = "") {
  if (!(lower > 0) || !std::isfinite(lower))
    reject(of + name + "_lower is " + text(lower) +
           "; allowed are finite numbers above 0; use a small one for none");
  if (!(upper >= lower) || !std::isfinite(upper))
    reject(of + name + "_upper is " + text(upper) + "; allowed are finite numbers from " + name + "_lower " +
           text(lower) + " on; raise it");
}

inline void check_theta_bounds(const FitOptions& options, Eigen::Index d) {
  const bool each = options.theta_lower.one_each() || options.theta_upper.one_each();
  if (!each) return check_bounds("theta", options.theta_lower[0], options.theta_upper[0]);
  for (const auto& [name, bound] :
       {std::pair("theta_lower", &options.theta_lower), std::pair("theta_upper", &options.theta_upper)})
    if (bound->one_each() && bound->values().size() != d)
      reject(std::string(name) + " has " + std::to_string(bound->values().size()) +
             " entries; allowed is one number, or one a column of X, " + std::to_string(d));
  if (options.structure == Structure::isotropic)
    reject(
        "theta_lower or theta_upper has an entry per variable; an isotropic correlation has one theta for "
        "all numbers; give one number, or take product");
  for (Eigen::Index k = 0; k < d; ++k)
    check_bounds("theta", options.theta_lower[k], options.theta_upper[k],
                 "variable " + std::to_string(k) + ": ");
}

inline void check_box(const FitOptions& options, Eigen::Index d) {
  if (options.lower.size() == 0 && options.upper.size() == 0) return;
  if (options.lower.size() != d || options.upper.size() != d)
    reject("the box has " + std::to_string(options.lower.size()) + " lower and " +
           std::to_string(options.upper.size()) + " upper bounds but X has " + std::to_string(d) +
           " columns; give one of each a variable, or neither");
  for (Eigen::Index k = 0; k < d; ++k) {
    if (is_category(options.levels, k)) continue;  // its levels are its box
    check_number(options.lower[k], "lower[" + std::to_string(k) + "]");
    check_number(options.upper[k], "upper[" + std::to_string(k) + "]");
    if (!(options.lower[k] < options.upper[k]))
      reject("variable " + std::to_string(k) + ": lower bound " + text(options.lower[k]) +
             " is not below upper bound " + text(options.upper[k]) + "; swap or widen them");
  }
}

inline void check_exponent(const FitOptions& options, Eigen::Index d) {
  const bool used = options.correlation == Correlation::power_exponential;
  if (options.exponent.size() == 0) return;
  if (!used)
    reject("exponent is given for the correlation " + std::string(to_string(options.correlation)) +
           "; allowed is power_exponential; leave it empty");
  if (options.exponent.size() != d)
    reject("exponent has " + std::to_string(options.exponent.size()) +
           " entries; allowed is one a column of X, " + std::to_string(d) +
           ", or none; leave it empty to estimate it");
  for (Eigen::Index k = 0; k < d; ++k)
    if (!(options.exponent[k] >= 1.0 && options.exponent[k] <= 2.0))
      reject("exponent[" + std::to_string(k) + "] is " + text(options.exponent[k]) +
             "; allowed are numbers from 1 to 2; use 2 for a smooth response");
  if (options.structure != Structure::isotropic) return;
  const auto number = [&](Eigen::Index k) { return !is_category(options.levels, k); };
  Eigen::Index first = 0;
  while (first < d && !number(first)) ++first;
  for (Eigen::Index k = first; k < d; ++k)
    if (number(k) && options.exponent[k] != options.exponent[first])
      reject("exponent[" + std::to_string(k) + "] is " + text(options.exponent[k]) + " and exponent[" +
             std::to_string(first) + "] " + text(options.exponent[first]) +
             "; an isotropic correlation has one for all numbers; give them alike, or take product");
}

/// One variance for each of the n rows of what `rows` names. Throws std::invalid_argument that begins with
/// `place`.
inline void check_run_noise(const Eigen::VectorXd& noise_variance, Index n, const std::string& place,
                            const std::string& rows = "X") {
  const auto refuse = [&](const std::string& what) { throw std::invalid_argument(place + what); };
  if (noise_variance.size() != n)
    refuse("noise_variance has " + std::to_string(noise_variance.size()) + " entries but " + rows + " has " +
           std::to_string(n) + " rows; give one variance per run");
  for (Index i = 0; i < n; ++i)
    if (!(noise_variance[i] >= 0) || noise_variance[i] > largest)
      refuse("noise_variance[" + std::to_string(i) + "] is " + text(noise_variance[i]) +
             "; allowed are 0 to 1e150; give variances, the squares of standard deviations");
}

inline void check_noise(const FitOptions& options, Eigen::Index n) {
  const Eigen::VectorXd& v = options.noise_variance;
  if (options.noise == Noise::nugget || options.noise == Noise::none) {
    if (v.size() > 0)
      reject("noise_variance is given but noise is " + std::string(to_string(options.noise)) +
             "; set noise to known, pooled or proportional");
    return;
  }
  check_run_noise(v, n, "kriging::fit: ");
  if (!(largest_entry(v) > 0))
    reject("noise_variance is 0 for all runs; allowed is one above 0; use Noise::nugget");
}

inline void check_options(const FitOptions& options, Eigen::Index d) {
  check_theta_bounds(options, d);
  check_bounds("nugget", options.nugget_lower, options.nugget_upper);
  check_level_counts("kriging::fit", options.levels, d);
  check_box(options, d);
  if (!std::isfinite(options.nugget_power) || options.nugget_power < 0)
    reject("nugget_power is " + text(options.nugget_power) +
           "; allowed are finite numbers from 0 on; use 0.5, or 0 for a simulator without noise");
  if (options.starts < 1)
    reject("starts is " + std::to_string(options.starts) + "; allowed is 1 or more; use 8");
  if (options.candidates < options.starts)
    reject("candidates is " + std::to_string(options.candidates) + "; allowed is starts " +
           std::to_string(options.starts) + " or more; raise it");
  if (options.max_iterations < 1)
    reject("max_iterations is " + std::to_string(options.max_iterations) + "; allowed is 1 or more; use 200");
  if (options.threads < 0)
    reject("threads is " + std::to_string(options.threads) + "; allowed is 0 or more; use 0 for all cores");
  if ((options.trend == Trend::user) != static_cast<bool>(options.basis.values))
    reject(options.trend == Trend::user ? "trend is user but basis.values is empty; give the functions"
                                        : "basis.values is given but trend is not user; set trend to user");
  check_exponent(options, d);
}

inline InputScale input_scale(const Eigen::MatrixXd& X, const FitOptions& options) {
  InputScale scale{Eigen::VectorXd::Zero(X.cols()), Eigen::VectorXd::Zero(X.cols())};
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    if (is_category(options.levels, k)) {
      scale.factor[k] = 1.0;
      continue;
    }
    const auto [low, high] = std::minmax_element(column(X, k), column(X, k) + X.rows());
    const double lower = options.lower.size() ? options.lower[k] : *low;
    const double upper = options.upper.size() ? options.upper[k] : *high;
    scale.centre[k] = 0.5 * (lower + upper);
    if (*high == *low) continue;
    if (upper - lower < smallest_range)
      reject("variable " + std::to_string(k) + " has a range of " + text(upper - lower) +
             "; allowed are ranges from 1e-150 on; change the unit");
    scale.factor[k] = 2.0 / (upper - lower);
  }
  return scale;
}

/// Whether all y are equal to round-off: no differences that a model could explain.
inline bool is_constant(const Eigen::VectorXd& y) {
  const double size = std::max(std::abs(largest_entry(y)), std::abs(smallest_entry(y)));
  return largest_entry(y) - smallest_entry(y) <= 8.0 * std::numeric_limits<double>::epsilon() * size;
}

/// n x q, the trend's terms at the rows of X, given in both units.
inline Eigen::MatrixXd trend_matrix(const TrendFunction& trend, const Eigen::MatrixXd& X,
                                    const Eigen::MatrixXd& scaled, const InputScale& input) {
  if (trend.is_constant()) return Eigen::MatrixXd::Ones(X.rows(), 1);
  Eigen::MatrixXd F(X.rows(), trend.size());
  const Eigen::VectorXd half_range = input.half_range();
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    const Eigen::VectorXd natural = X.row(i), at = scaled.row(i);
    const Eigen::VectorXd f = trend.values({natural, at, half_range});
    for (Eigen::Index j = 0; j < F.cols(); ++j) F(i, j) = f[j];
  }
  return F;
}

/// Sets trend and F; leaves out what the runs cannot tell apart, and all but the constant when they are too
/// few.
inline void set_trend(TrainingData& data, const Eigen::MatrixXd& X, TrendFunction trend) {
  if (trend.by_user()) {
    const Eigen::VectorXd first = trend.basis.values(X.row(0));
    if (first.size() == 0)
      reject("basis.values returns no entries; allowed is 1 or more; return the constant 1");
    trend.kept.resize(static_cast<std::size_t>(first.size()));
    for (std::size_t j = 0; j < trend.kept.size(); ++j) trend.kept[j] = static_cast<Eigen::Index>(j);
  }
  data.trend_reduced = trend.size() >= X.rows() && !trend.is_constant();
  if (data.trend_reduced) trend = {};
  const Eigen::MatrixXd all = trend_matrix(trend, X, data.X, data.input);
  const std::vector<Eigen::Index> kept = independent_columns(all);
  if (kept.empty())
    reject("basis.values is 0 at all runs; allowed is one function that is not; add the constant 1");
  data.terms_dropped = static_cast<int>(all.cols()) - static_cast<int>(kept.size());
  data.F = columns_of(all, kept);
  std::vector<TrendTerm> terms;
  if (trend.by_user())
    trend.kept = kept;
  else
    for (const Eigen::Index j : kept) terms.push_back(trend.terms[j]);
  if (!terms.empty()) trend.terms = terms;
  data.trend = trend;
}

inline void set_noise(TrainingData& data, const FitOptions& options) {
  if (options.noise == Noise::nugget || options.noise == Noise::none) return;
  const double mean = mean_of(options.noise_variance);
  data.noise_unit = mean;
  if (options.noise != Noise::pooled) data.noise = affine(options.noise_variance, 1.0 / mean);
  if (options.noise != Noise::proportional) data.known_noise = mean / data.y_scale / data.y_scale;
}

/// Throws std::invalid_argument for anything that no model can be fitted to.
inline TrainingData prepare(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const FitOptions& options) {
  check_runs(X, y);
  check_options(options, X.cols());
  check_noise(options, X.rows());
  require_levels("kriging::fit", X, options.levels);
  TrainingData data;
  data.observed = y;
  data.input = input_scale(X, options);
  data.X = data.input.apply(X);
  data.levels = categories_of(options.levels);
  data.structure = options.structure;
  data.y_centre = y[0] + mean_of(affine(y, 1.0, -y[0]));
  if (y.size() == 1 || is_constant(y)) return data;
  const double range = largest_entry(y) - smallest_entry(y);
  if (range < smallest_range)
    reject("y has a range of " + text(range) + "; allowed are ranges from 1e-150 on; change the unit");
  data.y = affine(affine(y, 1.0, -data.y_centre), 1.0 / range);
  data.y_scale = range * std::sqrt(square(data.y) / static_cast<double>(y.size() - 1));
  data.y = affine(data.y, range / data.y_scale);
  set_noise(data, options);
  const Trend trend = options.trend == Trend::blind ? Trend::constant : options.trend;
  set_trend(data, X, {polynomial(static_cast<int>(X.cols()), trend, data.levels), options.basis, {}});
  return data;
}

}  // namespace drawpoint::kriging::detail
