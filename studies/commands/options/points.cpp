// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/points.h>
#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/joined.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

namespace drawpoint::studies {

double typed_value(const doe::Variable& variable, const std::string& text) {
  const auto level = std::find(variable.levels.begin(), variable.levels.end(), text);
  if (level != variable.levels.end()) return static_cast<double>(level - variable.levels.begin());
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' ? std::numeric_limits<double>::quiet_NaN() : value;
}

Eigen::MatrixXd checked_points(const doe::Problem& problem, const std::vector<double>& x) {
  const auto& variables = problem.variables;
  const std::size_t d = variables.size();
  if (x.empty() || x.size() % d != 0)
    throw UsageError("--x: got " + std::to_string(x.size()) + " values, need " + std::to_string(d) + ": " +
                     joined(variables, &doe::Variable::name));
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

Eigen::VectorXd point_named(const doe::Problem& problem, const std::string& option, const std::string& text) {
  const auto refuse = [&](const std::string& what) {
    throw UsageError(option + ": " + what + "; give NAME=VALUE,... for each of " +
                     joined(problem.variables, &doe::Variable::name));
  };
  std::vector<std::optional<double>> x(problem.variables.size());
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::string name = part.substr(0, part.find('='));
    const auto v = std::find_if(problem.variables.begin(), problem.variables.end(),
                                [&](const doe::Variable& variable) { return variable.name == name; });
    if (part.find('=') == part.npos || v == problem.variables.end())
      refuse("\"" + part + "\" names no variable");
    auto& value = x[static_cast<std::size_t>(v - problem.variables.begin())];
    if (value) refuse(name + " stands there twice");
    value = typed_value(*v, part.substr(name.size() + 1));
    if (!std::isfinite(*value))
      refuse("\"" + part + "\" has no number" + (v->levels.empty() ? "" : " and no level"));
  }
  std::vector<double> point;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!x[k]) refuse(problem.variables[k].name + " is missing");
    point.push_back(*x[k]);
  }
  try {
    return checked_points(problem, point).row(0).transpose();
  } catch (const UsageError& e) {
    throw UsageError(option + std::string(e.what()).substr(std::string("--x").size()));
  }
}

}  // namespace drawpoint::studies
