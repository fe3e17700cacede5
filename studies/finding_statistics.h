// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Figures with their standard errors, from the runs of a study, and how they decide a claim.
///
/// A claim is that an effect is above 0. It is not reproduced when the effect is below `least`, the smallest
/// that would matter (0 or more), by more than two standard errors; else reproduced when it is above 0 by
/// more than two; else unclear. Two standard errors: a claim without truth is called reproduced in 2.3 % of
/// studies. Groups of fewer than five runs tell nothing: their standard error is then itself off by a third
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
};

Verdict verdict_of(const Criterion& criterion);

/// Reproduced if all are, not reproduced if one is not; the grounds name each effect with two standard
/// errors.
Finding decided(const std::string& id, const std::string& claim, const std::vector<Criterion>& criteria);

/// Spearman's; ties have the mean of their ranks. Standard error 1/√(n − 1), that of unrelated values.
Estimate rank_correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// a.value − b.value of independent estimates.
Estimate difference(const Estimate& a, const Estimate& b);

/// Mean of a less mean of b in standard deviations s within the two; error √(s_a²/n_a + s_b²/n_b)/s (Welch).
Estimate mean_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// Share k/n as (k + 2)/(n + 4), whose error √(p (1 − p)/(n + 4)) is not 0 at k = 0 (Agresti and Coull,
/// 1998).
Estimate share(int k, int n);

/// k/m less l/n; by chance they differ by √(p (1 − p) (1/m + 1/n)), p that of both together.
Estimate share_difference(int k, int m, int l, int n);

/// Share of y's variance between the thirds of [lower, upper] that x falls into: η², less what chance puts
/// there, 2/(n − 1). Error √(4 η² (1 − η²)²/n + (2/(n − 1))²): that of R² for large n, and of chance alone.
Estimate explained_share(const Eigen::VectorXd& x, const Eigen::VectorXd& y, double lower, double upper);

/// Range of y's means over those thirds, in standard deviations within the thirds, less what chance makes of
/// it: √(max(r² − 3.65 · 3/n, 0)), 3.65 the mean square of the range of three standard normal values. Error
/// √(6/n), that of the difference of two thirds.
Estimate profile_range(const Eigen::VectorXd& x, const Eigen::VectorXd& y, double lower, double upper);

/// Residual sum of squares of the best rising function of x, over that of the mean: 0 to 1.
double rising_residual(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// Largest distance of the distribution function of x from that of a uniform one (Kolmogorov's), times √n.
double distance_from_uniform(const Eigen::VectorXd& x, double lower, double upper);

}  // namespace drawpoint::studies
