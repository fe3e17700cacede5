// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// expect: drawpoint: not a surrogate. Expected predict(X), predict(X, Target) giving a Prediction
#include <drawpoint/kriging/acquisition.hpp>

struct Constant {
  Eigen::VectorXd mean(const Eigen::MatrixXd& X) const { return Eigen::VectorXd::Zero(X.rows()); }
};

void a_mean_alone_has_no_improvement() {
  drawpoint::kriging::expected_improvement(Constant{}, drawpoint::doe::Goal::minimize, 1.0);
}
