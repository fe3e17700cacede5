// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/options/problem_text.h>

#include <algorithm>

namespace drawpoint::studies {
namespace {

std::string range_of(const doe::Variable& variable) {
  if (variable.levels.empty())
    return std::string(variable.kind == doe::VariableKind::integer ? "whole numbers, " : "") +
           doe::detail::number_text(variable.lower) + " to " +
           doe::detail::with_unit(variable.upper, variable.unit);
  std::string names;
  for (std::size_t i = 0; i < variable.levels.size(); ++i)
    names += (i ? ", " : "") + std::to_string(i) + " = " + variable.levels[i];
  return names;
}

std::string wanted_of(const doe::Response& response) {
  std::string text(to_string(response.goal));
  if (doe::is_constraint(response.goal))
    text += " " + doe::detail::with_unit(response.limit, response.unit);
  else if (!response.unit.empty() && response.unit != "1")
    text += ", " + response.unit;
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string described(const std::string& name, const std::string& what, const std::string& description) {
  std::string text = "  ";
  text += name + " (" + what + ")";
  if (!description.empty()) text += ": " + description;
  return text + "\n";
}

}  // namespace

std::string problem_text(const doe::Problem& problem) {
  std::string text = "Variables:\n";
  for (const auto& v : problem.variables) text += described(v.name, range_of(v), v.description);
  text += "Responses:\n";
  for (const auto& r : problem.responses) {
    std::string wanted = wanted_of(r);
    if (!r.standard_error.empty()) wanted += "; runs tell its " + r.standard_error;
    text += described(r.name, wanted, r.description);
  }
  return text;
}

}  // namespace drawpoint::studies
