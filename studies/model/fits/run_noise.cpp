// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/run_noise.h>
#include <drawpoint/studies/model/fits/run_quantile.h>
#include <drawpoint/kriging/signal.hpp>

#include <algorithm>

namespace drawpoint::studies {
namespace {

bool counts(const kriging::NoiseEstimate& noise, const kriging::Validation& v) {
  const double range = v.observed.maxCoeff() - v.observed.minCoeff(), deviation = std::sqrt(noise.variance);
  return deviation >= 0.1 * v.rmse && deviation >= 1e-4 * range;
}

kriging::MeanError error_with(const kriging::NoiseEstimate& noise, const kriging::Validation& v) {
  return counts(noise, v) ? kriging::mean_error(v, noise) : kriging::mean_error(v);
}

bool is_reported(const Eigen::VectorXd& variances, const kriging::Validation& v) {
  return variances.size() == v.observed.size() && variances.maxCoeff() > 0 &&
         variances.maxCoeff() <= most_told_variance;
}

}  // namespace

kriging::MeanError mean_error_of(const kriging::Validation& v, const kriging::TransformedModel& model,
                                 const doe::Problem& problem) {
  if (v.observed.size() == 0) return {};
  if (!knows_noise(model) && kriging::signal_of(model, problem).flat) return kriging::mean_error(v);
  return error_with(kriging::modelled_noise(v, static_cast<double>(model.runs())), v);
}

kriging::MeanError mean_error_of(const kriging::Validation& v, const kriging::TransformedModel& model,
                                 const doe::Evaluations& training, const doe::Evaluations& validation,
                                 const doe::Response& response) {
  if (v.observed.size() == 0) return {};
  const Eigen::VectorXd reported = validation.noise_variance(response.name);
  kriging::MeanError error = is_reported(reported, v) ? error_with(kriging::reported_noise(reported), v)
                                                      : mean_error_of(v, model, validation.problem);
  const Eigen::VectorXd y = training.y(response.name);
  if (y.size() > 0)
    error.range =
        std::max(y.maxCoeff(), v.observed.maxCoeff()) - std::min(y.minCoeff(), v.observed.minCoeff());
  return error;
}

}  // namespace drawpoint::studies
