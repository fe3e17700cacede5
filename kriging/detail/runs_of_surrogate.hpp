// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The checks of runs and points that the surrogates beside Kriging share with it, under their own names.

#include <Eigen/Core>
#include <stdexcept>
#include <string>

#include <drawpoint/kriging/detail/training_data.hpp>

namespace drawpoint::kriging::detail {

/// As prepare() does for Kriging: scaled inputs, standardised response (none when it is constant). Its errors
/// begin with `place`.
inline TrainingData runs_of_surrogate(const std::string& place, const Eigen::MatrixXd& X,
                                      const Eigen::VectorXd& y, const FitOptions& box) {
  try {
    return prepare(X, y, box);
  } catch (const std::invalid_argument& e) {
    const std::string text = e.what();
    throw std::invalid_argument(place + text.substr(text.find(": ")));
  }
}

inline void check_points(const std::string& place, const Eigen::MatrixXd& X, Eigen::Index variables) {
  if (X.cols() != variables)
    throw std::invalid_argument(place + ": X has " + std::to_string(X.cols()) + " columns; the model has " +
                                std::to_string(variables) + " variables; give one point per row");
  if (!all_finite(X))
    throw std::invalid_argument(
        place + ": X holds a number that is not finite; allowed are finite numbers; remove the point");
}

}  // namespace drawpoint::kriging::detail
