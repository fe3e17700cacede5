// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/points.h>
#include <drawpoint/studies/runs/settings.h>

#include <cmath>
#include <string>

namespace drawpoint::studies {

Eigen::MatrixXd checked_points(const doe::Problem& problem, const std::vector<double>& x) {
  const auto& variables = problem.variables;
  const std::size_t d = variables.size();
  if (x.empty() || x.size() % d != 0) {
    std::string names;
    for (const auto& v : variables) names += (names.empty() ? "" : ", ") + v.name;
    throw UsageError("--x: got " + std::to_string(x.size()) + " values, need " + std::to_string(d) + ": " +
                     names);
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const doe::Variable& v = variables[i % d];
    const bool inside = x[i] >= v.lower && x[i] <= v.upper;
    if (inside && v.kind != doe::VariableKind::real && x[i] != std::floor(x[i]))
      throw UsageError("--x: " + v.name + " = " + doe::detail::number_text(x[i]) +
                       " is not whole; give a whole number from " + doe::detail::number_text(v.lower) +
                       " to " + doe::detail::number_text(v.upper));
    if (inside) continue;
    throw UsageError("--x: " + v.name + " = " + doe::detail::with_unit(x[i], v.unit) +
                     " is outside its range " + doe::detail::number_text(v.lower) + " to " +
                     doe::detail::with_unit(v.upper, v.unit));
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(x.data(), static_cast<Eigen::Index>(x.size() / d),
                                    static_cast<Eigen::Index>(d));
}

}  // namespace drawpoint::studies
