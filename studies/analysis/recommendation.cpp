// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/number_or_null.h>
#include <drawpoint/studies/analysis/recommendation.h>
#include <drawpoint/studies/analysis/text_table.h>
#include <drawpoint/studies/models/decision_points.h>
#include <drawpoint/studies/models/front_uncertainty.h>
#include <drawpoint/studies/models/models.h>
#include <drawpoint/studies/report/summary.h>
#include <drawpoint/studies/report/text.h>
#include <drawpoint/kriging/error_correlation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drawpoint::studies {
namespace {

constexpr int draws_of_a_gain = 1024;
constexpr double unknown_number = std::numeric_limits<double>::quiet_NaN();

int chosen_row(const ReportInput& input) {
  const DecisionPoints points = decision_points(input.front, input.problem);
  return points.best.size() == 1 ? points.best.front() : points.balanced;
}

std::string choice_text(const ReportInput& input) {
  const auto objectives = detail::objectives(input.problem);
  const std::string of = " of " + detail::counted(static_cast<std::size_t>(input.front.X.rows()), "point") +
                         " of the predicted front";
  if (objectives.size() > 1) return "the balanced choice" + of;
  return "the best " + input.problem.responses[objectives.front()].name + of;
}

/// Of draws around a mean that is known better than by them.
Interval95 interval_of(double mean, Eigen::VectorXd draws) {
  if (!draws.allFinite()) return {mean, unknown_number, unknown_number};
  std::sort(draws.begin(), draws.end());
  const auto at = [&](double share) {
    return draws[static_cast<Eigen::Index>(share * static_cast<double>(draws.size()))];
  };
  return {mean, std::min(mean, at(0.025)), std::max(mean, at(0.975))};
}

/// Above 0: better.
double gain_sign(const doe::Response& response) {
  return doe::is_objective(response.goal) ? -doe::sign_of(response.goal) : unknown_number;
}

bool variance_is_known(const kriging::TransformedModel& model, const Eigen::MatrixXd& X) {
  return model.model().predict(X).variance.allFinite();
}

/// n x draws; NaN where the model knows no variance.
Eigen::MatrixXd draws_at(const ReportInput& input, std::size_t j, const Eigen::MatrixXd& X, doe::Seed seed) {
  if (!variance_is_known(input.models[j], X))
    return Eigen::MatrixXd::Constant(X.rows(), draws_of_a_gain, unknown_number);
  const auto normals =
      kriging::correlated_normals(Eigen::MatrixXd::Identity(1, 1), X.rows(), draws_of_a_gain, seed + j);
  return draws_of_mean(input.models[j], input.problem.responses[j], X, normals.front());
}

RecommendedResponse recommended_response(const ReportInput& input, const PlannedPoints& points, std::size_t j,
                                         doe::Seed seed) {
  const auto column = static_cast<Eigen::Index>(j);
  const bool same = points.X.row(0) == points.X.row(1);
  const Eigen::MatrixXd draws = draws_at(input, j, same ? points.X.topRows(1) : points.X, seed);
  const double here = points.predicted(0, column), there = points.predicted(1, column);
  const double sign = gain_sign(input.problem.responses[j]);
  const Eigen::VectorXd own = draws.row(0).transpose();
  const Eigen::VectorXd other = same ? own : Eigen::VectorXd(draws.row(1).transpose());
  const Interval95 run{here, points.lower(0, column), points.upper(0, column)};
  Interval95 mean =
      interval_of(here, own);  // by draws, which miss the ends of a quiet response's by a little
  mean.lower = std::max(mean.lower, run.lower);
  mean.upper = std::min(mean.upper, run.upper);
  return {.response = j,
          .mean = mean,
          .run = run,
          .reference = there,
          .gain = interval_of(sign * (here - there), sign * (own - other))};
}

std::string with_ends(const Interval95& interval) {
  return detail::number(interval.mean) + " (" + detail::number(interval.lower) + " to " +
         detail::number(interval.upper) + ")";
}

std::string gain_text(const Interval95& gain) {
  if (!std::isfinite(gain.mean)) return "a limit";
  const std::string ends = with_ends(gain);
  if (gain.lower > 0) return ends + " better";
  if (gain.upper < 0) return with_ends({-gain.mean, -gain.upper, -gain.lower}) + " worse";
  return ends + " not told apart";
}

nlohmann::ordered_json named_values(const doe::Problem& problem, const Eigen::VectorXd& x) {
  nlohmann::ordered_json values = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < problem.variables.size(); ++k)
    values[problem.variables[k].name] = x[static_cast<Eigen::Index>(k)];
  return values;
}

std::string simulated_text(const Recommendation& recommended, const ReportInput& input,
                           const std::string& confirm) {
  if (recommended.simulated.empty()) return "Not simulated yet; to have it simulated:\n  " + confirm + "\n";
  std::string text;
  for (const CheckedRun& run : input.confirmations.runs) {
    if (std::find(recommended.simulated.begin(), recommended.simulated.end(), run.run) ==
        recommended.simulated.end())
      continue;
    text += "Simulated by run " + std::to_string(run.run) + ": ";
    if (run.outcome.failed()) {
      text += "failed: " + run.outcome.reason() + "\n";
      continue;
    }
    std::vector<std::string> values;
    for (const RecommendedResponse& r : recommended.responses)
      values.push_back(input.problem.responses[r.response].name + " " +
                       detail::number(run.outcome.values()[static_cast<Eigen::Index>(r.response)]) +
                       (run.within[r.response] ? "" : " (outside of what was predicted)"));
    text += detail::listed(values) + "\n";
  }
  return text;
}

}  // namespace

Recommendation recommendation_of(const ReportInput& input, const Eigen::VectorXd& against, doe::Seed seed) {
  const int row = chosen_row(input);
  Recommendation recommended{.x = input.front.X.row(row).transpose(),
                             .against = against,
                             .choice = choice_text(input),
                             .success = input.success.size() > 0 ? input.success[row] : 1.0};
  Eigen::MatrixXd X(2, recommended.x.size());
  X << recommended.x.transpose(), against.transpose();
  const PlannedPoints points = with_predictions(input.models, input.problem, X);
  for (std::size_t j = 0; j < input.problem.responses.size(); ++j)
    if (input.problem.responses[j].goal != doe::Goal::record)
      recommended.responses.push_back(recommended_response(input, points, j, seed));
  for (const CheckedRun& run : input.confirmations.runs)
    if (is_same_place(input.problem, run.x, recommended.x)) recommended.simulated.push_back(run.run);
  return recommended;
}

std::string text(const Recommendation& recommended, const ReportInput& input,
                 const RecommendationWords& words) {
  std::string text = input.study + ": " + recommended.choice + ":\n  " +
                     detail::point_text(input.problem, recommended.x) + "\n\n";
  std::vector<std::vector<std::string>> table = {
      {"response", "mean of many runs", "one run", "gain against " + words.reference}};
  for (const RecommendedResponse& r : recommended.responses) {
    const doe::Response& response = input.problem.responses[r.response];
    table.push_back({detail::labelled(response.name, response.unit), with_ends(r.mean),
                     detail::number(r.run.lower) + " to " + detail::number(r.run.upper), gain_text(r.gain)});
  }
  text += text_table(table);
  text += "\nIn brackets: 95 % intervals, by the models; " + words.reference + " is " +
          detail::point_text(input.problem, recommended.against) + ".\n";
  if (recommended.success < 1)
    text += "A run there succeeds with " + detail::percent(recommended.success) + ".\n";
  for (const auto& [response, why] : texts_of(input.flat, input.problem))
    text += response + ": " + why + ".\n";
  text += simulated_text(recommended, input, words.confirm);
  for (const std::string& sentence : detail::cautions(input)) text += "Caution: " + sentence + "\n";
  return text;
}

nlohmann::ordered_json as_json(const Recommendation& recommended, const ReportInput& input,
                               const RecommendationWords& words) {
  nlohmann::ordered_json responses = nlohmann::ordered_json::object();
  for (const RecommendedResponse& r : recommended.responses)
    responses[input.problem.responses[r.response].name] = {
        {"mean", number_or_null(r.mean.mean)},       {"lower", number_or_null(r.mean.lower)},
        {"upper", number_or_null(r.mean.upper)},     {"run_lower", number_or_null(r.run.lower)},
        {"run_upper", number_or_null(r.run.upper)},  {"against", number_or_null(r.reference)},
        {"gain", number_or_null(r.gain.mean)},       {"gain_lower", number_or_null(r.gain.lower)},
        {"gain_upper", number_or_null(r.gain.upper)}};
  return {{"x", named_values(input.problem, recommended.x)},
          {"choice", recommended.choice},
          {"success", recommended.success},
          {"against", named_values(input.problem, recommended.against)},
          {"responses", std::move(responses)},
          {"simulated", recommended.simulated},
          {"confirm", words.confirm},
          {"cautions", detail::cautions(input)}};
}

}  // namespace drawpoint::studies
