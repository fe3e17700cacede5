// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// expect: drawpoint: not a fitter. Expected f(X, y) giving a surrogate
#include <drawpoint/kriging/cross_validation.hpp>

double mean_of(const Eigen::MatrixXd&, const Eigen::VectorXd& y) { return y.mean(); }

void a_number_is_no_surrogate(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  drawpoint::kriging::k_fold(X, y, 5, mean_of);
}
