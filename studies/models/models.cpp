// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/models/models.h>
#include <drawpoint/studies/report/run_quantile.h>
#include <drawpoint/studies/report/stated_interval.h>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/kriging/noise_model.hpp>

#include <cstdio>
#include <stdexcept>
#include <utility>

namespace drawpoint::studies {
namespace {

kriging::FitOptions default_fit(const doe::Problem& problem) {
  kriging::FitOptions options;
  options.threads = 0;
  options.lower = doe::lower_bounds(problem);
  options.upper = doe::upper_bounds(problem);
  options.levels = doe::level_counts(problem);
  return options;
}

std::string name_of(kriging::Scale scale) {
  switch (scale) {
    case kriging::Scale::linear:
      return "";
    case kriging::Scale::square_root:
      return ", of the square root";
    case kriging::Scale::logarithm:
      return ", of the logarithm";
    case kriging::Scale::logit:
      return ", of the logit";
  }
  return "";
}

kriging::ResponseRange range_of(const doe::Response& response) { return {response.lower, response.upper}; }

std::string name_of(NoiseOfRuns noise) {
  switch (noise) {
    case NoiseOfRuns::estimated:
      return "";
    case NoiseOfRuns::told:
      return ", noise as the runs tell it";
    case NoiseOfRuns::modelled:
      return ", noise as a model of what the runs tell";
  }
  return "";
}

StudyWay way_to_fit(const kriging::FitOptions& options, const kriging::ResponseRange& range,
                    kriging::Scale scale, NoiseOfRuns noise) {
  const std::string slope = options.trend == kriging::Trend::linear ? ", linear trend" : "";
  return {{std::string(to_string(options.correlation)) + slope + name_of(scale) + name_of(noise),
           [=](const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const Eigen::VectorXd& noise_variance) {
             if (noise == NoiseOfRuns::estimated)
               return kriging::fit_transformed(X, y, scale, range, options);
             kriging::FitOptions known = kriging::with_known_noise(options, noise_variance);
             if (noise == NoiseOfRuns::modelled && known.noise == kriging::Noise::known)
               known = kriging::with_modelled_noise(known, X);
             return kriging::fit_transformed(X, y, scale, range, known);
           }},
          noise};
}

/// Of response j on runs that the models have not seen, by the noise that these tell, or are expected to
/// have, where the model was fitted with such noise.
kriging::Validation validation_of(const Models& fitted, const doe::Evaluations& runs, std::size_t j) {
  const doe::Response& response = runs.problem.responses[j];
  const Eigen::MatrixXd X = runs.X();
  const Eigen::VectorXd y = runs.y(response.name);
  switch (fitted.noise[j]) {
    case NoiseOfRuns::estimated:
      return kriging::validate(fitted.models[j], X, y);
    case NoiseOfRuns::told:
      return kriging::validate(fitted.models[j], X, y, runs.noise_variance(response.name));
    case NoiseOfRuns::modelled:
      break;
  }
  return kriging::validate(fitted.models[j], X, y, expected_noise(fitted.models, runs.problem, j, X));
}

}  // namespace

std::string_view to_string(NoiseOfRuns noise) {
  switch (noise) {
    case NoiseOfRuns::estimated:
      return "estimated";
    case NoiseOfRuns::told:
      return "told";
    case NoiseOfRuns::modelled:
      return "modelled";
  }
  return "unknown";
}

kriging::RunNoise told_noise(const doe::Evaluations& runs, const doe::Response& response) {
  const Eigen::VectorXd variance = runs.noise_variance(response.name);
  if (variance.size() == 0 || !(variance.maxCoeff() > 0) || !(variance.maxCoeff() <= most_told_variance))
    return {};
  return {kriging::Noise::known, variance};
}

std::vector<StudyWay> ways_to_fit(const doe::Problem& problem, const doe::Response& response,
                                  kriging::Scale scale, const kriging::RunNoise& noise) {
  std::vector<StudyWay> ways;
  for (const NoiseOfRuns source : {NoiseOfRuns::estimated, NoiseOfRuns::told, NoiseOfRuns::modelled}) {
    if (source != NoiseOfRuns::estimated && noise.noise != kriging::Noise::known) break;
    for (const auto correlation : {kriging::Correlation::gaussian, kriging::Correlation::matern52}) {
      for (const auto trend : {kriging::Trend::constant, kriging::Trend::linear}) {
        kriging::FitOptions options = default_fit(problem);
        options.correlation = correlation;
        options.trend = trend;
        ways.push_back(way_to_fit(options, range_of(response), scale, source));
      }
    }
  }
  return ways;
}

Models fit_models(const Tables& tables) {
  const doe::Problem& problem = tables.training.problem;
  const Eigen::MatrixXd X = tables.training.X();
  Models fitted;
  for (const auto& response : problem.responses) {
    const Eigen::VectorXd y = tables.training.y(response.name);
    const kriging::ResponseRange range = range_of(response);
    const kriging::FitChoice on_scale = kriging::choose_scale(X, y, range, default_fit(problem));
    const kriging::RunNoise noise = told_noise(tables.training, response);
    const std::vector<StudyWay> ways = ways_to_fit(problem, response, on_scale.scale(), noise);
    kriging::FitChoice choice = kriging::choose_fit(X, y, range, {ways.begin(), ways.end()}, noise);
    fitted.ways.push_back(choice.name());
    fitted.noise.push_back(ways[choice.best].noise);
    fitted.models.push_back(std::move(choice.model));
  }
  if (tables.validation.X().rows() == 0) return fitted;
  for (std::size_t j = 0; j < problem.responses.size(); ++j)
    fitted.validations.push_back(validation_of(fitted, tables.validation, j));
  return fitted;
}

Models models_or_reason(const Tables& tables) {
  try {
    return fit_models(tables);
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error("studies: there are no models: " + std::string(e.what()) +
                             "; make more runs with the command run, or ask and tell");
  }
}

std::string nrmse_text(const Models& fitted, const doe::Problem& problem) {
  std::string text;
  for (std::size_t j = 0; j < fitted.validations.size(); ++j) {
    char number[32];
    std::snprintf(number, sizeof number, "%.3g", fitted.validations[j].nrmse);
    text += (j == 0 ? "NRMSE " : ", ") + problem.responses[j].name + " " + number;
  }
  return text;
}

PlannedPoints with_predictions(const std::vector<kriging::TransformedModel>& models,
                               const doe::Problem& problem, const Eigen::MatrixXd& X) {
  const Eigen::MatrixXd none(X.rows(), static_cast<Eigen::Index>(models.size()));
  PlannedPoints points{X, none, none, none};
  for (std::size_t j = 0; j < models.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    const auto bounded = [&](double y) { return doe::within_range(problem.responses[j], y); };
    points.predicted.col(column) = models[j].mean(X).unaryExpr(bounded);
    points.lower.col(column) = run_quantile(models, problem, j, X, 0.5 - 0.5 * stated_level);
    points.upper.col(column) = run_quantile(models, problem, j, X, 0.5 + 0.5 * stated_level);
  }
  return points;
}

}  // namespace drawpoint::studies
