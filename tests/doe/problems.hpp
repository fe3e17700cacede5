// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Problems and helpers that the tests of doe and pareto share.

#include <drawpoint/doe/problem.hpp>
#include <string>

namespace drawpoint::support {

inline std::string numbered(std::string name, int number) { return name += std::to_string(number); }

/// d variables in [0, 1] and r responses of one goal.
inline doe::Problem unit_problem(int d, int r = 1, doe::Goal goal = doe::Goal::minimize) {
  doe::Problem problem;
  for (int j = 0; j < d; ++j) problem.variables.push_back({numbered("x", j), "1", 0.0, 1.0});
  for (int j = 0; j < r; ++j) problem.responses.push_back({numbered("f", j), "1", goal});
  return problem;
}

/// A problem with awkward ranges, units and names.
inline doe::Problem loader_problem() {
  return {
      {{"lip_angle", "deg", -25.0, 5.0}, {"lift, \"speed\"", "m/s", 1e-3, 3e-3}, {"kappa", "1", 0.0, 1.0}},
      {{"production", "kg/s", doe::Goal::maximize}, {"joint, damage", "s", doe::Goal::minimize}}};
}

/// The text of the exception that `action` throws, which must be an E; empty when nothing is thrown.
template <class E, class Action>
std::string thrown_text(const Action& action) {
  try {
    action();
  } catch (const E& e) {
    return e.what();
  }
  return {};
}

}  // namespace drawpoint::support
