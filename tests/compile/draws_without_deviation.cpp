// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not an uncertain function.

#include <Eigen/Core>

#include <drawpoint/pareto/draws.hpp>

drawpoint::pareto::Draws mistake() {
  return drawpoint::pareto::draws_at([](const Eigen::MatrixXd& X) { return Eigen::VectorXd(X.col(0)); },
                                     Eigen::MatrixXd::Zero(2, 2));
}
