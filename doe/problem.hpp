// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The problem under study: named variables in a box and named responses with a goal each.
///
/// Everything is in natural units; scaling is the business of the method that needs it. The unit is a text
/// that messages, tables and plots repeat ("1" for a pure number). `minimize` and `maximize` make a response
/// an objective, `at_most` and `at_least` make it a constraint against `limit`, `record` only keeps it.

#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace drawpoint::doe {

enum class Goal { minimize, maximize, at_most, at_least, record };

/// One input: lower < upper, both finite, in `unit`.
struct Variable {
  std::string name, unit;
  double lower, upper;
};

/// One output; `limit` (in `unit`) belongs to at_most and at_least only.
struct Response {
  std::string name, unit;
  Goal goal = Goal::record;
  double limit = std::numeric_limits<double>::quiet_NaN();
};

struct Problem {
  std::vector<Variable> variables;
  std::vector<Response> responses;
};

inline bool is_objective(Goal goal) { return goal == Goal::minimize || goal == Goal::maximize; }
inline bool is_constraint(Goal goal) { return goal == Goal::at_most || goal == Goal::at_least; }

inline std::string_view to_string(Goal goal) {
  switch (goal) {
    case Goal::minimize:
      return "minimize";
    case Goal::maximize:
      return "maximize";
    case Goal::at_most:
      return "at_most";
    case Goal::at_least:
      return "at_least";
    case Goal::record:
      return "record";
  }
  return "unknown";
}

namespace detail {

/// The shortest decimal text that reads back as the same double.
inline std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

/// "25 deg"; a pure number has no unit to show.
inline std::string with_unit(double value, const std::string& unit) {
  return number_text(value) + (unit.empty() || unit == "1" ? "" : " " + unit);
}

[[noreturn]] inline void reject(const std::string& what) {
  throw std::invalid_argument("doe::Problem: " + what);
}

inline void check_name(const char* kind, const std::string& name, std::size_t index,
                       std::set<std::string>& seen) {
  const std::string place = kind + std::string(" ") + std::to_string(index);
  if (name.empty()) reject(place + " has no name; give it one");
  for (const unsigned char c : name)
    if (std::iscntrl(c))
      reject(place + ": the name holds a control character; use printable text on one line");
  if (!seen.insert(name).second)
    reject(std::string(kind) + " \"" + name +
           "\": the name is used twice; names of variables and responses must differ");
}

inline void check_variable(const Variable& v) {
  const std::string place = "variable \"" + v.name + "\": ";
  const std::string lower = with_unit(v.lower, v.unit), upper = with_unit(v.upper, v.unit);
  if (!std::isfinite(v.lower))
    reject(place + "lower bound " + lower + " is not finite; give a finite number");
  if (!std::isfinite(v.upper))
    reject(place + "upper bound " + upper + " is not finite; give a finite number");
  if (v.lower == v.upper)
    reject(place + "lower bound " + lower + " equals the upper bound; widen the range or make it a constant");
  if (v.lower > v.upper)
    reject(place + "lower bound " + lower + " is not below upper bound " + upper + "; swap them");
  if (!std::isfinite(v.upper - v.lower))
    reject(place + "the range from " + lower + " to " + upper + " overflows; change the unit");
}

inline void check_response(const Response& r) {
  const std::string place = "response \"" + r.name + "\": ";
  const std::string goal(to_string(r.goal));
  if (is_constraint(r.goal) && !std::isfinite(r.limit))
    reject(place + "goal " + goal + " has limit " + with_unit(r.limit, r.unit) + "; give a finite limit");
  if (!is_constraint(r.goal) && !std::isnan(r.limit))
    reject(place + "goal " + goal + " does not use limit " + with_unit(r.limit, r.unit) +
           "; remove the limit or choose at_most or at_least");
}

}  // namespace detail

/// Throws std::invalid_argument that names the first fault: no variable or response, an empty or repeated
/// name, a bound that is not finite or not in order, a constraint without a limit, a limit without a
/// constraint.
inline void check(const Problem& problem) {
  if (problem.variables.empty()) detail::reject("no variables; name at least one");
  if (problem.responses.empty()) detail::reject("no responses; name at least one");
  std::set<std::string> seen;
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    detail::check_name("variable", problem.variables[i].name, i, seen);
    detail::check_variable(problem.variables[i]);
  }
  for (std::size_t i = 0; i < problem.responses.size(); ++i) {
    detail::check_name("response", problem.responses[i].name, i, seen);
    detail::check_response(problem.responses[i]);
  }
}

/// Place of a response in Problem::responses; throws std::invalid_argument when there is none of that name.
inline int response_index(const Problem& problem, std::string_view name) {
  std::string known;
  for (std::size_t i = 0; i < problem.responses.size(); ++i) {
    if (problem.responses[i].name == name) return static_cast<int>(i);
    known += (i ? ", \"" : "\"") + problem.responses[i].name + "\"";
  }
  detail::reject("no response \"" + std::string(name) + "\"; the responses are " + known);
}

}  // namespace drawpoint::doe
