// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/run_noise.h>
#include <drawpoint/studies/model/fits/run_quantile.h>
#include <drawpoint/studies/model/fits/stated_interval.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/say/model_report.h>
#include <drawpoint/studies/say/number_or_null.h>
#include <drawpoint/studies/say/study_summary.h>
#include <drawpoint/kriging/cross_validation.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

namespace drawpoint::studies {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string with_unit(double value, const std::string& unit) {
  return number(value) + (unit.empty() || unit == "1" ? "" : " " + unit);
}

/// The error of the mean response, as text to go before the errors on single runs; empty where these have no noise.
std::string mean_error_text(const kriging::MeanError& error, const std::string& unit) {
  if (!(error.noise > 0)) return "";
  return "error of the mean " + with_unit(error.rmse, unit) + " (" + number(error.lower) + " to " +
         number(error.upper) + "), " + number(error.nrmse()) +
         " of the range; of single runs, whose noise is " + with_unit(error.noise, unit) + ": ";
}

/// Errors of predictions against runs that the model did not know.
std::string errors_text(const kriging::Validation& v, const kriging::MeanError& error,
                        const doe::Response& response) {
  return mean_error_text(error, response.unit) + "RMSE " + with_unit(v.rmse, response.unit) + ", NRMSE " +
         (std::isfinite(v.nrmse) ? number(v.nrmse) : "unknown") + ", " +
         std::to_string(count_within(v, response)) + " of " + std::to_string(v.observed.size()) +
         " within their 95 % interval";
}

Json errors_json(const kriging::Validation& v, const kriging::MeanError& error,
                 const doe::Response& response) {
  return {{"runs", v.observed.size()},
          {"mean_error", mean_error_json(error)},
          {"rmse", number_or_null(v.rmse)},
          {"noise", number_or_null(std::sqrt(kriging::modelled_noise(v, 1).variance))},
          {"rmse_without_noise", number_or_null(error.rmse)},
          {"nrmse", number_or_null(v.nrmse)},
          {"q2", number_or_null(kriging::score(v, kriging::ErrorFunction::q2))},
          {"within", count_within(v, response)}};
}

/// Standard deviation of one run's noise, on the scale that is fitted, as text.
std::string noise_text(const kriging::TransformedModel& model, const std::string& unit) {
  const double noise = std::sqrt(model.noise_variance());
  const std::string mean = noise_differs(model) ? ", in the mean square" : "",
                    told = knows_noise(model) ? mean + ", by what the runs tell" : "";
  if (model.transform().scale == kriging::Scale::linear) return with_unit(noise, unit) + told;
  return number(noise) + " on the scale " + std::string(to_string(model.transform().scale)) + told;
}

}  // namespace

std::string fit_text(const Models& fitted, const doe::Problem& problem) {
  std::string text;
  for (std::size_t j = 0; j < fitted.models.size(); ++j) {
    if (doe::is_standard_error(problem, j)) continue;
    const kriging::TransformedModel& model = fitted.models[j];
    const doe::Response& response = problem.responses[j];
    text += detail::labelled(response.name, response.unit) + ": " + fitted.ways[j] + ", " +
            std::to_string(model.runs()) + " runs\n";
    text += "  " + std::string(to_string(model.status())) + ": " + model.message() + "\n";
    const kriging::Validation left_out = leave_one_out(model);
    text += "  runs predicted without themselves: " +
            errors_text(left_out, mean_error_of(left_out, model, problem), response) + "\n";
    text += "  noise of a run: " + noise_text(model, response.unit) + "\n  theta:";
    for (std::size_t k = 0; k < problem.variables.size(); ++k)
      text += (k ? ", " : " ") + problem.variables[k].name + " " +
              number(model.model().theta()[static_cast<Eigen::Index>(k)]);
    text += "\n";
  }
  return text;
}

Json fit_json(const Models& fitted, const doe::Problem& problem) {
  Json all = Json::object();
  for (std::size_t j = 0; j < fitted.models.size(); ++j) {
    if (doe::is_standard_error(problem, j)) continue;
    const kriging::TransformedModel& model = fitted.models[j];
    const kriging::Validation left_out = leave_one_out(model);
    Json theta = Json::object();
    for (std::size_t k = 0; k < problem.variables.size(); ++k)
      theta[problem.variables[k].name] = model.model().theta()[static_cast<Eigen::Index>(k)];
    all[problem.responses[j].name] = {
        {"way", fitted.ways[j]},
        {"scale", to_string(model.transform().scale)},
        {"runs", model.runs()},
        {"status", to_string(model.status())},
        {"message", model.message()},
        {"theta", theta},
        {"noise_deviation", number_or_null(std::sqrt(model.noise_variance()))},
        {"noise_source", to_string(fitted.noise[j])},
        {"leave_one_out",
         errors_json(left_out, mean_error_of(left_out, model, problem), problem.responses[j])}};
  }
  return all;
}

std::string success_text(const Failures& failures, const doe::Problem& problem) {
  if (failures.none()) return "";
  const Eigen::VectorXd lengths = failures.model()->length_scales();
  std::string text = "success: " + std::to_string(failures.model()->failures()) + " of " +
                     std::to_string(failures.model()->runs()) + " runs failed. " + failures.text() +
                     "\n  length scales, of the ranges:";
  for (std::size_t k = 0; k < problem.variables.size(); ++k)
    text +=
        (k ? ", " : " ") + problem.variables[k].name + " " + number(lengths[static_cast<Eigen::Index>(k)]);
  return text + "\n";
}

Json success_json(const Failures& failures, const doe::Problem& problem) {
  if (failures.none()) return Json();
  const kriging::SuccessModel& model = *failures.model();
  Json lengths = Json::object();
  for (std::size_t k = 0; k < problem.variables.size(); ++k)
    lengths[problem.variables[k].name] = model.length_scales()[static_cast<Eigen::Index>(k)];
  return {{"runs", model.runs()},
          {"failed", model.failures()},
          {"left_out_score", model.left_out_score()},
          {"share_score", model.share_score()},
          {"length_scales", lengths}};
}

std::string validation_text(const Models& fitted, const Tables& tables) {
  const auto& responses = tables.training.problem.responses;
  const std::vector<std::int64_t> runs = runs_with_values(tables.validation);
  std::string text;
  for (std::size_t j = 0; j < fitted.validations.size(); ++j) {
    if (doe::is_standard_error(tables.training.problem, j)) continue;
    const kriging::Validation& v = fitted.validations[j];
    text += detail::labelled(responses[j].name, responses[j].unit) + ": " +
            errors_text(v, fitted.mean_errors[j], responses[j]) + "\n";
    for (Eigen::Index i = 0; i < v.observed.size(); ++i) {
      const Interval interval = stated_interval(v, i, responses[j]);
      const bool outside = !interval.holds(v.observed[i]);
      text += "  run " + std::to_string(runs[static_cast<std::size_t>(i)]) + ": " + number(v.observed[i]) +
              ", predicted " + number(v.predicted[i]) + " (" + number(interval.lower) + " to " +
              number(interval.upper) + ")" + (outside ? " outside" : "") + "\n";
    }
  }
  return text;
}

Json validation_json(const Models& fitted, const Tables& tables) {
  const auto& responses = tables.training.problem.responses;
  const std::vector<std::int64_t> runs = runs_with_values(tables.validation);
  Json all = Json::object();
  for (std::size_t j = 0; j < fitted.validations.size(); ++j) {
    if (doe::is_standard_error(tables.training.problem, j)) continue;
    const kriging::Validation& v = fitted.validations[j];
    Json entry = errors_json(v, fitted.mean_errors[j], responses[j]);
    entry["rows"] = Json::array();
    for (Eigen::Index i = 0; i < v.observed.size(); ++i) {
      const Interval interval = stated_interval(v, i, responses[j]);
      entry["rows"].push_back({{"run", runs[static_cast<std::size_t>(i)]},
                               {"simulated", v.observed[i]},
                               {"predicted", number_or_null(v.predicted[i])},
                               {"lower", number_or_null(interval.lower)},
                               {"upper", number_or_null(interval.upper)}});
    }
    all[responses[j].name] = std::move(entry);
  }
  return all;
}

}  // namespace drawpoint::studies
