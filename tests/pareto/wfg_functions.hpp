// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Four of the WFG test functions, two objectives, four position and twenty distance variables.
///
/// Huband, Hingston, Barone, While 2006, "A review of multiobjective test problems and a scalable test
/// problem toolkit". Variable i lies in [0, 2i]. A chain of transformations leads to a position p and a
/// distance t; f_1 = t + 2 h_1(p), f_2 = t + 4 h_2(p), and the front is t = 0. WFG1: flat, strongly biased, a
/// wavy front; WFG2: non-separable, a front in pieces; WFG4: 30 hills in each variable; WFG9: non-separable,
/// deceptive, each variable biased by those after it. On the ellipse (f_1/2)² + (f_2/4)² = 1 lie the fronts of the
/// last two.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <numbers>

namespace drawpoint::support {

inline constexpr int wfg_position = 4, wfg_variables = 24;

inline doe::Problem wfg_problem() {
  doe::Problem problem = unit_problem(wfg_variables, 2);
  for (int i = 0; i < wfg_variables; ++i)
    problem.variables[static_cast<std::size_t>(i)].upper = 2.0 * (i + 1);
  return problem;
}

namespace wfg {

using Values = Eigen::VectorXd;

inline Values in_unit_box(const Values& z) {
  return z.cwiseQuotient(Values::LinSpaced(z.size(), 2.0, 2.0 * static_cast<double>(z.size())));
}

inline double shift_linear(double y, double a) { return std::abs(y - a) / std::abs(std::floor(a - y) + a); }

inline double shift_multi_modal(double y, double hills, double b, double c) {
  const double r = std::abs(y - c) / (2.0 * (std::floor(c - y) + c));
  return (1.0 + std::cos((4.0 * hills + 2.0) * std::numbers::pi * (0.5 - r)) + 4.0 * b * r * r) / (b + 2.0);
}

inline double shift_deceptive(double y, double a, double b, double c) {
  const double low = std::floor(y - a + b) * (1.0 - c + (a - b) / b) / (a - b);
  const double high = std::floor(a + b - y) * (1.0 - c + (1.0 - a - b) / b) / (1.0 - a - b);
  return 1.0 + (std::abs(y - a) - b) * (low + high + 1.0 / b);
}

/// a between b and c.
inline double flat(double y, double a, double b, double c) {
  return a + std::min(0.0, std::floor(y - b)) * a * (b - y) / b -
         std::min(0.0, std::floor(c - y)) * (1.0 - a) * (y - c) / (1.0 - c);
}

/// Variable i counts 2i times.
inline double weighted_mean(const Values& y, Eigen::Index first, Eigen::Index count) {
  const Values weight =
      Values::LinSpaced(count, static_cast<double>(first + 1), static_cast<double>(first + count));
  return y.segment(first, count).dot(weight) / weight.sum();
}

/// u: mean of the variables that decide the bias.
inline double bias(double y, double u) {
  const double a = 0.98 / 49.98, b = 0.02, c = 50.0;
  return std::pow(y, b + (c - b) * (a - (1.0 - 2.0 * u) * std::abs(std::floor(0.5 - u) + a)));
}

/// Degree of non-separability: the length of y.
inline double non_separable(const Values& y) {
  const auto n = static_cast<double>(y.size());
  double sum = y.sum();
  for (Eigen::Index j = 0; j < y.size(); ++j)
    for (Eigen::Index k = 0; k + 1 < y.size(); ++k) sum += std::abs(y[j] - y[(j + k + 1) % y.size()]);
  const double half = std::ceil(n / 2.0);
  return sum / (half * (1.0 + 2.0 * n - 2.0 * half));
}

inline doe::Outcome on_the_ellipse(double position, double distance) {
  const double angle = 0.5 * std::numbers::pi * position;
  return {distance + 2.0 * std::sin(angle), distance + 4.0 * std::cos(angle)};
}

/// h_1 of WFG1 and 2, h_2 of WFG1, h_2 of WFG2.
inline double convex(double p) { return 1.0 - std::cos(0.5 * std::numbers::pi * p); }
inline double wavy(double p) {
  return 1.0 - p - std::cos(10.0 * std::numbers::pi * p + 0.5 * std::numbers::pi) / (10.0 * std::numbers::pi);
}
inline double in_pieces(double p) { return 1.0 - p * std::pow(std::cos(5.0 * std::numbers::pi * p), 2); }

}  // namespace wfg

inline doe::Outcome wfg1(const Eigen::VectorXd& z) {
  Eigen::VectorXd y = wfg::in_unit_box(z);
  const Eigen::Index rest = y.size() - wfg_position;
  for (double& value : y.tail(rest)) {
    const double distance = wfg::flat(wfg::shift_linear(value, 0.35), 0.8, 0.75, 0.85);
    value = distance < 1e-14 ? 0.0 : distance;  // rounding, of which the power makes a half
  }
  for (double& value : y) value = std::pow(value, 0.02);
  const double distance = wfg::weighted_mean(y, wfg_position, rest);
  const double position = wfg::weighted_mean(y, 0, wfg_position);
  return {distance + 2.0 * wfg::convex(position), distance + 4.0 * wfg::wavy(position)};
}

inline doe::Outcome wfg2(const Eigen::VectorXd& z) {
  Eigen::VectorXd y = wfg::in_unit_box(z);
  for (double& value : y.tail(y.size() - wfg_position)) value = wfg::shift_linear(value, 0.35);
  double distance = 0.0;
  for (Eigen::Index i = wfg_position; i < y.size(); i += 2) distance += wfg::non_separable(y.segment(i, 2));
  distance /= static_cast<double>(y.size() - wfg_position) / 2.0;
  const double position = y.head(wfg_position).mean();
  return {distance + 2.0 * wfg::convex(position), distance + 4.0 * wfg::in_pieces(position)};
}

inline doe::Outcome wfg4(const Eigen::VectorXd& z) {
  Eigen::VectorXd y = wfg::in_unit_box(z);
  for (double& value : y) value = wfg::shift_multi_modal(value, 30.0, 10.0, 0.35);
  return wfg::on_the_ellipse(y.head(wfg_position).mean(), y.tail(y.size() - wfg_position).mean());
}

inline doe::Outcome wfg9(const Eigen::VectorXd& z) {
  const Eigen::VectorXd y = wfg::in_unit_box(z);
  const Eigen::Index n = y.size();
  Eigen::VectorXd t = y;
  for (Eigen::Index i = 0; i + 1 < n; ++i) t[i] = wfg::bias(y[i], y.tail(n - 1 - i).mean());
  for (Eigen::Index i = 0; i < n; ++i)
    t[i] = i < wfg_position ? wfg::shift_deceptive(t[i], 0.35, 0.001, 0.05)
                            : wfg::shift_multi_modal(t[i], 30.0, 95.0, 0.35);
  return wfg::on_the_ellipse(wfg::non_separable(t.head(wfg_position)),
                             wfg::non_separable(t.tail(n - wfg_position)));
}

}  // namespace drawpoint::support
