// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. It cannot be called with a point.
// expect: Outcome f(const Eigen::VectorXd& x, doe::Seed seed, std::stop_token stop)

#include <drawpoint/doe/sensitivity.hpp>

auto indices(const drawpoint::doe::Problem& problem) {
  return drawpoint::doe::sobol_indices([](double x) { return x; }, problem);
}
