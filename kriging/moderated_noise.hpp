// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Variances of few samples, each drawn towards those of all.
///
/// A variance of few samples is off by chance: of two samples one in ten is below 1.6 % of the true one, and a
/// fit that takes it for known goes through that run and is sure of it. Let the true precisions 1/σᵢ² scatter as a χ²
/// of d₀ degrees, with the mean 1/s₀², and the variances vᵢ of samples as χ² of dᵢ degrees about σᵢ². Then the
/// precision of run i is expected at the inverse of (d₀ s₀² + dᵢ vᵢ)/(d₀ + dᵢ), which is what a fit weighs it by. d₀
/// and s₀² follow from mean and variance of ln vᵢ, which are ln s₀² + ψ(d/2) − ln(d/2) − ψ(d₀/2) + ln(d₀/2) and ψ'(d/2)
/// + ψ'(d₀/2). Where the vᵢ scatter no more than chance has it, d₀ is infinite and all are equal; where each has many
/// degrees, none moves. The scatter is taken one standard error lower than it is found, so that few runs err towards
/// one variance; and where some vᵢ are 0, which samples of a normal variable never are, all are equal. Source: Smyth
/// 2004, Statistical Applications in Genetics and Molecular Biology 3(1), 3.

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/kriging/detail/polygamma.hpp>
#include <drawpoint/kriging/detail/training_data.hpp>
#include <limits>
#include <stdexcept>
#include <string>

namespace drawpoint::kriging {

/// How the true variances of all runs scatter: d₀ degrees about s₀².
struct SharedNoise {
  double variance = 0;  ///< s₀², unit of y squared
  double freedom = 0;   ///< d₀, > 0; infinite: all are s₀²

  /// The inverse of the precision that is expected of a run with a variance of so many degrees of freedom, > 0.
  double moderated(double own, double of_own) const {
    if (std::isinf(of_own)) return own;
    if (std::isinf(freedom)) return variance;
    return (freedom * variance + of_own * own) / (freedom + of_own);
  }
};

namespace detail {

inline void check_moderated(const Eigen::VectorXd& own, const Eigen::VectorXd& freedom) {
  const std::string place = "kriging::shared_noise: ";
  if (own.size() != freedom.size() || own.size() == 0)
    throw std::invalid_argument(place + std::to_string(own.size()) + " variances and " +
                                std::to_string(freedom.size()) +
                                " degrees of freedom; allowed is one or more and as many of both");
  for (Eigen::Index i = 0; i < own.size(); ++i)
    if (!(own[i] >= 0) || !std::isfinite(own[i]) || !(freedom[i] > 0))
      throw std::invalid_argument(place + "run " + std::to_string(i) + " has the variance " + text(own[i]) +
                                  " of " + text(freedom[i]) +
                                  " degrees of freedom; allowed are finite variances from 0 on and degrees "
                                  "above 0; leave out runs that report none");
}

/// The variance of ln v that chance gives, ψ'(d/2), and one standard error of what n values show of it: the logarithm
/// of a χ² of d degrees has an excess kurtosis below 5/d.
inline double scatter_by_chance(const Eigen::ArrayXd& half) {
  const auto n = static_cast<double>(half.size());
  const double excess = (2.5 / half).mean();
  return half.unaryExpr(&trigamma).mean() * (1.0 + std::sqrt((2.0 + excess) / n));
}

}  // namespace detail

/// own: n variances from 0 on, unit of y squared; freedom: the degrees of each, > 0, one less than its samples.
/// Throws std::invalid_argument for others.
inline SharedNoise shared_noise(const Eigen::VectorXd& own, const Eigen::VectorXd& freedom) {
  detail::check_moderated(own, freedom);
  // Degrees that are many beyond sense weigh as if they were a million: the sums stay finite.
  const Eigen::ArrayXd half = 0.5 * freedom.array().min(1e6);
  const SharedNoise equal{(half * own.array()).sum() / half.sum(), std::numeric_limits<double>::infinity()};
  if (own.size() < 3 || !(own.minCoeff() > 0)) return equal;
  Eigen::ArrayXd z(own.size());
  for (Eigen::Index i = 0; i < z.size(); ++i)
    z[i] = std::log(own[i]) - detail::digamma(half[i]) + std::log(half[i]);
  const double found = (z - z.mean()).square().sum() / static_cast<double>(z.size() - 1);
  const double scatter = found - detail::scatter_by_chance(half);
  if (!(scatter > 0)) return equal;
  const double h = detail::inverse_trigamma(scatter);
  return {std::exp(z.mean() + detail::digamma(h) - std::log(h)), 2 * h};
}

/// Each of them moderated by all. Cost n. Throws as shared_noise.
inline Eigen::VectorXd moderated_noise(const Eigen::VectorXd& own, const Eigen::VectorXd& freedom) {
  const SharedNoise shared = shared_noise(own, freedom);
  Eigen::VectorXd variance(own.size());
  for (Eigen::Index i = 0; i < own.size(); ++i) variance[i] = shared.moderated(own[i], freedom[i]);
  return variance;
}

/// The same where all have equally many degrees; infinite: as they are.
inline Eigen::VectorXd moderated_noise(const Eigen::VectorXd& own, double freedom) {
  if (std::isinf(freedom)) return own;
  return moderated_noise(own, Eigen::VectorXd::Constant(own.size(), freedom));
}

}  // namespace drawpoint::kriging
