// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. It takes the point but returns the wrong type. Expected one of Outcome
// f(const Eigen::VectorXd& x)

#include <drawpoint/doe/evaluate.hpp>
#include <vector>

auto run(const drawpoint::doe::Problem& problem, const Eigen::MatrixXd& X) {
  const auto f = [](const Eigen::VectorXd& x) { return std::vector<double>{x[0], x[1]}; };
  return drawpoint::doe::evaluate(f, problem, X);
}
