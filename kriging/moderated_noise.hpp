// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Variances that few samples tell, each drawn towards what all of them tell.
///
/// A variance of few samples is off by chance: of two samples one in ten is below 1.6 % of the true one, and a
/// fit that takes it for known goes through that run and is sure of it. Let the true variances be scattered as
/// the inverse of a χ² of d₀ degrees about s₀², and the told ones vᵢ as χ² of dᵢ degrees about these. Then the
/// true one of run i is expected at (d₀ s₀² + dᵢ vᵢ)/(d₀ + dᵢ). d₀ and s₀² follow from mean and variance of
/// ln vᵢ, which are ln s₀² + ψ(d/2) − ln(d/2) − ψ(d₀/2) + ln(d₀/2) and ψ'(d/2) + ψ'(d₀/2). Where the vᵢ scatter
/// no more than chance has it, d₀ is infinite and all are equal; where each has many degrees, none moves.
/// Source: Smyth 2004, Statistical Applications in Genetics and Molecular Biology 3(1), 3.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/detail/polygamma.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::kriging {

/// What all runs tell of the true variances: d₀ degrees about s₀².
struct SharedNoise {
  double variance = 0;  ///< s₀², unit of y squared
  double freedom = 0;   ///< d₀, > 0; infinite: all are s₀²

  /// What is expected of a run that tells this variance with so many degrees of freedom, >= 0.
  double expected(double told, double of_run) const {
    if (std::isinf(of_run)) return told;
    if (std::isinf(freedom)) return variance;
    return (freedom * variance + of_run * told) / (freedom + of_run);
  }
};

namespace detail {

inline void check_moderated(const Eigen::VectorXd& told, const Eigen::VectorXd& freedom) {
  const std::string place = "kriging::shared_noise: ";
  if (told.size() != freedom.size() || told.size() == 0)
    throw std::invalid_argument(place + std::to_string(told.size()) + " variances and " +
                                std::to_string(freedom.size()) +
                                " degrees of freedom; allowed is one or more and as many of both");
  for (Eigen::Index i = 0; i < told.size(); ++i)
    if (!(told[i] >= 0) || !std::isfinite(told[i]) || !(freedom[i] > 0))
      throw std::invalid_argument(place + "run " + std::to_string(i) + " has the variance " +
                                  std::to_string(told[i]) + " of " + std::to_string(freedom[i]) +
                                  " degrees of freedom; allowed are finite variances from 0 on and degrees "
                                  "above 0; leave out runs that tell nothing");
}

/// Variances of 0, whose logarithm is not finite, count as this.
inline double least_told(const Eigen::VectorXd& told) {
  std::vector<double> sorted(told.begin(), told.end());
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  return 1e-5 * std::max(sorted[sorted.size() / 2], 1e-5 * told.maxCoeff());
}

}  // namespace detail

/// told: n variances from 0 on, unit of y squared; freedom: the degrees of each, > 0, one less than its samples.
/// Throws std::invalid_argument for others.
inline SharedNoise shared_noise(const Eigen::VectorXd& told, const Eigen::VectorXd& freedom) {
  detail::check_moderated(told, freedom);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(told.size());
  if (!(told.maxCoeff() > 0)) return {0, infinite};
  // Degrees that are many beyond sense weigh as if they were a million: the sums stay finite.
  const Eigen::ArrayXd half = 0.5 * freedom.array().min(1e6);
  const double least = detail::least_told(told);
  Eigen::ArrayXd z(told.size());
  for (Eigen::Index i = 0; i < z.size(); ++i)
    z[i] = std::log(std::max(told[i], least)) - detail::digamma(half[i]) + std::log(half[i]);
  const double by_chance = half.unaryExpr(&detail::trigamma).mean();
  const double spread = n > 1 ? (z - z.mean()).square().sum() / (n - 1) - by_chance : 0.0;
  if (!(spread > 0)) return {(half * told.array()).sum() / half.sum(), infinite};
  const double h = detail::inverse_trigamma(spread);
  return {std::exp(z.mean() + detail::digamma(h) - std::log(h)), 2 * h};
}

/// Each of them as all together have it expected. Cost n. Throws as shared_noise.
inline Eigen::VectorXd moderated_noise(const Eigen::VectorXd& told, const Eigen::VectorXd& freedom) {
  const SharedNoise shared = shared_noise(told, freedom);
  Eigen::VectorXd variance(told.size());
  for (Eigen::Index i = 0; i < told.size(); ++i) variance[i] = shared.expected(told[i], freedom[i]);
  return variance;
}

/// The same where all have equally many degrees; infinite: as they are told.
inline Eigen::VectorXd moderated_noise(const Eigen::VectorXd& told, double freedom) {
  if (std::isinf(freedom)) return told;
  return moderated_noise(told, Eigen::VectorXd::Constant(told.size(), freedom));
}

}  // namespace drawpoint::kriging
