// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the models of a study say of one run at a new point, its noise included. Where runs tell their own
/// standard error and the fit took the word of each, a run's noise at a point is what the model of the
/// standard errors expects there; else it is the same everywhere, as the fit has it.

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/noise_model.hpp>
#include <drawpoint/kriging/transformed_model.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace drawpoint::studies {

/// Whether the model was fitted with noise that differs from run to run.
inline bool noise_differs(const kriging::TransformedModel& model) {
  return model.model().state().noise.size() > 0;
}

/// Whether what the runs tell of their noise went into the fit.
inline bool knows_noise(const kriging::TransformedModel& model) {
  return model.model().state().known_noise > 0;
}

/// Variance of the noise of response j that runs at the rows of X (n x d) are expected to tell: n entries, by
/// the model of its standard error, which it must name.
inline Eigen::VectorXd noise_expected_at(const std::vector<kriging::TransformedModel>& models,
                                         const doe::Problem& problem, std::size_t j,
                                         const Eigen::MatrixXd& X) {
  const int told = doe::response_index(problem, problem.responses[j].standard_error);
  return kriging::noise_variance_at(models[static_cast<std::size_t>(told)], X);
}

/// Quantile of response j, one model per response, at the rows of X (n x d): n entries, within its range.
inline Eigen::VectorXd run_quantile(const std::vector<kriging::TransformedModel>& models,
                                    const doe::Problem& problem, std::size_t j, const Eigen::MatrixXd& X,
                                    double probability) {
  const doe::Response& response = problem.responses[j];
  const auto quantile = [&]() -> Eigen::VectorXd {
    if (!noise_differs(models[j])) return models[j].quantile(X, probability, kriging::Target::observation);
    return models[j].run_quantile(X, probability, noise_expected_at(models, problem, j, X));
  };
  return quantile().unaryExpr([&](double y) { return doe::within_range(response, y); });
}

}  // namespace drawpoint::studies
