// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a sampler. It cannot be called with the runs so far. Expected doe::Criterion
// expect: one score a row of X, higher is better

#include <drawpoint/doe/propose.hpp>

auto next(const drawpoint::doe::Evaluations& runs) {
  const auto score = [](const Eigen::MatrixXd& X) -> Eigen::VectorXd { return X.col(0); };
  return drawpoint::doe::propose(runs, score);
}
