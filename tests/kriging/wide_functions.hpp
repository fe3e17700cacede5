// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Functions of eight, ten and twenty inputs on [0, 1]^d, most of them to judge the structures of a correlation by.
///
///   sum     Σ aₖ sin((2 + k mod 4) xₖ + k), aₖ = 1, ½ and ¼ in turn: each input alone
///   mixed   the sum and 0.3 Σ sin(2π xₖxₖ₊₁) of neighbouring pairs: nearly alone
///   pairs   Σ sin(2π xₖxₖ₊₁) of d/2 pairs: none is alone
///   radial  cos(6r), r = |x − c| about the centre of the box: all alike
///   friedman10  friedman5 with five inputs that do nothing
///   welch20     a few inputs do much, most nearly nothing, two pairs interact: Welch et al. 1992,
///               Technometrics 34(1), "Screening, predicting, and computer experiments", example 2
///   arm8        where a robot's arm of four joints ends, rough in its four angles; four lengths
///   nothing10   0, with noise of deviation 1

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <vector>

namespace drawpoint::kriging::reference {

inline double sum(const Eigen::VectorXd& x) {
  constexpr double amplitude[] = {1.0, 0.5, 0.25};
  double y = 0;
  for (Eigen::Index k = 0; k < x.size(); ++k)
    y += amplitude[k % 3] * std::sin(static_cast<double>(2 + k % 4) * x[k] + static_cast<double>(k));
  return y;
}

inline double pairs(const Eigen::VectorXd& x) {
  double y = 0;
  for (Eigen::Index k = 0; k + 1 < x.size(); k += 2) y += std::sin(2 * pi * x[k] * x[k + 1]);
  return y;
}

inline double mixed(const Eigen::VectorXd& x) { return sum(x) + 0.3 * pairs(x); }

inline double radial(const Eigen::VectorXd& x) { return std::cos(6 * (x.array() - 0.5).matrix().norm()); }

inline double friedman10(const Eigen::VectorXd& x) { return friedman5(x); }

inline double welch20(const Eigen::VectorXd& u) {
  const Eigen::VectorXd x = u.array() - 0.5;
  return 5 * x[11] / (1 + x[0]) + 5 * (x[3] - x[19]) * (x[3] - x[19]) + x[4] + 40 * std::pow(x[18], 3) -
         5 * x[18] + 0.05 * x[1] + 0.08 * x[2] - 0.03 * x[5] + 0.03 * x[6] - 0.09 * x[8] - 0.01 * x[9] -
         0.07 * x[10] + 0.25 * x[12] * x[12] - 0.04 * x[13] + 0.06 * x[14] - 0.01 * x[16] - 0.03 * x[17];
}

inline double robot_arm(const Eigen::VectorXd& x) {
  double u = 0, v = 0, angle = 0;
  for (int k = 0; k < 4; ++k) {
    angle += 2 * pi * x[k];
    u += x[4 + k] * std::cos(angle);
    v += x[4 + k] * std::sin(angle);
  }
  return std::hypot(u, v);
}

inline std::vector<TestFunction> wide_functions() {
  const auto plain = [](double (*f)(const Eigen::VectorXd&)) {
    return [f](const Eigen::VectorXd& x, doe::Seed) { return f(x); };
  };
  return {{"sum10", 10, 0, plain(sum)},
          {"sum20", 20, 0, plain(sum)},
          {"mixed10", 10, 0, plain(mixed)},
          {"mixed20", 20, 0, plain(mixed)},
          {"pairs10", 10, 0, plain(pairs)},
          {"pairs20", 20, 0, plain(pairs)},
          {"radial10", 10, 0, plain(radial)},
          {"radial20", 20, 0, plain(radial)},
          {"friedman10", 10, 0, plain(friedman10)},
          {"welch20", 20, 0, plain(welch20)},
          {"arm8", 8, 0, plain(robot_arm)},
          {"nothing10", 10, 1, [](const Eigen::VectorXd&, doe::Seed) { return 0.0; }}};
}

}  // namespace drawpoint::kriging::reference
