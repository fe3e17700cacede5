// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Figures with their standard errors, and how they decide a claim.
///
/// A claim is that an effect is above 0. It is not reproduced when the effect is below `least`, the smallest
/// that would matter (0 or more), by more than two standard errors; else reproduced when it is above 0 by
/// more than two; else unclear. Two standard errors: a claim without truth is called reproduced in 2.3 % of
/// studies. Groups of fewer than five runs decide nothing: their standard error is then itself off by a third
/// (1/√8).

#include <drawpoint/studies/finding.hpp>

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

namespace drawpoint::studies {

constexpr Eigen::Index least_group = 5;  ///< runs

struct Estimate {
  double value =
      std::numeric_limits<double>::quiet_NaN();  ///< not a number: too few runs, or no variation in them
  double error = 0;                              ///< standard error
};

/// An effect that must be above 0.
struct Criterion {
  std::string effect;  ///< in a few words
  Estimate estimate;
  double least = 0;
  std::string unknown = {};  ///< why nothing is known of it; empty where that is plain
};

Verdict verdict_of(const Criterion& criterion);

/// Reproduced if all are, not reproduced if one is not; the grounds name each effect with two standard
/// errors.
Finding decided(const std::string& id, const std::string& claim, const std::vector<Criterion>& criteria);

/// Estimates an effect from draws of it: by the median, with half the distance to the farther of the quantiles 2.3 %
/// and 97.7 % as its standard error, which is the standard deviation of normal draws. Unknown where one of twenty or
/// more of the draws is not finite.
Estimate estimate_of(std::vector<double> draws);

/// Spearman's; ties have the mean of their ranks. Standard error 1/√(n − 1), that of unrelated values.
Estimate rank_correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// a.value − b.value of independent estimates.
Estimate difference(const Estimate& a, const Estimate& b);

/// Standard deviation, divided by n.
double deviation_of(const Eigen::VectorXd& y);

/// Means of y over the thirds of [lower, upper] that x falls into.
Eigen::Vector3d means_of_thirds(const Eigen::VectorXd& x, const Eigen::VectorXd& y, double lower,
                                double upper);

/// Share of y's variance between the points' thirds of x: η².
double explained_share(const Eigen::VectorXd& x, const Eigen::VectorXd& y, double lower, double upper);

/// Residual sum of squares of the best rising function of x, over that of the mean: 0 to 1.
double rising_residual(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// Largest distance of the distribution function of x from that of a uniform one (Kolmogorov's), times √n.
double distance_from_uniform(const Eigen::VectorXd& x, double lower, double upper);

}  // namespace drawpoint::studies
