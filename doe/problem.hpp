// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The problem under study: named variables in a box and named responses with a goal each.
///
/// Everything is in natural units; scaling is the business of the method that needs it. The unit is a text
/// that messages, tables and plots repeat ("1" for a pure number). A variable is real unless its kind says
/// otherwise: an integer one takes the whole numbers of its range, a categorical one the index 0, 1, ... of
/// one of its named levels. `minimize` and `maximize` make a response an objective, `at_most` and `at_least`
/// make it a constraint against `limit`, `record` only keeps it.

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drawpoint::doe {

enum class Goal { minimize, maximize, at_most, at_least, record };

enum class VariableKind { real, integer, categorical };

/// One input: lower < upper, both finite, in `unit`; whole numbers for an integer variable; 0 and levels - 1
/// for a categorical one. `{"alpha", "1", 0.2, 2.0}` is a real variable.
struct Variable {
  std::string name, unit;
  double lower, upper;
  VariableKind kind = VariableKind::real;
  std::vector<std::string> levels = {};  ///< names of a categorical variable's levels, at least 2
  std::string description = {};          ///< what it is, in a few words, for help and reports
};

/// A variable that takes the whole numbers lower..upper.
inline Variable integer_variable(std::string name, std::string unit, int lower, int upper) {
  return {std::move(name), std::move(unit), static_cast<double>(lower), static_cast<double>(upper),
          VariableKind::integer};
}

/// A variable without order: its value is the index of a level.
inline Variable categorical_variable(std::string name, std::vector<std::string> levels) {
  const double last = static_cast<double>(levels.size()) - 1.0;
  return {std::move(name), "1", 0.0, last, VariableKind::categorical, std::move(levels)};
}

/// One output; `limit` (in `unit`) belongs to at_most and at_least only. No value lies outside `lower` to
/// `upper`: a mass is at least 0. A run that says otherwise has failed.
struct Response {
  std::string name, unit;
  Goal goal = Goal::record;
  double limit = std::numeric_limits<double>::quiet_NaN();
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::string description = {};  ///< what it is, in a few words, for help and reports
  /// Name of the response that is the standard error of this one: what each run knows of its own noise, where
  /// it is a mean of cycles or samples. That one is recorded, of the same unit and at least 0. Empty:
  /// unknown.
  std::string standard_error = {};
  /// That standard error has so many degrees of freedom in every run, one less than its independent samples. 0: they
  /// are not known, and no run is weighed by its own standard error, which may be small by chance.
  double standard_error_freedom = 0;

  void forget_standard_error() {
    standard_error.clear();
    standard_error_freedom = 0;
  }
};

struct Problem {
  std::vector<Variable> variables;
  std::vector<Response> responses;
  /// Whether equal points give equal responses, whatever the seed: a model then meets the runs.
  bool deterministic = false;
};

/// A surrogate's prediction as a value that the response can have. Of a normal prediction whose part outside
/// the range counts as its bound, this is the median, and the same of a quantile.
inline double within_range(const Response& response, double value) {
  return std::clamp(value, response.lower, response.upper);
}

inline bool is_objective(Goal goal) { return goal == Goal::minimize || goal == Goal::maximize; }
inline bool is_constraint(Goal goal) { return goal == Goal::at_most || goal == Goal::at_least; }

/// 1 where less is better, -1 where more is: times this, an objective is minimised and the excess over a
/// limit is a violation.
inline double sign_of(Goal goal) { return goal == Goal::maximize || goal == Goal::at_least ? -1.0 : 1.0; }

inline std::string_view to_string(VariableKind kind) {
  switch (kind) {
    case VariableKind::real:
      return "real";
    case VariableKind::integer:
      return "integer";
    case VariableKind::categorical:
      return "categorical";
  }
  return "unknown";
}

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

inline void check_integer(const Variable& v) {
  const std::string place = "variable \"" + v.name + "\": ";
  for (const double bound : {v.lower, v.upper})
    if (bound != std::floor(bound) || std::abs(bound) > 1e9)
      reject(place + "bound " + with_unit(bound, v.unit) +
             " of an integer variable is not a whole number of at most 1e9; round it");
}

inline void check_levels(const Variable& v) {
  const std::string place = "variable \"" + v.name + "\": ";
  if (v.levels.size() < 2)
    reject(place + "categorical with " + std::to_string(v.levels.size()) +
           " levels; name at least 2 or make it a constant");
  std::set<std::string> seen;
  for (const std::string& level : v.levels)
    if (level.empty() || !seen.insert(level).second)
      reject(place + "level \"" + level + "\" is empty or used twice; level names must differ");
  const double last = static_cast<double>(v.levels.size()) - 1.0;
  if (v.lower != 0.0 || v.upper != last)
    reject(place + "bounds " + number_text(v.lower) + " and " + number_text(v.upper) + " of a categorical " +
           "variable of " + std::to_string(v.levels.size()) + " levels; they must be 0 and " +
           number_text(last));
}

/// What the kind asks beyond sound bounds.
inline void check_kind(const Variable& v) {
  if (v.kind == VariableKind::integer) check_integer(v);
  if (v.kind != VariableKind::categorical && !v.levels.empty())
    reject("variable \"" + v.name + "\": it has levels but is " + std::string(to_string(v.kind)) +
           "; make it categorical or remove the levels");
}

inline void check_variable(const Variable& v) {
  if (v.kind == VariableKind::categorical) check_levels(v);
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
  check_kind(v);
}

inline void check_response(const Response& r) {
  const std::string place = "response \"" + r.name + "\": ";
  const std::string goal(to_string(r.goal));
  if (is_constraint(r.goal) && !std::isfinite(r.limit))
    reject(place + "goal " + goal + " has limit " + with_unit(r.limit, r.unit) + "; give a finite limit");
  if (!is_constraint(r.goal) && !std::isnan(r.limit))
    reject(place + "goal " + goal + " does not use limit " + with_unit(r.limit, r.unit) +
           "; remove the limit or choose at_most or at_least");
  if (!(r.lower < r.upper))
    reject(place + "its values lie from " + with_unit(r.lower, r.unit) + " to " + with_unit(r.upper, r.unit) +
           "; give a lower bound below the upper one, or none");
  if (r.limit < r.lower || r.limit > r.upper)
    reject(place + "limit " + with_unit(r.limit, r.unit) + " is outside its values, " +
           with_unit(r.lower, r.unit) + " to " + with_unit(r.upper, r.unit) + "; give one among them");
}

/// That the response which tells the noise of `of` can.
inline void check_standard_error(const Response& of, const std::vector<Response>& all) {
  if (!(of.standard_error_freedom >= 0) || std::isinf(of.standard_error_freedom) ||
      (of.standard_error.empty() && of.standard_error_freedom > 0))
    reject("response \"" + of.name + "\": its standard error has " +
           std::to_string(of.standard_error_freedom) +
           " degrees of freedom; allowed are finite numbers from 0 on, and 0 without a standard error; leave "
           "it out, or name "
           "the standard error");
  if (of.standard_error.empty()) return;
  const std::string place =
      "response \"" + of.name + "\": its standard error is \"" + of.standard_error + "\", ";
  const auto told =
      std::find_if(all.begin(), all.end(), [&](const Response& r) { return r.name == of.standard_error; });
  if (told == all.end()) reject(place + "which is no response; add one of that name and the goal record");
  if (&*told == &of) reject(place + "which is the response itself; name another");
  if (told->goal != Goal::record)
    reject(place + "whose goal is " + std::string(to_string(told->goal)) + "; it must be record");
  if (!(told->lower >= 0)) reject(place + "which may be below 0; give it the lower bound 0");
  const auto pure = [](const std::string& unit) { return unit.empty() || unit == "1"; };
  if (told->unit != of.unit && !(pure(told->unit) && pure(of.unit)))
    reject(place + "in \"" + told->unit + "\"; give both the same unit, \"" + of.unit + "\"");
  if (!told->standard_error.empty()) reject(place + "which names a standard error itself; remove that one");
}

}  // namespace detail

/// Throws std::invalid_argument that names the first fault: no variable or response, an empty or repeated
/// name, a bound that is not finite or not in order, one that its kind does not allow, a constraint without a
/// limit, a limit without a constraint or outside the response's range, a standard error that is no recorded
/// response of that unit and at least 0, degrees of freedom below 0 or of none.
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
  for (const Response& r : problem.responses) detail::check_standard_error(r, problem.responses);
}

/// Whether response j is what runs tell of the noise of another one.
inline bool is_standard_error(const Problem& problem, std::size_t j) {
  return std::any_of(problem.responses.begin(), problem.responses.end(),
                     [&](const Response& of) { return of.standard_error == problem.responses[j].name; });
}

/// Whether runs tell the noise of a response: then the simulator has some, in all that it responds.
inline bool tells_noise(const Problem& problem) {
  return std::any_of(problem.responses.begin(), problem.responses.end(),
                     [](const Response& r) { return !r.standard_error.empty(); });
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
