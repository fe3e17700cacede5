// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// 60 runs of which 32 are the corners of a box of five inputs: half of them see its edge alone.

#include <Eigen/Core>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/seed.hpp>
#include <string>

namespace drawpoint::kriging::reference {

inline Eigen::MatrixXd corner_design(doe::Seed seed) {
  doe::Problem problem{.variables = {}, .responses = {{"y", "1", doe::Goal::minimize}}};
  for (int k = 0; k < 5; ++k) problem.variables.push_back({"x" + std::to_string(k), "1", 0.0, 1.0});
  return doe::optimized_latin_hypercube(problem, 60, {.seed = seed, .sweeps = 20, .corners = true});
}

}  // namespace drawpoint::kriging::reference
