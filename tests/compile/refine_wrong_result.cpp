// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. It takes the point but returns the wrong type.

#include <drawpoint/doe/adaptive.hpp>
#include <string>

auto study(const drawpoint::doe::Problem& problem, const Eigen::MatrixXd& X) {
  const auto f = [](const Eigen::VectorXd&) { return std::string("done"); };
  return drawpoint::doe::refine(f, problem, X, drawpoint::doe::LolaVoronoi());
}
