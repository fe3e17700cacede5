// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is between the means of two samples, with a 95 % interval.
///
/// Paired: d = b - a value by value; mean d ± t(n-1) s_d/√n. Independent: Welch's, mean b - mean a ±
/// t(ν) √(s_a²/n_a + s_b²/n_b), ν = (s_a²/n_a + s_b²/n_b)² / ((s_a²/n_a)²/(n_a-1) + (s_b²/n_b)²/(n_b-1))
/// (Welch 1947). The intervals hold for normal values, and nearly for means of many others.

#include <Eigen/Core>
#include <cmath>

namespace drawpoint::studies {

/// Unit of the values.
struct MeanDifference {
  double a = 0, b = 0;          ///< the means
  double lower = 0, upper = 0;  ///< of the interval of b - a; NaN where values do not scatter and differ
  double degrees_of_freedom = 0;

  double value() const { return b - a; }
  bool has_interval() const { return std::isfinite(lower); }
  /// Whether there is an interval, and it leaves 0 out.
  bool is_told_apart() const { return lower > 0 || upper < 0; }
};

/// Requires two values or more, as many in b as in a.
MeanDifference paired_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// Requires two values or more in each.
MeanDifference independent_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace drawpoint::studies
