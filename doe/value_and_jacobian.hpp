// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a function with derivatives gives at one point: f(x) for searches that follow gradients. A fitted
/// surrogate gives it (kriging/surrogates.hpp), a formula may; polishing and trade-offs take it (pareto).

#include <Eigen/Core>

namespace drawpoint::doe {

/// All responses at a point (r) and their derivatives by the variables (r x d), natural units.
struct ValueAndJacobian {
  Eigen::VectorXd values;
  Eigen::MatrixXd jacobian;
};

}  // namespace drawpoint::doe
