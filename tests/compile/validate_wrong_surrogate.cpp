// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// expect: drawpoint: not a surrogate. Expected predict(X), predict(X, Target) giving a Prediction
#include <drawpoint/kriging/validate.hpp>

struct Constant {
  Eigen::VectorXd predict(const Eigen::MatrixXd& X) const { return Eigen::VectorXd::Zero(X.rows()); }
};

void means_alone_are_not_enough(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  drawpoint::kriging::validate(Constant{}, X, y);
}
