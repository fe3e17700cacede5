// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Draws of the mean of many runs at several points at once, and of differences between two points, as sure as a
/// model is of it.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/kriging/transformed_model.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

namespace drawpoint::studies {

/// What paths of the model (kriging/sample_paths.hpp) say of the response: its unit, within its range.
inline Eigen::MatrixXd means_of(const kriging::TransformedModel& model, const doe::Response& response,
                                Eigen::MatrixXd paths) {
  const bool linear = model.transform().scale == kriging::Scale::linear;
  for (double& y : paths.reshaped()) {
    if (!linear) y = kriging::mean_response(model.transform(), y, model.noise_variance());
    y = doe::within_range(response, y);
  }
  return paths;
}

/// Means of many runs at the points X (n x d): n x draws. Throws as kriging::sample_paths.
inline Eigen::MatrixXd drawn_means(const kriging::TransformedModel& model, const doe::Response& response,
                                   const Eigen::MatrixXd& X, int draws) {
  return means_of(model, response, kriging::sample_paths(model.model(), X, draws));
}

/// Whether the model knows how sure it is at these points.
inline bool knows_error(const kriging::TransformedModel& model, const Eigen::MatrixXd& X) {
  return model.model().predict(X).variance.allFinite();
}

/// The ends between which 95 of 100 values lie; at least one value.
struct Ends {
  double lower = std::numeric_limits<double>::quiet_NaN(), upper = lower;
};
inline Ends ends_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto place = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
  };
  return {place(0.025), place(0.975)};
}

/// The mean at a less that at b, d entries each, lies between them; not numbers where the model does not know its
/// error.
inline Ends ends_of_difference(const kriging::TransformedModel& model, const doe::Response& response,
                               const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  constexpr int draws = 4000;
  Eigen::MatrixXd X(2, a.size());
  X << a.transpose(), b.transpose();
  if (!knows_error(model, X)) return {};
  const Eigen::MatrixXd means = drawn_means(model, response, X, draws);
  const Eigen::VectorXd difference = means.row(0) - means.row(1);
  return ends_of({difference.begin(), difference.end()});
}

}  // namespace drawpoint::studies
