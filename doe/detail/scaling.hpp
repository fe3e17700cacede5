// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// From the unit box [0, 1]^d, where designs are made, to the box of a problem and back.
///
/// A real variable: x = lower + u·(upper - lower), kept inside the bounds where rounding would leave them. An
/// integer or categorical one of L values: the unit interval is cut in L equal parts, x = lower + floor(u·L),
/// u = 1 in the last; back again at the middle of the part. So a design that is even in u is even over the
/// values. Every design is n x d, one run per row, natural units.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe::detail {

inline bool is_discrete(const Variable& v) { return v.kind != VariableKind::real; }

/// How many values an integer or categorical variable takes.
inline double value_count(const Variable& v) { return v.upper - v.lower + 1.0; }

inline double to_natural(double u, const Variable& v) {
  if (is_discrete(v)) return std::clamp(v.lower + std::floor(u * value_count(v)), v.lower, v.upper);
  return std::clamp(v.lower + u * (v.upper - v.lower), v.lower, v.upper);
}

inline double to_unit(double x, const Variable& v) {
  if (is_discrete(v)) return (x - v.lower + 0.5) / value_count(v);
  return (x - v.lower) / (v.upper - v.lower);
}

inline Eigen::MatrixXd to_natural(Eigen::MatrixXd unit, const Problem& problem) {
  for (Eigen::Index j = 0; j < unit.cols(); ++j)
    for (double& u : unit.col(j)) u = to_natural(u, problem.variables[j]);
  return unit;
}

/// The same for a Latin design of unit.rows() strata: an integer or categorical variable takes the middle of
/// each stratum, so that the counts of its values differ by at most one.
inline Eigen::MatrixXd latin_to_natural(Eigen::MatrixXd unit, const Problem& problem) {
  const auto n = static_cast<double>(unit.rows());
  for (Eigen::Index j = 0; j < unit.cols(); ++j)
    if (is_discrete(problem.variables[j]))
      for (double& u : unit.col(j)) u = (std::floor(u * n) + 0.5) / n;
  return to_natural(std::move(unit), problem);
}

/// Throws std::invalid_argument that names row and variable when X is not n x d inside the bounds of the
/// problem.
inline void check_inside(const Eigen::MatrixXd& X, const Problem& problem, const std::string& place) {
  check(problem);
  if (X.cols() != static_cast<Eigen::Index>(problem.variables.size()))
    throw std::invalid_argument(place + ": X has " + std::to_string(X.cols()) + " columns, the problem has " +
                                std::to_string(problem.variables.size()) +
                                " variables; X is n x d with one run per row");
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      const Variable& v = problem.variables[j];
      const bool inside = X(i, j) >= v.lower && X(i, j) <= v.upper;
      if (inside && (!is_discrete(v) || X(i, j) == std::floor(X(i, j)))) continue;
      throw std::invalid_argument(place + ": row " + std::to_string(i) + ", variable \"" + v.name +
                                  "\": " + with_unit(X(i, j), v.unit) + " is not " +
                                  (is_discrete(v) ? "a whole number from " : "within ") +
                                  with_unit(v.lower, v.unit) + " to " + with_unit(v.upper, v.unit) +
                                  "; correct the point or the bounds");
    }
}

/// X (n x d, natural units) in the unit box, after the checks.
inline Eigen::MatrixXd to_unit_box(Eigen::MatrixXd X, const Problem& problem, const std::string& place) {
  check_inside(X, problem, place);
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    for (double& x : X.col(j)) x = to_unit(x, problem.variables[j]);
  return X;
}

/// Every design asks for a sound problem and at least one run.
inline void check_design(const char* place, const Problem& problem, int runs) {
  check(problem);
  if (runs < 1)
    throw std::invalid_argument(std::string(place) + ": runs is " + std::to_string(runs) +
                                "; allowed is 1 or more; ask for at least one run");
}

}  // namespace drawpoint::doe::detail
