// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Pairs of a true response and a cheaper one on [0, 1]^d, by which co-Kriging is judged.
///
/// forrester1: Forrester, Sóbester, Keane 2008, with A = 0.5, B = 10, C = −5. borehole8, currin2, park4a and
/// park4b: Xiong, Qian, Wu 2013, Technometrics 55(1), "Sequential design and analysis of high-accuracy and
/// low-accuracy computer codes". hartmann3: the usual one; the cheap one has the weights 0.5, 0.5, 2, 4.
/// unrelated2 is ours: currin2 beside waves that know nothing of it.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <functional>
#include <string>
#include <vector>

namespace drawpoint::kriging::reference {

struct FidelityPair {
  std::string name;
  int variables;
  std::function<double(const Eigen::VectorXd&)> truth, cheap;
};

inline double forrester1(const Eigen::VectorXd& x) {
  return std::pow(6 * x[0] - 2, 2) * std::sin(12 * x[0] - 4);
}

inline double rough_forrester1(const Eigen::VectorXd& x) {
  return 0.5 * forrester1(x) + 10 * (x[0] - 0.5) - 5;
}

/// borehole8 with other constants.
inline double rough_borehole8(const Eigen::VectorXd& u) {
  const auto at = [&](int k, double low, double high) { return low + (high - low) * u[k]; };
  const double rw = at(0, 0.05, 0.15), r = at(1, 100, 50000), Tu = at(2, 63070, 115600),
               Hu = at(3, 990, 1110), Tl = at(4, 63.1, 116), Hl = at(5, 700, 820), L = at(6, 1120, 1680),
               Kw = at(7, 9855, 12045);
  const double log_ratio = std::log(r / rw);
  return 5 * Tu * (Hu - Hl) / (log_ratio * (1.5 + 2 * L * Tu / (log_ratio * rw * rw * Kw) + Tu / Tl));
}

inline double currin2(double a, double b) {
  const double damped = b > 0 ? 1 - std::exp(-0.5 / b) : 1.0;
  return damped * (2300 * a * a * a + 1900 * a * a + 2092 * a + 60) /
         (100 * a * a * a + 500 * a * a + 4 * a + 20);
}

inline double rough_currin2(double a, double b) {
  const double low = std::max(0.0, b - 0.05);
  return 0.25 * (currin2(a + 0.05, b + 0.05) + currin2(a + 0.05, low) + currin2(a - 0.05, b + 0.05) +
                 currin2(a - 0.05, low));
}

inline double park4a(const Eigen::VectorXd& x) {
  // x₀/2 (√(1 + q/x₀²) − 1) without a division by 0
  const double q = (x[1] + x[2] * x[2]) * x[3];
  return 0.5 * (std::sqrt(x[0] * x[0] + q) - x[0]) + (x[0] + 3 * x[3]) * std::exp(1 + std::sin(x[2]));
}

inline double rough_park4a(const Eigen::VectorXd& x) {
  return (1 + 0.1 * std::sin(x[0])) * park4a(x) - 2 * x[0] + x[1] * x[1] + x[2] * x[2] + 0.5;
}

inline double park4b(const Eigen::VectorXd& x) {
  return 2.0 / 3.0 * std::exp(x[0] + x[1]) - x[3] * std::sin(x[2]) + x[2];
}

inline double weighted_hartmann3(const Eigen::VectorXd& x, const std::array<double, 4>& weight) {
  constexpr double A[4][3] = {{3, 10, 30}, {0.1, 10, 35}, {3, 10, 30}, {0.1, 10, 35}};
  constexpr double P[4][3] = {
      {0.3689, 0.1170, 0.2673}, {0.4699, 0.4387, 0.7470}, {0.1091, 0.8732, 0.5547}, {0.0381, 0.5743, 0.8828}};
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    double power = 0;
    for (int k = 0; k < 3; ++k) power += A[i][k] * std::pow(x[k] - P[i][k], 2);
    sum -= weight[i] * std::exp(-power);
  }
  return sum;
}

inline std::vector<FidelityPair> fidelity_pairs() {
  using Vector = Eigen::VectorXd;
  const auto currin = [](const Vector& x) { return currin2(x[0], x[1]); };
  return {{"forrester1", 1, forrester1, rough_forrester1},
          {"currin2", 2, currin, [](const Vector& x) { return rough_currin2(x[0], x[1]); }},
          {"hartmann3", 3,
           [](const Vector& x) {
             return weighted_hartmann3(x, {1.0, 1.2, 3.0, 3.2});
           },
           [](const Vector& x) {
             return weighted_hartmann3(x, {0.5, 0.5, 2.0, 4.0});
           }},
          {"park4a", 4, park4a, rough_park4a},
          {"park4b", 4, park4b, [](const Vector& x) { return 1.2 * park4b(x) - 1; }},
          {"borehole8", 8, borehole8, rough_borehole8},
          {"unrelated2", 2, currin,
           [](const Vector& x) { return std::cos(7 * x[0] - 5 * x[1]) + std::sin(9 * x[1] * x[1]); }}};
}

}  // namespace drawpoint::kriging::reference
