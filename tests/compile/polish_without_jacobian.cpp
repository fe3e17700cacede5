// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a differentiable function.
// expect: pareto::ValueAndJacobian f(const Eigen::VectorXd& x) const;

#define HAVE_CSTDDEF  // as Ipopt's pkg-config file says

#include <drawpoint/pareto/polish.hpp>

drawpoint::pareto::Polished answer(const drawpoint::doe::Problem& problem,
                                   const drawpoint::pareto::Front& front) {
  return drawpoint::pareto::polish([](const Eigen::VectorXd& x) { return x.sum(); }, problem, front);
}
