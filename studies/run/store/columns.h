// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Column names of the table of runs: the names of the problem, quoted for SQL. A name that is taken already
/// (by a fixed column or by another name; SQLite ignores case) gets "x_" or "y_" in front.

#include <drawpoint/doe/problem.hpp>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// Quoted column names in the order of the problem.
struct Columns {
  std::vector<std::string> x, y, predicted, lower, upper;

  /// All of them, in this order.
  std::vector<std::string> all() const {
    std::vector<std::string> names = x;
    for (const auto* group : {&y, &predicted, &lower, &upper})
      names.insert(names.end(), group->begin(), group->end());
    return names;
  }
};

namespace detail {

inline std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

inline std::string sql_quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

/// Puts `prefix` in front until the name is free, and takes it.
inline std::string claim(std::string name, const std::string& prefix, std::set<std::string>& taken) {
  while (!taken.insert(lower_case(name)).second) name = prefix + name;
  return sql_quoted(name);
}

}  // namespace detail

inline Columns columns_of(const doe::Problem& problem) {
  std::set<std::string> taken = {"id",     "kind",    "point",   "replicate", "seed", "status",
                                 "reason", "seconds", "started", "finished",  "log",  "checksum"};
  Columns columns;
  for (const auto& variable : problem.variables)
    columns.x.push_back(detail::claim(variable.name, "x_", taken));
  for (const auto& response : problem.responses)
    columns.y.push_back(detail::claim(response.name, "y_", taken));
  for (const auto& response : problem.responses) {
    columns.predicted.push_back(detail::claim(response.name + "_predicted", "y_", taken));
    columns.lower.push_back(detail::claim(response.name + "_lower", "y_", taken));
    columns.upper.push_back(detail::claim(response.name + "_upper", "y_", taken));
  }
  return columns;
}

}  // namespace drawpoint::studies
