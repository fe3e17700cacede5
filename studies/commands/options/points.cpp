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

namespace {

/// Why it is no value of the variable, after "NAME = TEXT"; empty where it is one.
std::string complaint(const doe::Variable& v, double value) {
  using doe::detail::number_text;
  if (std::isnan(value))
    return " is no number" + (v.levels.empty() ? "" : "; give one of " + joined(v.levels));
  if (!(value >= v.lower && value <= v.upper))
    return " is outside its range " + number_text(v.lower) + " to " + doe::detail::with_unit(v.upper, v.unit);
  if (v.kind != doe::VariableKind::real && value != std::floor(value))
    return " is not whole; give a whole number from " + number_text(v.lower) + " to " + number_text(v.upper);
  return "";
}

/// Throws UsageError that begins with `before`.
double checked_value(const doe::Variable& v, const std::string& before, const std::string& text) {
  const double value = typed_value(v, text);
  if (const std::string why = complaint(v, value); !why.empty())
    throw UsageError(before + v.name + " = " +
                     (std::isnan(value) ? "\"" + text + "\"" : doe::detail::with_unit(value, v.unit)) + why);
  return value;
}

}  // namespace

Eigen::MatrixXd checked_points(const doe::Problem& problem, const std::vector<std::string>& x) {
  const auto& variables = problem.variables;
  const std::size_t d = variables.size();
  if (x.empty() || x.size() % d != 0)
    throw UsageError("--x: got " + std::to_string(x.size()) + " values, need " + std::to_string(d) + ": " +
                     joined(problem.variables, &doe::Variable::name));
  Eigen::MatrixXd points(static_cast<Eigen::Index>(x.size() / d), static_cast<Eigen::Index>(d));
  for (std::size_t i = 0; i < x.size(); ++i)
    points(static_cast<Eigen::Index>(i / d), static_cast<Eigen::Index>(i % d)) =
        checked_value(variables[i % d], "--x: ", x[i]);
  return points;
}

std::vector<std::string> typed(const Eigen::VectorXd& point) {
  std::vector<std::string> texts;
  for (const double value : point) texts.push_back(doe::detail::number_text(value));
  return texts;
}

Eigen::VectorXd point_named(const doe::Problem& problem, const std::string& option, const std::string& text) {
  const auto& variables = problem.variables;
  const auto refuse = [&](const std::string& what) {
    throw UsageError(option + ": " + what + "; give NAME=VALUE,... for each of " +
                     joined(problem.variables, &doe::Variable::name));
  };
  std::vector<std::optional<double>> x(variables.size());
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::string name = part.substr(0, part.find('='));
    const auto v = std::find_if(variables.begin(), variables.end(),
                                [&](const doe::Variable& variable) { return variable.name == name; });
    if (part.find('=') == part.npos || v == variables.end()) refuse("\"" + part + "\" names no variable");
    auto& value = x[static_cast<std::size_t>(v - variables.begin())];
    if (value) refuse(name + " stands there twice");
    value = checked_value(*v, option + ": ", part.substr(name.size() + 1));
  }
  Eigen::VectorXd point(static_cast<Eigen::Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!x[k]) refuse(variables[k].name + " is missing");
    point[static_cast<Eigen::Index>(k)] = *x[k];
  }
  return point;
}

}  // namespace drawpoint::studies
