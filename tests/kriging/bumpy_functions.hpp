// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Two functions of the adaptive sampling literature that are flat but for a part of their box: peaks on
/// [-5, 5]² (MATLAB's) and ring on [-2, 2]², a pit with a hill in it.

#include <Eigen/Core>
#include <cmath>

namespace drawpoint::kriging::reference {

inline double peaks(const Eigen::VectorXd& v) {
  const double x = v[0], y = v[1];
  return 3 * (1 - x) * (1 - x) * std::exp(-x * x - (y + 1) * (y + 1)) -
         10 * (x / 5 - x * x * x - std::pow(y, 5)) * std::exp(-x * x - y * y) -
         std::exp(-(x + 1) * (x + 1) - y * y) / 3;
}

inline double ring(const Eigen::VectorXd& x) {
  const double r2 = x.squaredNorm();
  return -4 * std::exp(-25.0 / 8 * r2) + 7 * std::exp(-125.0 / 4 * r2);
}

}  // namespace drawpoint::kriging::reference
