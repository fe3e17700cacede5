// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A problem as JSON, for stores, reports and programs in other languages:
///
///     {"variables": [{"name", "unit", "lower", "upper", "kind", "levels"}, ...],
///      "responses": [{"name", "unit", "goal", "limit", "lower", "upper", "standard_error",
///                     "standard_error_freedom"}, ...],
///      "deterministic": true}
///
/// Descriptions are left out: they may be worded anew, and the problem is the same. "kind" is left out for a
/// real variable, "levels" for one that is not categorical, "limit", bounds and "standard_error" where there
/// are none, "deterministic" where it is false. Numbers are the shortest text that reads back as the same
/// double. This is the only header of the module that needs nlohmann-json (Debian: nlohmann-json3-dev);
/// doe.hpp does not include it.

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <drawpoint/doe/detail/enumerators.hpp>
#include <drawpoint/doe/problem.hpp>

namespace drawpoint::doe {

inline nlohmann::json to_json(const Problem& problem) {
  auto variables = nlohmann::json::array(), responses = nlohmann::json::array();
  for (const Variable& v : problem.variables) {
    nlohmann::json entry = {{"name", v.name}, {"unit", v.unit}, {"lower", v.lower}, {"upper", v.upper}};
    if (v.kind != VariableKind::real) entry["kind"] = to_string(v.kind);
    if (!v.levels.empty()) entry["levels"] = v.levels;
    variables.push_back(std::move(entry));
  }
  for (const Response& r : problem.responses) {
    nlohmann::json entry = {{"name", r.name}, {"unit", r.unit}, {"goal", to_string(r.goal)}};
    if (!std::isnan(r.limit)) entry["limit"] = r.limit;
    if (std::isfinite(r.lower)) entry["lower"] = r.lower;
    if (std::isfinite(r.upper)) entry["upper"] = r.upper;
    if (!r.standard_error.empty()) entry["standard_error"] = r.standard_error;
    if (r.standard_error_freedom > 0) entry["standard_error_freedom"] = r.standard_error_freedom;
    responses.push_back(std::move(entry));
  }
  nlohmann::json json{{"variables", std::move(variables)}, {"responses", std::move(responses)}};
  if (problem.deterministic) json["deterministic"] = true;
  return json;
}

/// Throws nlohmann::json::exception if the text is not what to_json wrote. A kind or goal of an unknown name
/// is read as real and record.
inline Problem problem_from_json(const nlohmann::json& json) {
  Problem problem;
  for (const auto& v : json.at("variables"))
    problem.variables.push_back(
        {v.at("name"), v.at("unit"), v.at("lower"), v.at("upper"),
         detail::enumerator_of<VariableKind>(v.value("kind", "real")).value_or(VariableKind::real),
         v.value("levels", std::vector<std::string>{})});
  for (const auto& r : json.at("responses"))
    problem.responses.push_back(
        {r.at("name"),
         r.at("unit"),
         detail::enumerator_of<Goal>(r.at("goal").get<std::string>()).value_or(Goal::record),
         r.value("limit", std::numeric_limits<double>::quiet_NaN()),
         r.value("lower", -std::numeric_limits<double>::infinity()),
         r.value("upper", std::numeric_limits<double>::infinity()),
         {},
         r.value("standard_error", std::string{}),
         r.value("standard_error_freedom", 0.0)});
  problem.deterministic = json.value("deterministic", false);
  return problem;
}

}  // namespace drawpoint::doe
