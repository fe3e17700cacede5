// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Test functions with limits, all objectives minimised, all limits at_most 0, variables in [0, 1] unless the
/// problem says otherwise.
///
/// BNH (Binh, Korn 1997) and OSY (Osyczka, Kundu 1995; its front has five pieces, most variables at bounds).
/// C2-DTLZ2 (Jain, Deb 2014): DTLZ2 within balls of radius 0.4 about the unit points and the middle of the
/// sphere. MW1, MW3, MW7 (Ma, Wang 2019, "Evolutionary constrained multiobjective optimization: test suite
/// construction and performance comparisons"), fifteen variables: MW1 leaves pieces of the line 0.85 f_1 +
/// f_2 = 1; MW3 and MW7 cut into the unconstrained front, so that the limits are parts of theirs.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>
#include <numbers>

namespace drawpoint::support {

/// d variables in [0, 1], m objectives, c limits.
inline doe::Problem limited_problem(int d, int m, int c) {
  doe::Problem problem = unit_problem(d, m);
  for (int k = 0; k < c; ++k) problem.responses.push_back({numbered("g", k), "1", doe::Goal::at_most, 0.0});
  return problem;
}

inline doe::Problem bnh_problem() {
  doe::Problem problem = limited_problem(2, 2, 2);
  problem.variables[0].upper = 5.0;
  problem.variables[1].upper = 3.0;
  return problem;
}

inline doe::Outcome bnh(const Eigen::VectorXd& x) {
  return {4.0 * x.squaredNorm(), (x.array() - 5.0).square().sum(),
          std::pow(x[0] - 5.0, 2) + x[1] * x[1] - 25.0,
          7.7 - std::pow(x[0] - 8.0, 2) - std::pow(x[1] + 3.0, 2)};
}

inline doe::Problem osy_problem() {
  doe::Problem problem = limited_problem(6, 2, 6);
  const double lower[] = {0, 0, 1, 0, 1, 0}, upper[] = {10, 10, 5, 6, 5, 10};
  for (std::size_t j = 0; j < 6; ++j) {
    problem.variables[j].lower = lower[j];
    problem.variables[j].upper = upper[j];
  }
  return problem;
}

inline doe::Outcome osy(const Eigen::VectorXd& x) {
  const auto square = [](double a) { return a * a; };
  return {-(25.0 * square(x[0] - 2.0) + square(x[1] - 2.0) + square(x[2] - 1.0) + square(x[3] - 4.0) +
            square(x[4] - 1.0)),
          x.squaredNorm(),
          1.0 - (x[0] + x[1]) / 2.0,
          (x[0] + x[1]) / 6.0 - 1.0,
          (x[1] - x[0]) / 2.0 - 1.0,
          (x[0] - 3.0 * x[1]) / 2.0 - 1.0,
          (square(x[2] - 3.0) + x[3]) / 4.0 - 1.0,
          1.0 - (square(x[4] - 3.0) + x[5]) / 4.0};
}

/// At most 0 within a ball of C2-DTLZ2.
inline double c2_limit(const Eigen::Vector3d& f) {
  double nearest = (f.array() - 1.0 / std::sqrt(3.0)).square().sum();
  for (int i = 0; i < 3; ++i) nearest = std::min(nearest, (f - Eigen::Vector3d::Unit(i)).squaredNorm());
  return nearest - 0.4 * 0.4;
}

inline doe::Outcome c2_dtlz2(const Eigen::VectorXd& x) {
  const Eigen::Vector3d f = dtlz2(x).values();
  return {f[0], f[1], f[2], c2_limit(f)};
}

namespace mw {

/// 1 at the best values of x_2..x_d.
inline double biased_distance(const Eigen::VectorXd& x) {
  const auto d = static_cast<double>(x.size());
  double g = 1.0;
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    const double off = std::pow(x[i], d - 2.0) - 0.5 - static_cast<double>(i) / (2.0 * d);
    g += 1.0 - std::exp(-10.0 * off * off);
  }
  return g;
}

inline double linked_distance(const Eigen::VectorXd& x) {
  double g = 1.0;
  for (Eigen::Index i = 1; i < x.size(); ++i)
    g += 2.0 * std::pow(x[i] + std::pow(x[i - 1] - 0.5, 2) - 1.0, 2);
  return g;
}

inline double wave(double size, double angle, int power) { return size * std::pow(std::sin(angle), power); }

/// How far √2 (f_2 - f_1) is along the line of MW1 and MW3, times π.
inline double along(double f1, double f2) { return std::numbers::pi * std::numbers::sqrt2 * (f2 - f1); }

/// Least f_1 + f_2 of MW3, and least √(f_1² + f_2²) of MW7.
inline double least_sum(double f1, double f2) { return 0.85 + wave(0.3, 0.75 * along(f1, f2), 2); }
inline double least_radius(double angle) { return 1.15 - wave(0.2, 4.0 * angle, 8); }

}  // namespace mw

inline doe::Outcome mw1(const Eigen::VectorXd& x) {
  const double f1 = x[0], f2 = mw::biased_distance(x) - 0.85 * f1;
  return {f1, f2, f1 + f2 - 1.0 - mw::wave(0.5, 2.0 * mw::along(f1, f2), 8)};
}

inline doe::Outcome mw3(const Eigen::VectorXd& x) {
  const double f1 = x[0], f2 = mw::linked_distance(x) - f1;
  return {f1, f2, f1 + f2 - 1.05 - mw::wave(0.45, 0.75 * mw::along(f1, f2), 6),
          mw::least_sum(f1, f2) - f1 - f2};
}

inline doe::Outcome mw7(const Eigen::VectorXd& x) {
  const double g = mw::linked_distance(x), f1 = g * x[0], f2 = g * std::sqrt(1.0 - x[0] * x[0]);
  const double angle = std::atan2(f2, f1), radius = std::hypot(f1, f2);
  const double most = 1.2 + std::abs(mw::wave(0.4, 4.0 * angle, 16));
  return {f1, f2, radius * radius - most * most, std::pow(mw::least_radius(angle), 2) - radius * radius};
}

}  // namespace drawpoint::support
