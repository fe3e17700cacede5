// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// All that makes a Kriging model: the runs and their scales, the correlation, the factor of R and the trend.
///
/// Numbers are on the scaled inputs and the standardised response unless their comment says otherwise. A
/// state without rows in X is a constant: its mean is y_centre, its variance constant_variance. Memory n².

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/kriging/detail/least_squares.hpp>
#include <drawpoint/kriging/detail/sites.hpp>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <drawpoint/kriging/detail/trend.hpp>
#include <drawpoint/kriging/options.hpp>
#include <limits>
#include <memory>

namespace drawpoint::kriging::detail {

struct ModelState {
  InputScale input;
  double y_centre = 0, y_scale = 1;  ///< y = y_centre + y_scale · standardised
  Eigen::VectorXd observed;          ///< y of the runs in its unit

  CorrelationFunction correlation;
  double nugget = 0;       ///< λ
  Eigen::VectorXd noise;   ///< wᵢ, n entries; empty: all 1
  double known_noise = 0;  ///< τ²; 0: s² was estimated
  double noise_unit = 1;   ///< noise variance in natural units that w = 1 stands for
  TrendFunction trend;

  Eigen::MatrixXd X, F;  ///< n x d and n x q
  Eigen::VectorXd y;     ///< n
  Eigen::MatrixXd L;     ///< n x n, lower triangular with zeros above: L Lᵀ = R
  LeastSquares gls;
  /// S, one row a parameter: V = S Sᵀ of (ln θ, exponents, ln λ); no columns: they are taken as known.
  Eigen::MatrixXd parameter_spread;
  double process_variance = 0;                                      ///< s²
  double log_likelihood = std::numeric_limits<double>::infinity();  ///< for y in its unit
  double constant_variance = 0;                                     ///< unit of y squared
  /// Another explanation of the same runs, without noise, and the probability of it; null: there is none.
  std::shared_ptr<const ModelState> other;
  double doubt = 0;
  FitReport report;
};

inline constexpr double hardly_likely = -5.0;  ///< in ln L: a probability of 0.007
inline constexpr double most_doubt = 0.99;     ///< of what a test has not confirmed

/// The probability of the explanation that is likelier by a gain in ln L.
inline double doubt_of(double gain) { return std::min(most_doubt, 1.0 / (1.0 + std::exp(-gain))); }

inline void forget_other(ModelState& s) {
  s.other.reset();
  s.doubt = 0;
}

/// What the diagonal of R has beyond that of C: n entries.
inline Eigen::VectorXd added_noise(const ModelState& s) {
  if (s.noise.size()) return affine(s.noise, s.nugget, noise_floor);
  return Eigen::VectorXd::Constant(s.X.rows(), s.nugget + (s.known_noise > 0 ? noise_floor : 0.0));
}

inline constexpr double exact_nugget = 1e-6;  // at most, of exact runs: round-off of smooth responses

/// How many runs tell of s²: all of them, but exact ones that repeat others tell nothing.
inline double independent_runs(const ModelState& s) {
  const auto n = static_cast<double>(s.X.rows());
  if (s.noise.size() > 0 || s.known_noise > 0 || s.nugget > exact_nugget) return n;
  const auto sites = sites_of(s.X);
  return repeats_agree(sites, s.y) ? static_cast<double>(sites.size()) : n;
}

/// Finds β, α and s² anew from L, F and y, and the likelihood with them.
inline void estimate(ModelState& s) {
  const double n = static_cast<double>(s.X.rows());
  s.gls = least_squares(s.L, s.F, s.y);
  s.process_variance =
      s.known_noise > 0 ? s.known_noise / s.nugget : s.gls.sum_of_squares / independent_runs(s);
  s.log_likelihood =
      concentrated_log_likelihood(s.L, s.gls.sum_of_squares, s.process_variance) - n * std::log(s.y_scale);
}

}  // namespace drawpoint::kriging::detail
