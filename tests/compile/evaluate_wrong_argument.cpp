// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. It cannot be called with a point.
// expect: std::vector<Outcome> f(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds)

#include <drawpoint/doe/evaluate.hpp>
#include <vector>

double sum(const std::vector<double>& x) { return x[0] + x[1]; }

auto run(const drawpoint::doe::Problem& problem, const Eigen::MatrixXd& X) {
  return drawpoint::doe::evaluate(sum, problem, X);
}
