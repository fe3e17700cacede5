// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points that a study or its user knows by name, shown as such on surfaces and fronts of the report. The one that
/// is called "reference" is what the recommendation of the report is compared with, in place of the middle of the box.

#include <drawpoint/doe/problem.hpp>

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct Mark {
  std::string name;
  Eigen::VectorXd x;  ///< d entries, natural units, within the box
};

/// "1.2,0.8": the values of a point as --x and --mark take them, to the last digit.
inline std::string typed_values(const Eigen::VectorXd& x) {
  std::string text;
  for (const double value : x) text += (text.empty() ? "" : ",") + doe::detail::number_text(value);
  return text;
}

inline constexpr const char* reference_name = "reference";

/// Throws std::invalid_argument where a mark has no name, another's name, lies outside of the box or
/// between whole values.
inline void check_marks(const doe::Problem& problem, const std::vector<Mark>& marks) {
  const auto reject = [](const Mark& mark, const std::string& what) {
    throw std::invalid_argument("studies::Mark \"" + mark.name + "\": " + what);
  };
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Mark& mark = marks[i];
    if (mark.name.empty()) reject(mark, "it has no name; give it one");
    for (std::size_t j = 0; j < i; ++j)
      if (marks[j].name == mark.name) reject(mark, "the name is given twice; give another one");
    if (mark.x.size() != static_cast<Eigen::Index>(problem.variables.size()))
      reject(mark, "it has " + std::to_string(mark.x.size()) + " values; give " +
                       std::to_string(problem.variables.size()) + ", one per variable");
    for (std::size_t k = 0; k < problem.variables.size(); ++k) {
      const doe::Variable& v = problem.variables[k];
      const double x = mark.x[static_cast<Eigen::Index>(k)];
      if (!(x >= v.lower && x <= v.upper))
        reject(mark, v.name + " = " + doe::detail::with_unit(x, v.unit) + " is outside its range " +
                         doe::detail::number_text(v.lower) + " to " +
                         doe::detail::with_unit(v.upper, v.unit) + "; give a value within it");
      if (v.kind != doe::VariableKind::real && x != std::floor(x))
        reject(mark, v.name + " = " + doe::detail::number_text(x) +
                         " is not whole; give a whole number from " + doe::detail::number_text(v.lower) +
                         " to " + doe::detail::number_text(v.upper));
    }
  }
}

/// The middle of the box, against which a recommendation is held where no mark is the reference: half way along each
/// variable, rounded down to a whole value where it has to be one.
inline Eigen::VectorXd middle_of(const doe::Problem& problem) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(problem.variables.size()));
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const doe::Variable& v = problem.variables[static_cast<std::size_t>(k)];
    const double half = v.lower + 0.5 * (v.upper - v.lower);
    x[k] = v.kind == doe::VariableKind::real ? half : std::floor(half);
  }
  return x;
}

}  // namespace drawpoint::studies
