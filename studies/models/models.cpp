// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/models/models.h>
#include <drawpoint/studies/report/run_quantile.h>
#include <drawpoint/studies/report/stated_interval.h>
#include <drawpoint/doe/bounds.hpp>

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

/// With the noise of the runs, or without a word of it where `told` is not.
kriging::WayToFit way_to_fit(const kriging::FitOptions& options, const kriging::ResponseRange& range,
                             kriging::Scale scale, bool told) {
  const std::string slope = options.trend == kriging::Trend::linear ? ", linear trend" : "";
  return {std::string(to_string(options.correlation)) + slope + name_of(scale) +
              (told ? ", noise as the runs tell it" : ""),
          [=](const Eigen::MatrixXd& X, const Eigen::VectorXd& y, const Eigen::VectorXd& noise_variance) {
            if (!told) return kriging::fit_transformed(X, y, scale, range, options);
            kriging::FitOptions with_noise = options;
            with_noise.noise = kriging::Noise::known;
            with_noise.noise_variance = noise_variance;
            return kriging::fit_transformed(X, y, scale, range, with_noise);
          }};
}

/// On runs that the model has not seen; by the noise that these tell where the model was fitted with it.
kriging::Validation validation_of(const kriging::TransformedModel& model, const doe::Evaluations& runs,
                                  const doe::Response& response) {
  const Eigen::MatrixXd X = runs.X();
  const Eigen::VectorXd y = runs.y(response.name);
  if (!knows_noise(model)) return kriging::validate(model, X, y);
  return kriging::validate(model, X, y, runs.noise_variance(response.name));
}

}  // namespace

kriging::RunNoise told_noise(const doe::Evaluations& runs, const doe::Response& response) {
  const Eigen::VectorXd variance = runs.noise_variance(response.name);
  if (variance.size() == 0 || !(variance.maxCoeff() > 0)) return {};
  return {kriging::Noise::known, variance};
}

std::vector<kriging::WayToFit> ways_to_fit(const doe::Problem& problem, const doe::Response& response,
                                           kriging::Scale scale, const kriging::RunNoise& noise) {
  std::vector<kriging::WayToFit> ways;
  for (const bool told : {false, true}) {
    if (told && noise.noise != kriging::Noise::known) break;
    for (const auto correlation : {kriging::Correlation::gaussian, kriging::Correlation::matern52}) {
      for (const auto trend : {kriging::Trend::constant, kriging::Trend::linear}) {
        kriging::FitOptions options = default_fit(problem);
        options.correlation = correlation;
        options.trend = trend;
        ways.push_back(way_to_fit(options, range_of(response), scale, told));
      }
    }
  }
  return ways;
}

Models fit_models(const Tables& tables) {
  const doe::Problem& problem = tables.training.problem;
  const Eigen::MatrixXd X = tables.training.X();
  const Eigen::MatrixXd X_new = tables.validation.X();
  Models fitted;
  for (const auto& response : problem.responses) {
    const Eigen::VectorXd y = tables.training.y(response.name);
    const kriging::ResponseRange range = range_of(response);
    const kriging::FitChoice on_scale = kriging::choose_scale(X, y, range, default_fit(problem));
    const kriging::RunNoise noise = told_noise(tables.training, response);
    kriging::FitChoice choice =
        kriging::choose_fit(X, y, range, ways_to_fit(problem, response, on_scale.scale(), noise), noise);
    fitted.ways.push_back(choice.name());
    fitted.models.push_back(std::move(choice.model));
    if (X_new.rows() > 0)
      fitted.validations.push_back(validation_of(fitted.models.back(), tables.validation, response));
  }
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
