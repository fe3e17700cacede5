// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/model/fits/words.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace drawpoint::studies::detail {

std::string number(double value) {
  if (!std::isfinite(value)) return "n/a";
  if (value == 0.0) return "0";
  char text[64];
  const double size = std::abs(value);
  if (size >= 1e6 || size < 1e-4) {
    std::snprintf(text, sizeof text, "%.2e", value);
  } else {
    const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(size))));
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
  }
  return text;
}

std::string number_with_unit(double value, const std::string& unit) {
  return number(value) + (unit.empty() || unit == "1" ? "" : " " + unit);
}

std::string percent(double share) {
  if (!std::isfinite(share)) return "n/a";
  char text[64];
  std::snprintf(text, sizeof text, share != 0.0 && std::abs(share) < 0.1 ? "%.1f %%" : "%.0f %%",
                100.0 * share);
  return text;
}

std::string pretty(const std::string& name) {
  std::string text = name;
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t k = 0; k < items.size(); ++k)
    text += (k == 0 ? "" : k + 1 == items.size() ? " and " : ", ") + items[k];
  return text;
}

std::string labelled(const std::string& name, const std::string& unit) {
  return name + (unit.empty() || unit == "1" ? "" : " [" + unit + "]");
}

namespace {

/// As near to 0 as no choice of this variable is told apart: a search ends beside a bound, not on it.
bool is_zero_of(const doe::Variable& variable, double x) {
  return variable.lower <= 0.0 && variable.upper >= 0.0 &&
         std::abs(x) < 1e-4 * (variable.upper - variable.lower);
}

}  // namespace

std::string superlative(const doe::Response& objective) {
  return objective.goal == doe::Goal::maximize ? "highest" : "lowest";
}

std::string setting(const doe::Variable& variable, double x) {
  if (variable.kind == doe::VariableKind::real) return number(is_zero_of(variable, x) ? 0.0 : x);
  const long long whole = std::llround(x);
  if (variable.kind == doe::VariableKind::integer) return std::to_string(whole);
  return pretty(variable.levels[static_cast<std::size_t>(whole)]);
}

std::string point_text(const doe::Problem& problem, const Eigen::VectorXd& x) {
  std::string text;
  for (std::size_t k = 0; k < problem.variables.size(); ++k) {
    const doe::Variable& v = problem.variables[k];
    const bool unit = v.kind != doe::VariableKind::categorical && !v.unit.empty() && v.unit != "1";
    text += (k ? ", " : "") + pretty(v.name) + " = " + setting(v, x[static_cast<Eigen::Index>(k)]) +
            (unit ? " " + v.unit : "");
  }
  return text;
}

}  // namespace drawpoint::studies::detail
