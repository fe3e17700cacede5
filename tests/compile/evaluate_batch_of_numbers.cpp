// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. It takes the point but returns the wrong type.
// expect: std::vector<Outcome> f(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds)

#include <drawpoint/doe/evaluate.hpp>
#include <vector>

auto run(const drawpoint::doe::Problem& problem, const Eigen::MatrixXd& X) {
  const auto f = [](const Eigen::MatrixXd& points, std::span<const drawpoint::doe::Seed>) {
    return std::vector<double>(static_cast<std::size_t>(points.rows()));
  };
  return drawpoint::doe::evaluate(f, problem, X);
}
