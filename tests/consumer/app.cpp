// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Fits a surrogate to a formula with nothing but the installed kriging module, and fails when it predicts
// badly.

#include <cmath>
#include <cstdio>
#include <drawpoint/kriging/fit.hpp>

namespace {

double formula(double a, double b) { return std::sin(2.0 * a) + 0.5 * b * b; }

// side x side points over [0, 2] x [0, 2], moved by `shift` of a cell.
Eigen::MatrixXd grid(int side, double shift) {
  Eigen::MatrixXd X(side * side, 2);
  for (int i = 0; i < side * side; ++i) {
    X.row(i) << 2.0 * (i % side + shift) / side, 2.0 * (i / side + shift) / side;
  }
  return X;
}

Eigen::VectorXd observe(const Eigen::MatrixXd& X) {
  Eigen::VectorXd y(X.rows());
  for (Eigen::Index i = 0; i < X.rows(); ++i) y[i] = formula(X(i, 0), X(i, 1));
  return y;
}

}  // namespace

int main() {
  const Eigen::MatrixXd X = grid(6, 0.5);
  const auto model = drawpoint::kriging::fit(X, observe(X));

  const Eigen::MatrixXd X_new = grid(5, 0.5);
  const auto prediction = model.predict(X_new);
  const double worst = (prediction.mean - observe(X_new)).cwiseAbs().maxCoeff();

  // The formula is smooth and spans about 3.7 units; a mean of the data alone is off by more than 1, a
  // surrogate that uses the 36 points by less than 1e-3. One per cent of the span tells them apart with room
  // on both sides.
  const bool good =
      worst < 0.037 && prediction.variance.minCoeff() >= 0.0 && std::isfinite(model.log_likelihood());
  std::printf("worst error %.2e on %d new points: %s\n", worst, static_cast<int>(X_new.rows()),
              good ? "good" : "too large");
  return good ? 0 : 1;
}
