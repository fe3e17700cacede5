// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a differentiable function.

#define HAVE_CSTDDEF  // as Ipopt's pkg-config file says

#include <drawpoint/pareto/local_trade_off.hpp>

drawpoint::pareto::LocalTradeOff mistake(const drawpoint::doe::Problem& problem,
                                         const drawpoint::pareto::Front& front) {
  return drawpoint::pareto::local_trade_off([](const Eigen::VectorXd& x) { return x.sum(); }, problem, front,
                                            0);
}
