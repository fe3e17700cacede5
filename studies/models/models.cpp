// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/models/models.h>
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

}  // namespace

std::vector<kriging::WayToFit> ways_to_fit(const doe::Problem& problem, const doe::Response& response,
                                           kriging::Scale scale) {
  std::vector<kriging::WayToFit> ways;
  for (const auto correlation : {kriging::Correlation::gaussian, kriging::Correlation::matern52}) {
    for (const auto trend : {kriging::Trend::constant, kriging::Trend::linear}) {
      kriging::FitOptions options = default_fit(problem);
      options.correlation = correlation;
      options.trend = trend;
      const std::string slope = trend == kriging::Trend::linear ? ", linear trend" : "";
      ways.push_back(
          {std::string(to_string(correlation)) + slope + name_of(scale),
           [options, scale, range = range_of(response)](const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
             return kriging::fit_transformed(X, y, scale, range, options);
           }});
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
    kriging::FitChoice choice =
        kriging::choose_fit(X, y, range, ways_to_fit(problem, response, on_scale.scale()));
    fitted.ways.push_back(choice.name());
    fitted.models.push_back(std::move(choice.model));
    if (X_new.rows() == 0) continue;
    fitted.validations.push_back(
        kriging::validate(fitted.models.back(), X_new, tables.validation.y(response.name)));
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
    const auto end = [&](double p) { return models[j].quantile(X, p, kriging::Target::observation); };
    points.predicted.col(column) = models[j].mean(X).unaryExpr(bounded);
    points.lower.col(column) = end(0.5 - 0.5 * stated_level).unaryExpr(bounded);
    points.upper.col(column) = end(0.5 + 0.5 * stated_level).unaryExpr(bounded);
  }
  return points;
}

}  // namespace drawpoint::studies
