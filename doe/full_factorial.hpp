// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Full factorial: every combination of L_j equally spaced levels, bounds included, in variable j.
///
/// x_j = lower + k·(upper - lower)/(L_j - 1), k = 0..L_j-1; a single level stands at the middle of the range.
/// An integer or categorical variable takes L_j of its values, as evenly spaced as they can be.
/// Rows in lexicographic order, the last variable fastest. n = Π L_j, cost O(n d).

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/scaling.hpp>

namespace drawpoint::doe {

namespace detail {

/// Π levels, after the checks.
inline int factorial_runs(const Problem& problem, std::span<const int> levels) {
  check(problem);
  const std::string place = "doe::full_factorial: ";
  if (levels.size() != problem.variables.size())
    throw std::invalid_argument(place + "levels has " + std::to_string(levels.size()) +
                                " entries, the problem has " + std::to_string(problem.variables.size()) +
                                " variables; give one per variable");
  std::int64_t runs = 1;
  for (std::size_t j = 0; j < levels.size(); ++j) {
    if (levels[j] < 1)
      throw std::invalid_argument(place + "variable \"" + problem.variables[j].name + "\" has " +
                                  std::to_string(levels[j]) +
                                  " levels; allowed is 1 or more; 2 gives the bounds");
    const Variable& v = problem.variables[j];
    if (is_discrete(v) && levels[j] > value_count(v))
      throw std::invalid_argument(place + "variable \"" + v.name + "\" has " + std::to_string(levels[j]) +
                                  " levels but takes only " + number_text(value_count(v)) +
                                  " values; ask for no more levels than values");
    runs *= levels[j];
    if (runs > std::numeric_limits<int>::max())
      throw std::invalid_argument(place +
                                  "more than 2^31 - 1 runs; use fewer levels or a space-filling design");
  }
  return static_cast<int>(runs);
}

}  // namespace detail

/// n x d with levels[j] levels in variable j. Throws std::invalid_argument on a wrong count or a level
/// below 1.
inline Eigen::MatrixXd full_factorial(const Problem& problem, std::span<const int> levels) {
  const int runs = detail::factorial_runs(problem, levels);
  Eigen::MatrixXd U(runs, static_cast<Eigen::Index>(levels.size()));
  int repeat = 1;  // how many rows in succession share the level of variable j
  for (Eigen::Index j = U.cols() - 1; j >= 0; --j) {
    const int count = levels[j];
    for (int i = 0; i < runs; ++i)
      U(i, j) = count == 1 ? 0.5 : static_cast<double>(i / repeat % count) / (count - 1);
    repeat *= count;
  }
  return detail::to_natural(std::move(U), problem);
}

/// The same number of levels in every real variable; an integer variable has no more than its values, and a
/// categorical one all of its levels.
inline Eigen::MatrixXd full_factorial(const Problem& problem, int levels) {
  std::vector<int> of_each(problem.variables.size(), levels);
  for (std::size_t j = 0; j < of_each.size(); ++j) {
    const Variable& v = problem.variables[j];
    if (v.kind == VariableKind::integer)
      of_each[j] = std::min(levels, static_cast<int>(std::min(detail::value_count(v), 1e9)));
    if (v.kind == VariableKind::categorical) of_each[j] = static_cast<int>(v.levels.size());
  }
  return full_factorial(problem, of_each);
}

}  // namespace drawpoint::doe
