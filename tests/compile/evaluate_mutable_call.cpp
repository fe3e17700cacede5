// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. Its call operator is not const
// expect: std::vector<Outcome> f(const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds)

#include <drawpoint/doe/evaluate.hpp>

struct Counting {
  int calls = 0;
  double operator()(const Eigen::VectorXd& x) {
    ++calls;
    return x[0];
  }
};

auto run(const drawpoint::doe::Problem& problem, const Eigen::MatrixXd& X) {
  return drawpoint::doe::evaluate(Counting{}, problem, X);
}
