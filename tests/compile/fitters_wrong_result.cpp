// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a fitter. Expected f(X, y) giving a surrogate
// times: 2

#define HAVE_CSTDDEF  // as Ipopt's pkg-config file says

#include <drawpoint/kriging/cross_validation.hpp>

using namespace drawpoint;

// Each call has a fitter of its own, for the compiler complains once a type.
void a_number_is_no_surrogate(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  kriging::hold_out(X, y, 0.2, [](const Eigen::MatrixXd&, const Eigen::VectorXd& z) { return z.mean(); });
  kriging::assess({}, X, y, [](const Eigen::MatrixXd&, const Eigen::VectorXd& z) { return z.mean(); });
}
