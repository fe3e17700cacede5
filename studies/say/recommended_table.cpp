// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/mean_paths.h>
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/say/number_or_null.h>
#include <drawpoint/studies/say/page/answer.h>
#include <drawpoint/studies/say/page/cautions.h>
#include <drawpoint/studies/say/recommended_table.h>
#include <drawpoint/studies/say/text_table.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace drawpoint::studies {
namespace {

constexpr int draws_of_a_mean = 4000;
constexpr double unknown_number = std::numeric_limits<double>::quiet_NaN();

std::string choice_text(const ReportInput& input, const Recommendation& recommended) {
  if (recommended.row < 0)
    return "a place that was simulated and does as well as the best of the predicted front";
  const auto objectives = detail::objectives(input.problem);
  const std::string of = " of " + detail::counted(static_cast<std::size_t>(input.front.X.rows()), "point") +
                         " of the predicted front";
  if (objectives.size() > 1) return "the recommended one" + of;
  return "the best " + input.problem.responses[objectives.front()].name + of;
}

/// The interval of the mean of many runs lies within that of one run.
Interval95 interval_of_mean(const ReportInput& input, const PlannedPoints& points, std::size_t j,
                            const Interval95& run) {
  if (!knows_error(input.models[j], points.X.topRows(1))) return {run.mean, unknown_number, unknown_number};
  const Eigen::MatrixXd draws =
      drawn_means(input.models[j], input.problem.responses[j], points.X.topRows(1), draws_of_a_mean);
  const Ends ends = ends_of({draws.reshaped().begin(), draws.reshaped().end()});
  return {run.mean, std::max(std::min(run.mean, ends.lower), run.lower),
          std::min(std::max(run.mean, ends.upper), run.upper)};
}

/// Above 0: better.
Interval95 gain_of(const ReportInput& input, const Recommendation& recommended, std::size_t j) {
  for (const Gain& gain : recommended.gains) {
    if (gain.response != j) continue;
    const double d = gain.difference();
    if (recommended.x == recommended.reference.x) return {0, 0, 0};
    if (doe::sign_of(input.problem.responses[j].goal) < 0) return {d, gain.lower, gain.upper};
    return {-d, -gain.upper, -gain.lower};
  }
  return {unknown_number, unknown_number, unknown_number};
}

RecommendedResponse response_of(const ReportInput& input, const Recommendation& recommended,
                                const PlannedPoints& points, std::size_t j) {
  const auto column = static_cast<Eigen::Index>(j);
  const Interval95 run{points.predicted(0, column), points.lower(0, column), points.upper(0, column)};
  return {.response = j,
          .mean = interval_of_mean(input, points, j, run),
          .run = run,
          .reference = points.predicted(1, column),
          .gain = gain_of(input, recommended, j)};
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

std::string simulated_text(const RecommendedTable& table, const ReportInput& input) {
  const auto& runs = table.recommended.simulated;
  if (runs.empty())
    return "Not simulated yet; to have it simulated:\n  " + confirming_point(input, table.recommended.x) +
           "\n";
  std::string text;
  for (const doe::Evaluation& run : runs) {
    std::vector<std::string> values;
    for (const RecommendedResponse& r : table.responses)
      values.push_back(input.problem.responses[r.response].name + " " +
                       detail::number(run.outcome.values()[static_cast<Eigen::Index>(r.response)]));
    text += "Simulated by run " + std::to_string(run.run) + ": " + detail::listed(values) + "\n";
  }
  return text;
}

std::vector<std::int64_t> numbers_of(const std::vector<doe::Evaluation>& runs) {
  std::vector<std::int64_t> numbers;
  for (const doe::Evaluation& run : runs) numbers.push_back(run.run);
  return numbers;
}

}  // namespace

RecommendedTable recommended_table(const ReportInput& input) {
  RecommendedTable table{.recommended = *input.recommended, .choice = {}, .success = 1, .responses = {}};
  const Recommendation& recommended = table.recommended;
  table.choice = choice_text(input, recommended);
  if (recommended.row >= 0 && input.success.size() > 0) table.success = input.success[recommended.row];
  Eigen::MatrixXd X(2, recommended.x.size());
  X << recommended.x.transpose(), recommended.reference.x.transpose();
  const PlannedPoints points = with_predictions(input.models, input.problem, X);
  for (std::size_t j = 0; j < input.problem.responses.size(); ++j)
    if (input.problem.responses[j].goal != doe::Goal::record)
      table.responses.push_back(response_of(input, recommended, points, j));
  return table;
}

std::string text(const RecommendedTable& table, const ReportInput& input) {
  const std::string& reference = table.recommended.reference.name;
  std::string text = input.study + ": " + table.choice + ":\n  " +
                     detail::point_text(input.problem, table.recommended.x) + "\n\n";
  std::vector<std::vector<std::string>> rows = {
      {"response", "mean of many runs", "one run", "gain against " + reference}};
  for (const RecommendedResponse& r : table.responses) {
    const doe::Response& response = input.problem.responses[r.response];
    rows.push_back({detail::labelled(response.name, response.unit), with_ends(r.mean),
                    detail::number(r.run.lower) + " to " + detail::number(r.run.upper), gain_text(r.gain)});
  }
  text += text_table(rows);
  text += "\nIn brackets: 95 % intervals, by the models; " + reference + " is " +
          detail::point_text(input.problem, table.recommended.reference.x) + ".\n";
  if (table.success < 1) text += "A run there succeeds with " + detail::percent(table.success) + ".\n";
  for (const auto& [response, why] : texts_of(input.flat, input.problem))
    text += response + ": " + why + ".\n";
  text += simulated_text(table, input);
  for (const std::string& sentence : detail::cautions(input)) text += "Caution: " + sentence + "\n";
  return text;
}

nlohmann::ordered_json as_json(const RecommendedTable& table, const ReportInput& input) {
  nlohmann::ordered_json responses = nlohmann::ordered_json::object();
  for (const RecommendedResponse& r : table.responses)
    responses[input.problem.responses[r.response].name] = {
        {"mean", number_or_null(r.mean.mean)},       {"lower", number_or_null(r.mean.lower)},
        {"upper", number_or_null(r.mean.upper)},     {"run_lower", number_or_null(r.run.lower)},
        {"run_upper", number_or_null(r.run.upper)},  {"against", number_or_null(r.reference)},
        {"gain", number_or_null(r.gain.mean)},       {"gain_lower", number_or_null(r.gain.lower)},
        {"gain_upper", number_or_null(r.gain.upper)}};
  return {{"x", named_values(input.problem, table.recommended.x)},
          {"choice", table.choice},
          {"success", table.success},
          {"against", named_values(input.problem, table.recommended.reference.x)},
          {"responses", std::move(responses)},
          {"simulated", numbers_of(table.recommended.simulated)},
          {"confirm", confirming_point(input, table.recommended.x)},
          {"cautions", detail::cautions(input)}};
}

}  // namespace drawpoint::studies
