// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/report/run_noise.h>
#include <drawpoint/studies/report/run_quantile.h>
#include <drawpoint/kriging/signal.hpp>

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
                                 const doe::Evaluations& validation, const doe::Response& response) {
  if (v.observed.size() == 0) return {};
  const Eigen::VectorXd reported = validation.noise_variance(response.name);
  if (is_reported(reported, v)) return error_with(kriging::reported_noise(reported), v);
  return mean_error_of(v, model, validation.problem);
}

}  // namespace drawpoint::studies
