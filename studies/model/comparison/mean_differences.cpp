// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/comparison/mean_differences.h>
#include <drawpoint/doe/detail/students_t.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace drawpoint::studies {
namespace {

constexpr double level_of_differences = 0.95;

/// s²/n.
double variance_of_mean(const Eigen::VectorXd& y) {
  const double n = static_cast<double>(y.size());
  return (y.array() - y.mean()).square().sum() / (n - 1.0) / n;
}

/// Without variance only equal means have an interval: two values that differ alike prove nothing.
MeanDifference with_interval(double a, double b, double variance, double degrees_of_freedom) {
  MeanDifference difference{.a = a, .b = b, .degrees_of_freedom = degrees_of_freedom};
  const double none = a == b ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  const double half =
      variance > 0.0
          ? doe::detail::students_t_within(level_of_differences, degrees_of_freedom) * std::sqrt(variance)
          : none;
  difference.lower = difference.value() - half;
  difference.upper = difference.value() + half;
  return difference;
}

}  // namespace

MeanDifference paired_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  assert(a.size() == b.size() && a.size() >= 2);
  return with_interval(a.mean(), b.mean(), variance_of_mean(b - a), static_cast<double>(a.size() - 1));
}

MeanDifference independent_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  assert(a.size() >= 2 && b.size() >= 2);
  const double of_a = variance_of_mean(a), of_b = variance_of_mean(b), both = of_a + of_b;
  const double m = static_cast<double>(a.size() - 1), n = static_cast<double>(b.size() - 1);
  const double share = of_a / both;  // squares of variances may leave the range of numbers
  const double degrees = 1.0 / (share * share / m + (1.0 - share) * (1.0 - share) / n);
  // Rounding must not push it below the least that it can be; without variance it is unknown.
  return with_interval(a.mean(), b.mean(), both, both > 0.0 ? std::max(degrees, std::min(m, n)) : 0.0);
}

}  // namespace drawpoint::studies
