// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/models.h>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/kriging/fit.hpp>

#include <cstdio>
#include <stdexcept>

namespace drawpoint::studies {

std::vector<kriging::NamedFitter<kriging::Model>> ways_to_fit(const doe::Problem& problem) {
  std::vector<kriging::NamedFitter<kriging::Model>> ways;
  for (const auto correlation : {kriging::Correlation::gaussian, kriging::Correlation::matern52}) {
    for (const auto trend : {kriging::Trend::constant, kriging::Trend::linear}) {
      kriging::FitOptions options;
      options.threads = 0;
      options.lower = doe::lower_bounds(problem);
      options.upper = doe::upper_bounds(problem);
      options.correlation = correlation;
      options.trend = trend;
      const std::string slope = trend == kriging::Trend::linear ? ", linear trend" : "";
      ways.push_back({std::string(to_string(correlation)) + slope,
                      [options](const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
                        return kriging::fit(X, y, options);
                      }});
    }
  }
  return ways;
}

Models fit_models(const Tables& tables) {
  const kriging::Measure measure{.estimator = kriging::Estimator::leave_one_out,
                                 .error = kriging::ErrorFunction::rmse};
  // Smaller gains are mostly chance: without this, choosing made 13 of 48 smooth fits worse and 5 better.
  const double worth = 0.9;
  const doe::Problem& problem = tables.training.problem;
  const auto ways = ways_to_fit(problem);
  const Eigen::MatrixXd X = tables.training.X();
  const Eigen::MatrixXd X_new = tables.validation.X();
  Models fitted;
  for (const auto& response : problem.responses) {
    const Eigen::VectorXd y = tables.training.y(response.name);
    const auto best = kriging::compare(measure, X, y, ways);
    const bool better = best.table[best.best].assessment.value < worth * best.table[0].assessment.value;
    fitted.ways.push_back(better ? best.name() : ways[0].name);
    fitted.models.push_back(better ? best.model : ways[0].fitter(X, y));
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
                             "; make more runs with the command run");
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

PlannedPoints with_predictions(const std::vector<kriging::Model>& models, const Eigen::MatrixXd& X) {
  const auto responses = static_cast<Eigen::Index>(models.size());
  PlannedPoints points{X, Eigen::MatrixXd(X.rows(), responses), Eigen::MatrixXd(X.rows(), responses)};
  for (Eigen::Index j = 0; j < responses; ++j) {
    const auto p = models[static_cast<std::size_t>(j)].predict(X, kriging::Target::observation);
    points.predicted.col(j) = p.mean;
    points.deviation.col(j) = p.variance.cwiseMax(0.0).cwiseSqrt();
  }
  return points;
}

}  // namespace drawpoint::studies
