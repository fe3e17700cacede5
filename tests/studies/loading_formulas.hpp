// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Made-up loading studies: responses are formulas of the variables, and noise.

#include <drawpoint/studies/loading/loading_findings.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>

namespace drawpoint::studies::test {

using Eigen::Vector3d;
using Eigen::Vector4d;

inline const doe::Problem problem{.variables = {{"alpha", "1", 0.2, 2.0},
                                                {"beta", "1", 0.0, 1.0},
                                                {"gamma", "1", 0.0, 1.0},
                                                {"kappa", "1", 0.0, 1.0}},
                                  .responses = {{"production", "kg/s", doe::Goal::maximize},
                                                {"joint_damage", "s", doe::Goal::minimize},
                                                {"rock_spill", "1", doe::Goal::minimize}}};

inline Eigen::MatrixXd uniform_points(int n, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> u(0, 1);
  Eigen::MatrixXd X(n, 4);
  for (int i = 0; i < n; ++i)
    for (int v = 0; v < 4; ++v) X(i, v) = v == 0 ? 0.2 + 1.8 * u(bits) : u(bits);
  return X;
}

inline Eigen::MatrixXd with_corners(Eigen::MatrixXd X) {
  for (int c = 0; c < 16; ++c)
    X.row(c) << (c & 1 ? 2.0 : 0.2), (c & 2 ? 1.0 : 0.0), (c & 4 ? 1.0 : 0.0), (c & 8 ? 1.0 : 0.0);
  return X;
}

using Formula = std::function<Vector3d(const Vector4d&)>;

/// n training runs with the corners of the box among them; noise: standard deviation per response.
inline StudyResults results_of(int n, const Formula& f, const Vector3d& noise = Vector3d::Zero(),
                               unsigned seed = 1) {
  StudyResults results{.problem = problem,
                       .X = with_corners(uniform_points(n, seed)),
                       .Y = Eigen::MatrixXd(n, 3),
                       .X_new = uniform_points(100, seed + 1),
                       .Y_new = Eigen::MatrixXd::Zero(100, 3),
                       .logs = {},
                       .nrmse = {0.06, 0.16, 0.17}};
  std::mt19937 bits(seed + 1000);
  std::normal_distribution<double> normal;
  for (int i = 0; i < n; ++i) {
    results.Y.row(i) = f(results.X.row(i).transpose()).transpose();
    for (int r = 0; r < 3; ++r) results.Y(i, r) += noise[r] * normal(bits);
  }
  return results;
}

inline std::map<std::string, Finding> found(const StudyResults& results) {
  std::map<std::string, Finding> named;
  for (const Finding& finding : loading_findings(results)) named[finding.id] = finding;
  return named;
}

inline double hill(double x, double top, double width) { return std::exp(-std::pow((x - top) / width, 2)); }

/// As the source has it, but for the smoothness of the fronts: production leads by alpha with a top at 1.1,
/// damage and spill as its findings say. Deviations over the box: 190, 7.7, 0.062.
inline Vector3d as_the_source(const Vector4d& x) {
  return {-50 + 600 * hill(x[0], 1.1, 0.6) + 120 * x[1] - 60 * x[3] + 5 * x[2],
          12 * hill(x[0], 1.0, 0.5) + 25 * x[1] + 8 * hill(x[3], 0.4, 0.3),
          0.1 + 0.1 * x[0] + 0.06 * x[1] - 0.04 * x[3]};
}

/// The opposite: production falls with alpha and leads by gamma, damage and spill fall where they should
/// rise.
inline Vector3d otherwise(const Vector4d& x) {
  return {500 - 100 * hill(x[0], 1.1, 0.6) - 120 * x[1] + 60 * x[3] + 400 * x[2],
          20 - 10 * hill(x[0], 1.0, 0.5) - x[1] - 5 * hill(x[3], 0.4, 0.3) + 30 * x[2],
          1 - 0.1 * x[0] - 0.06 * x[1] + 0.2 * x[3]};
}

}  // namespace drawpoint::studies::test
