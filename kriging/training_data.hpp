// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Checks of what a fit is given, and the scales it works on.
///
/// Inputs go to [-1, 1] by the box or the range of the data, the response to mean 0 and standard deviation 1
/// (n − 1 in the denominator). An input that never varies is scaled to 0 everywhere, so that predictions
/// ignore it.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/options.hpp>
#include <limits>
#include <stdexcept>
#include <string>

namespace drawpoint::kriging::detail {

/// x_scaled = (x − centre)·factor, column by column.
struct InputScale {
  Eigen::VectorXd centre, factor;

  Eigen::MatrixXd apply(const Eigen::MatrixXd& X) const {
    return (X.rowwise() - centre.transpose()) * factor.asDiagonal();
  }
};

struct TrainingData {
  Eigen::MatrixXd X;  ///< scaled
  Eigen::VectorXd y;  ///< standardised; empty when the response is constant
  InputScale input;
  double y_centre = 0, y_scale = 0;
};

// Squares of numbers beyond these leave the range of double.
inline constexpr double largest = 1e150, smallest_range = 1e-150;

[[noreturn]] inline void reject(const std::string& what) {
  throw std::invalid_argument("kriging::fit: " + what);
}

inline std::string text(double value) { return doe::detail::number_text(value); }

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
  if (X.cols() < 1) reject("X has 0 columns; allowed is 1 or more; give one column a variable");
  if (X.rows() < 2)
    reject("X has " + std::to_string(X.rows()) + (X.rows() == 1 ? " run" : " runs") +
           "; allowed is 2 or more; a single run says nothing about how the response varies");
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    for (Eigen::Index k = 0; k < X.cols(); ++k)
      check_number(X(i, k), "X(" + std::to_string(i) + ", " + std::to_string(k) + ")");
    check_number(y[i], "y[" + std::to_string(i) + "]");
  }
}

inline void check_bounds(const std::string& name, double lower, double upper) {
  if (!(lower > 0) || !std::isfinite(lower))
    reject(name + "_lower is " + text(lower) +
           "; allowed are finite numbers above 0; use a small one for none");
  if (!(upper >= lower) || !std::isfinite(upper))
    reject(name + "_upper is " + text(upper) + "; allowed are finite numbers from " + name + "_lower " +
           text(lower) + " on; raise it");
}

inline void check_box(const FitOptions& options, Eigen::Index d) {
  if (options.lower.size() == 0 && options.upper.size() == 0) return;
  if (options.lower.size() != d || options.upper.size() != d)
    reject("the box has " + std::to_string(options.lower.size()) + " lower and " +
           std::to_string(options.upper.size()) + " upper bounds but X has " + std::to_string(d) +
           " columns; give one of each a variable, or neither");
  for (Eigen::Index k = 0; k < d; ++k) {
    check_number(options.lower[k], "lower[" + std::to_string(k) + "]");
    check_number(options.upper[k], "upper[" + std::to_string(k) + "]");
    if (!(options.lower[k] < options.upper[k]))
      reject("variable " + std::to_string(k) + ": lower bound " + text(options.lower[k]) +
             " is not below upper bound " + text(options.upper[k]) + "; swap or widen them");
  }
}

inline void check_options(const FitOptions& options, Eigen::Index d) {
  check_bounds("theta", options.theta_lower, options.theta_upper);
  check_bounds("nugget", options.nugget_lower, options.nugget_upper);
  check_box(options, d);
  if (options.starts < 1)
    reject("starts is " + std::to_string(options.starts) + "; allowed is 1 or more; use 8");
  if (options.candidates < options.starts)
    reject("candidates is " + std::to_string(options.candidates) + "; allowed is starts " +
           std::to_string(options.starts) + " or more; raise it");
  if (options.max_iterations < 1)
    reject("max_iterations is " + std::to_string(options.max_iterations) + "; allowed is 1 or more; use 200");
}

inline InputScale input_scale(const Eigen::MatrixXd& X, const FitOptions& options) {
  const Eigen::VectorXd low = X.colwise().minCoeff(), high = X.colwise().maxCoeff();
  const Eigen::VectorXd lower = options.lower.size() ? options.lower : low;
  const Eigen::VectorXd upper = options.upper.size() ? options.upper : high;
  InputScale scale{0.5 * (lower + upper), Eigen::VectorXd::Zero(X.cols())};
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    if (high[k] == low[k]) continue;
    if (upper[k] - lower[k] < smallest_range)
      reject("variable " + std::to_string(k) + " has a range of " + text(upper[k] - lower[k]) +
             "; allowed are ranges from 1e-150 on; change the unit");
    scale.factor[k] = 2.0 / (upper[k] - lower[k]);
  }
  return scale;
}

/// Whether all y are equal to round-off: no differences that a model could explain.
inline bool is_constant(const Eigen::VectorXd& y) {
  const double round_off = 8.0 * std::numeric_limits<double>::epsilon() * y.cwiseAbs().maxCoeff();
  return y.maxCoeff() - y.minCoeff() <= round_off;
}

/// Throws std::invalid_argument for anything that no model can be fitted to.
inline TrainingData prepare(const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const FitOptions& options) {
  check_runs(X, y);
  check_options(options, X.cols());
  TrainingData data;
  data.input = input_scale(X, options);
  data.X = data.input.apply(X);
  data.y_centre = y[0] + (y.array() - y[0]).mean();
  if (is_constant(y)) return data;
  const double range = y.maxCoeff() - y.minCoeff();
  if (range < smallest_range)
    reject("y has a range of " + text(range) + "; allowed are ranges from 1e-150 on; change the unit");
  data.y = (y.array() - data.y_centre) / range;
  data.y_scale = range * std::sqrt(data.y.squaredNorm() / static_cast<double>(y.size() - 1));
  data.y *= range / data.y_scale;
  return data;
}

}  // namespace drawpoint::kriging::detail
