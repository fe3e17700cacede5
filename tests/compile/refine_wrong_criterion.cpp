// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a sampler. What it makes of the runs so far is not a criterion. Expected

#include <drawpoint/doe/adaptive.hpp>

auto study(const drawpoint::doe::Problem& problem, const Eigen::MatrixXd& X) {
  const auto f = [](const Eigen::VectorXd& x) { return x[0]; };
  const auto sampler = [](const drawpoint::doe::Evaluations& runs) { return runs.X(); };
  return drawpoint::doe::refine(f, problem, X, sampler);
}
