// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Functions whose Sobol' indices are known exactly.
///
///   Ishigami   sin x₁ + a sin²x₂ + b x₃⁴ sin x₁ on [−π, π]³, a = 7, b = 0.1:
///              V₁ = ½(1 + bπ⁴/5)², V₂ = a²/8, V₁₃ = b²π⁸(1/18 − 1/50), all others 0
///   g-function Π (|4x_j − 2| + a_j)/(1 + a_j) on [0, 1]⁴: V_j = 1/(3(1 + a_j)²), V = Π(1 + V_j) − 1, V_jk = V_j V_k,
///              T_j V = V_j Π_{k≠j}(1 + V_k)
///   additive   Σ c_j x_j on boxes of width w_j: S_j = T_j = (c_j w_j)² / Σ (c_k w_k)²

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <functional>
#include <numbers>
#include <string>

namespace drawpoint::support {

struct SensitivityCase {
  std::string name;
  doe::Problem problem;
  std::function<double(const Eigen::VectorXd&)> f;
  double mean, variance;
  Eigen::VectorXd first, total;
  Eigen::MatrixXd second;  ///< symmetric, 0 on the diagonal
};

inline SensitivityCase ishigami() {
  constexpr double a = 7, b = 0.1, pi = std::numbers::pi;
  doe::Problem problem = unit_problem(3);
  for (auto& v : problem.variables) v.lower = -pi, v.upper = pi;
  const auto f = [](const Eigen::VectorXd& x) {
    return std::sin(x[0]) + a * std::pow(std::sin(x[1]), 2) + b * std::pow(x[2], 4) * std::sin(x[0]);
  };
  const double v1 = 0.5 * std::pow(1 + b * std::pow(pi, 4) / 5, 2), v2 = a * a / 8;
  const double v13 = b * b * std::pow(pi, 8) * (1.0 / 18 - 1.0 / 50), v = v1 + v2 + v13;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  second(0, 2) = second(2, 0) = v13 / v;
  return {"Ishigami",
          problem,
          f,
          a / 2,
          v,
          Eigen::Vector3d(v1, v2, 0) / v,
          Eigen::Vector3d(v1 + v13, v2, v13) / v,
          second};
}

inline SensitivityCase g_function() {
  const Eigen::Vector4d a(0, 1, 4.5, 9);
  const auto f = [a](const Eigen::VectorXd& x) -> double {
    return (((4 * x.array() - 2).abs() + a.array()) / (1 + a.array())).prod();
  };
  const Eigen::Array4d vj = 1 / (3 * (1 + a.array()).square());
  const double all = (1 + vj).prod(), v = all - 1;
  Eigen::Matrix4d second = vj.matrix() * vj.matrix().transpose() / v;
  second.diagonal().setZero();
  return {"g-function", unit_problem(4), f, 1.0, v, vj / v, vj * all / (1 + vj) / v, second};
}

inline constexpr double additive_slopes[] = {3, -1, 0.5};

inline SensitivityCase additive() {
  doe::Problem problem = unit_problem(3);
  problem.variables[1].upper = 4;
  const Eigen::Vector3d slope(additive_slopes[0], additive_slopes[1], additive_slopes[2]);
  const auto f = [slope](const Eigen::VectorXd& x) { return slope.dot(x); };
  const Eigen::Array3d part = (slope.array() * Eigen::Array3d(1, 4, 1)).square() / 12;
  const Eigen::VectorXd share = part / part.sum();
  return {"additive", problem, f,     slope.dot(Eigen::Vector3d(0.5, 2, 0.5)),
          part.sum(), share,   share, Eigen::Matrix3d::Zero()};
}

}  // namespace drawpoint::support
