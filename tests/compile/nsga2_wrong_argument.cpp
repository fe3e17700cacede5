// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. It cannot be called with a point.
// expect: std::vector<Outcome> f(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds)

#include <drawpoint/pareto/nsga2.hpp>

auto search(const drawpoint::doe::Problem& problem) {
  return drawpoint::pareto::nsga2([](double a, double b) { return a + b; }, problem);
}
