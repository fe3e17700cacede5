// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// From the unit box [0, 1]^d, where designs are made, to the box of a problem: x = lower + u·(upper -
/// lower), kept inside the bounds where rounding would leave them. Every design is n x d, one run a row,
/// natural units.

#include <Eigen/Core>
#include <algorithm>
#include <stdexcept>
#include <string>

#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe::detail {

inline double to_natural(double u, const Variable& v) {
  return std::clamp(v.lower + u * (v.upper - v.lower), v.lower, v.upper);
}

inline Eigen::MatrixXd to_natural(Eigen::MatrixXd unit, const Problem& problem) {
  for (Eigen::Index j = 0; j < unit.cols(); ++j)
    for (double& u : unit.col(j)) u = to_natural(u, problem.variables[j]);
  return unit;
}

/// Every design asks for a sound problem and at least one run.
inline void check_design(const char* place, const Problem& problem, int runs) {
  check(problem);
  if (runs < 1)
    throw std::invalid_argument(std::string(place) + ": runs is " + std::to_string(runs) +
                                "; allowed is 1 or more; ask for at least one run");
}

}  // namespace drawpoint::doe::detail
