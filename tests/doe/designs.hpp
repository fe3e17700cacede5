// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Laws of designs that several tests check, written without the library's own measures.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <map>
#include <vector>

namespace drawpoint::support {

inline bool inside(const doe::Problem& problem, const Eigen::MatrixXd& X) {
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    if (X.col(j).minCoeff() < problem.variables[j].lower || X.col(j).maxCoeff() > problem.variables[j].upper)
      return false;
  return true;
}

/// Whether each of n equal strata of every variable holds one run: the i-th smallest lies in [i, i+1]/n. The
/// tolerance, in strata, covers the rounding of lower + u·(upper - lower) and back: a few ulp of the largest
/// bound.
inline bool is_latin(const doe::Problem& problem, const Eigen::MatrixXd& X) {
  const auto n = static_cast<double>(X.rows());
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    const doe::Variable& v = problem.variables[j];
    const double range = v.upper - v.lower;
    const double tolerance = n * 4e-16 * (4.0 + std::max(std::abs(v.lower), std::abs(v.upper)) / range);
    Eigen::VectorXd u = n * (X.col(j).array() - v.lower) / range;
    std::sort(u.begin(), u.end());
    for (Eigen::Index i = 0; i < u.size(); ++i)
      if (u[i] < static_cast<double>(i) - tolerance || u[i] > static_cast<double>(i + 1) + tolerance)
        return false;
  }
  return true;
}

/// Whether the numbers are whole and the counts of lower..upper differ by at most one.
inline bool is_balanced(const Eigen::VectorXd& x, const doe::Variable& v) {
  std::map<int, int> held;
  for (double level = v.lower; level <= v.upper; ++level) held[static_cast<int>(level)] = 0;
  for (const double value : x) {
    if (value != std::floor(value) || !held.count(static_cast<int>(value))) return false;
    ++held[static_cast<int>(value)];
  }
  int least = static_cast<int>(x.size()), most = 0;
  for (const auto& [level, count] : held) {
    least = std::min(least, count);
    most = std::max(most, count);
  }
  return most - least <= 1;
}

/// Two real variables, an integer one of 5 values and a categorical one of 3 levels.
inline doe::Problem mixed_problem() {
  return {{{"length", "m", 0.5, 2.0},
           {"angle", "deg", -25.0, 5.0},
           doe::integer_variable("teeth", "1", 2, 6),
           doe::categorical_variable("tool", {"bucket", "blade", "ripper"})},
          {{"cost", "EUR", doe::Goal::minimize}}};
}

}  // namespace drawpoint::support
