// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a region. Expected bool allowed(const Eigen::VectorXd& x) const

#include <drawpoint/doe/constrained.hpp>

auto design(const drawpoint::doe::Problem& problem) {
  return drawpoint::doe::feasible_maximin(problem, 10, [](const Eigen::VectorXd& x) { return x.norm(); });
}
