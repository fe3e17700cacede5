// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Test functions and point sets of multi-objective optimisation, all minimised.
///
/// ZDT1 (Zitzler, Deb, Thiele 2000): f_1 = x_1, f_2 = g (1 - sqrt(f_1/g)), g = 1 + 9 mean(x_2..x_d); front
/// f_2 = 1 - sqrt(f_1). ZDT2 has the hollow front f_2 = 1 - f_1², ZDT3 a front in five pieces, ZDT4 21^(d-1)
/// local fronts, ZDT6 a front whose points are rare and unevenly hit. DTLZ1 (Deb, Thiele, Laumanns, Zitzler
/// 2002), three objectives: front f_1 + f_2 + f_3 = 1/2 behind 11^(d-2) local ones; DTLZ2: front is the unit
/// sphere's positive octant; DTLZ7: four separate pieces. All variables are in [0, 1]; ZDT4 scales its own to
/// [-5, 5]. The point sets are those by which hypervolume and sorting programs are compared: splitmix64, row
/// by row.

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/doe/outcome.hpp>
#include <numbers>

namespace drawpoint::support {

inline doe::Outcome zdt1(const Eigen::VectorXd& x) {
  const double g = 1.0 + 9.0 * x.tail(x.size() - 1).mean();
  return {x[0], g * (1.0 - std::sqrt(x[0] / g))};
}

inline doe::Outcome zdt2(const Eigen::VectorXd& x) {
  const double g = 1.0 + 9.0 * x.tail(x.size() - 1).mean();
  return {x[0], g * (1.0 - (x[0] / g) * (x[0] / g))};
}

inline doe::Outcome zdt3(const Eigen::VectorXd& x) {
  const double g = 1.0 + 9.0 * x.tail(x.size() - 1).mean(), share = x[0] / g;
  return {x[0], g * (1.0 - std::sqrt(share) - share * std::sin(10.0 * std::numbers::pi * x[0]))};
}

inline doe::Outcome zdt4(const Eigen::VectorXd& x) {
  const Eigen::ArrayXd y = 10.0 * x.tail(x.size() - 1).array() - 5.0;
  const double g = 1.0 + (10.0 + y.square() - 10.0 * (4.0 * std::numbers::pi * y).cos()).sum();
  return {x[0], g * (1.0 - std::sqrt(x[0] / g))};
}

inline doe::Outcome zdt6(const Eigen::VectorXd& x) {
  const double f = 1.0 - std::exp(-4.0 * x[0]) * std::pow(std::sin(6.0 * std::numbers::pi * x[0]), 6);
  const double g = 1.0 + 9.0 * std::pow(x.tail(x.size() - 1).mean(), 0.25);
  return {f, g * (1.0 - (f / g) * (f / g))};
}

inline doe::Outcome dtlz1(const Eigen::VectorXd& x) {
  const Eigen::ArrayXd off = x.tail(x.size() - 2).array() - 0.5;
  const double waves = (off.square() - (20.0 * std::numbers::pi * off).cos()).sum();
  const double half = 0.5 * (1.0 + 100.0 * (static_cast<double>(off.size()) + waves));
  return {half * x[0] * x[1], half * x[0] * (1.0 - x[1]), half * (1.0 - x[0])};
}

inline doe::Outcome dtlz7(const Eigen::VectorXd& x) {
  const double g = 1.0 + 9.0 * x.tail(x.size() - 2).mean();
  double h = 3.0;
  for (int j = 0; j < 2; ++j) h -= x[j] / (1.0 + g) * (1.0 + std::sin(3.0 * std::numbers::pi * x[j]));
  return {x[0], x[1], (1.0 + g) * h};
}

inline doe::Outcome dtlz2(const Eigen::VectorXd& x) {
  const double g = (x.tail(x.size() - 2).array() - 0.5).square().sum();
  const double a = 0.5 * std::numbers::pi * x[0], b = 0.5 * std::numbers::pi * x[1];
  return {(1.0 + g) * std::cos(a) * std::cos(b), (1.0 + g) * std::cos(a) * std::sin(b),
          (1.0 + g) * std::sin(a)};
}

/// Standard normals made positive and put on the unit sphere: no point dominates another.
inline Eigen::MatrixXd sphere_points(int n, int m, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::MatrixXd Y(n, m);
  for (auto row : Y.rowwise()) {
    for (double& y : row) y = std::abs(random.normal());
    row.normalize();
  }
  return Y;
}

inline Eigen::MatrixXd cube_points(int n, int m, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::MatrixXd Y(n, m);
  for (auto row : Y.rowwise())
    for (double& y : row) y = random.uniform();
  return Y;
}

}  // namespace drawpoint::support
