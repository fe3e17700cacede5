// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The problem of a table over functions: inputs from 0 to 1, one response.

#include <drawpoint/doe/problem.hpp>
#include <string>

namespace drawpoint::benchmarks {

inline doe::Problem unit_box(int inputs) {
  doe::Problem problem;
  problem.responses = {{"y", "1", doe::Goal::minimize}};
  for (int k = 0; k < inputs; ++k) problem.variables.push_back({"x" + std::to_string(k), "1", 0.0, 1.0});
  return problem;
}

}  // namespace drawpoint::benchmarks
