// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. It takes the point but returns the wrong type.
// expect: std::vector<Outcome> f(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds)

#include <drawpoint/pareto/nsga2.hpp>
#include <string>

auto search(const drawpoint::doe::Problem& problem) {
  return drawpoint::pareto::nsga2([](const Eigen::VectorXd&) { return std::string("done"); }, problem);
}
