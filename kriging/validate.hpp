// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How well a model predicts runs that it has not seen.
///
///   RMSE = √(1/n Σ (yᵢ − ŷᵢ)²), unit of y;  NRMSE = RMSE/(max y − min y), over the validation runs
/// NRMSE is NaN when the observed runs are all equal. Use runs drawn independently of the training runs.

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/kriging/model.hpp>
#include <limits>
#include <stdexcept>
#include <string>

namespace drawpoint::kriging {

struct Validation {
  double rmse = std::numeric_limits<double>::quiet_NaN(), nrmse = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd observed, predicted;  ///< one entry a run, unit of y
  Eigen::VectorXd variance;             ///< of the latent function, unit of y squared
};

/// X: n x d, natural units; y: n. Throws std::invalid_argument for no runs, unequal lengths and numbers that
/// are not finite.
inline Validation validate(const Model& model, const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  const auto reject = [](const std::string& what) {
    throw std::invalid_argument("kriging::validate: " + what);
  };
  if (X.rows() != y.size())
    reject("X has " + std::to_string(X.rows()) + " rows but y has " + std::to_string(y.size()) +
           " entries; give one response a run");
  if (X.rows() == 0) reject("X has 0 runs; allowed is 1 or more; give runs that the model has not seen");
  if (!y.allFinite())
    reject("y holds a number that is not finite; allowed are finite numbers; leave failed runs out");
  const Prediction p = model.predict(X);
  Validation v{.observed = y, .predicted = p.mean, .variance = p.variance};
  v.rmse = std::sqrt((y - p.mean).squaredNorm() / static_cast<double>(y.size()));
  const double range = y.maxCoeff() - y.minCoeff();
  if (range > 0) v.nrmse = v.rmse / range;
  return v;
}

}  // namespace drawpoint::kriging
