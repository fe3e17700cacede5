// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/python/bind.h>
#include <drawpoint/doe/problem.hpp>
#include <limits>

/// The problem under study, made once from what the Python functions are given.

namespace drawpoint::python {

namespace {

doe::Goal goal_of(const std::string& text) {
  using doe::Goal;
  return named("goal", text, {Goal::minimize, Goal::maximize, Goal::at_most, Goal::at_least, Goal::record});
}

/// levels: empty for a number, else the names of a category's levels; integer: whether a number is whole.
doe::Variable variable_of(const std::string& name, double lower, double upper, bool integer,
                          const std::vector<std::string>& levels) {
  if (!levels.empty()) return doe::categorical_variable(name, levels);
  return {name, "1", lower, upper, integer ? doe::VariableKind::integer : doe::VariableKind::real};
}

}  // namespace

void bind_problem(py::module_& m) {
  py::class_<doe::Problem>(m, "Problem")
      .def(py::init([](bool deterministic) {
             doe::Problem problem;
             problem.deterministic = deterministic;
             return problem;
           }),
           py::arg("deterministic") = false)
      .def("add_variable",
           [](doe::Problem& problem, const std::string& name, double lower, double upper, bool integer,
              const std::vector<std::string>& levels) {
             problem.variables.push_back(variable_of(name, lower, upper, integer, levels));
           })
      .def("add_response",
           [](doe::Problem& problem, const std::string& name, const std::string& goal, double limit) {
             problem.responses.push_back({name, "1", goal_of(goal), limit});
           })
      .def("check", [](const doe::Problem& problem) { doe::check(problem); })
      .def_property_readonly("variables",
                             [](const doe::Problem& problem) {
                               std::vector<std::string> names;
                               for (const doe::Variable& v : problem.variables) names.push_back(v.name);
                               return names;
                             })
      .def_property_readonly("responses", [](const doe::Problem& problem) {
        std::vector<std::string> names;
        for (const doe::Response& r : problem.responses) names.push_back(r.name);
        return names;
      });
}

}  // namespace drawpoint::python
