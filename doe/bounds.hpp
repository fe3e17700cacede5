// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The box of a problem as two vectors, and which of its variables are categories, for whatever takes them in
/// the order of its columns: kriging::FitOptions, a search of another library.

#include <Eigen/Core>
#include <vector>

#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe {

/// Length d, natural units.
inline Eigen::VectorXd lower_bounds(const Problem& problem) {
  Eigen::VectorXd bounds(static_cast<Eigen::Index>(problem.variables.size()));
  for (Eigen::Index k = 0; k < bounds.size(); ++k)
    bounds[k] = problem.variables[static_cast<std::size_t>(k)].lower;
  return bounds;
}

/// As lower_bounds().
inline Eigen::VectorXd upper_bounds(const Problem& problem) {
  Eigen::VectorXd bounds(static_cast<Eigen::Index>(problem.variables.size()));
  for (Eigen::Index k = 0; k < bounds.size(); ++k)
    bounds[k] = problem.variables[static_cast<std::size_t>(k)].upper;
  return bounds;
}

/// Per variable 0 for a number, and for a categorical one how many levels it has.
inline std::vector<int> level_counts(const Problem& problem) {
  std::vector<int> counts;
  for (const Variable& v : problem.variables)
    counts.push_back(v.kind == VariableKind::categorical ? static_cast<int>(v.levels.size()) : 0);
  return counts;
}

}  // namespace drawpoint::doe
