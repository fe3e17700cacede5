// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/model/fits/same_place.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/model/trust.h>
#include <drawpoint/studies/say/page/answer.h>
#include <drawpoint/studies/say/page/cautions.h>
#include <drawpoint/studies/say/page/next_steps.h>
#include <drawpoint/studies/say/page/report_summary.h>
#include <drawpoint/studies/say/page/trust_texts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace drawpoint::studies::detail {

namespace {

using nlohmann::json;

bool has_limits(const doe::Problem& problem) {
  return std::any_of(problem.responses.begin(), problem.responses.end(),
                     [](const doe::Response& r) { return doe::is_constraint(r.goal); });
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// "production 412 kg/s, joint damage 22 s", leaving one objective out when it was just told (-1: none).
std::string values_text(const ReportInput& input, Eigen::Index row, Eigen::Index without) {
  const auto chosen = objectives(input.problem);
  std::string text;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (static_cast<Eigen::Index>(k) == without) continue;
    const doe::Response& r = input.problem.responses[chosen[k]];
    text += (text.empty() ? "" : ", ") + pretty(r.name) + " " +
            number_with_unit(input.front.Y(row, static_cast<Eigen::Index>(k)), r.unit);
  }
  return text;
}

/// "24 training, 16 adaptive, ", of the runs that the models know.
std::string kinds_text(const ReportInput& input, std::size_t training) {
  std::map<std::string, std::size_t> counts;
  for (const doe::Evaluation& e : input.training.rows) {
    const auto kind = input.kinds.find(e.run);
    if (kind != input.kinds.end() && kind->second != "training") ++counts[kind->second];
  }
  std::string text;
  for (const auto& [kind, count] : counts) {
    text += std::to_string(count) + " " + kind + ", ";
    training -= count;
  }
  return std::to_string(training) + " training, " + text;
}

json cards(const ReportInput& input) {
  json all = json::array();
  for (const Headline& h : input.headlines)
    all.push_back({{"label", capital(pretty(h.name))},
                   {"value", std::isfinite(h.value) ? number(h.value) : "unknown"},
                   {"unit", h.unit == "1" || !std::isfinite(h.value) ? "" : h.unit},
                   {"note", h.note}});
  const auto chosen = objectives(input.problem);
  for (std::size_t k = 0; k < chosen.size() && k < 3 && input.front.Y.rows() > 0; ++k) {
    const doe::Response& r = input.problem.responses[chosen[k]];
    const auto row = best_point(input.problem, input.front, static_cast<Eigen::Index>(k));
    all.push_back({{"label", capital(superlative(r)) + " " + pretty(r.name) + " predicted" +
                                 (has_limits(input.problem) ? " within the limits" : "")},
                   {"value", number(input.front.Y(row, static_cast<Eigen::Index>(k)))},
                   {"unit", r.unit == "1" ? "" : r.unit},
                   {"note", "at " + point_text(input.problem, input.front.X.row(row).transpose())}});
  }
  const std::size_t training = input.training.rows.size(), validation = input.validation.rows.size();
  const int failed = input.training.failed() + input.validation.failed();
  all.push_back({{"label", "Simulated runs"},
                 {"value", std::to_string(training + validation)},
                 {"unit", ""},
                 {"note", kinds_text(input, training) + std::to_string(validation) + " validation; " +
                              (failed == 0 ? "none" : std::to_string(failed)) + " failed"}});
  return all;
}

std::string best_simulated(const ReportInput& input, std::size_t response) {
  const std::string lucky = luckiest_run(input, response);
  if (lucky.empty()) return has_limits(input.problem) ? "; no run simulated so far keeps all limits" : "";
  return lucky;
}

std::string best_sentence(const ReportInput& input, std::size_t k, std::size_t response) {
  const doe::Response& r = input.problem.responses[response];
  const auto column = static_cast<Eigen::Index>(k);
  const auto row = best_point(input.problem, input.front, column);
  const std::string others = values_text(input, row, column);
  return "The " + superlative(r) + " " + pretty(r.name) +
         (has_limits(input.problem) ? " within the limits" : "") + " that the surrogates predict is " +
         number_with_unit(input.front.Y(row, column), r.unit) + ", at " +
         point_text(input.problem, input.front.X.row(row).transpose()) +
         (others.empty() ? "" : ", where they expect " + others) + best_simulated(input, response) + ".";
}

std::string range_sentence(const ReportInput& input) {
  const auto chosen = objectives(input.problem);
  std::vector<std::string> ranges;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const doe::Response& r = input.problem.responses[chosen[k]];
    const auto column = input.front.Y.col(static_cast<Eigen::Index>(k));
    ranges.push_back(pretty(r.name) + " goes from " + number(column.minCoeff()) + " to " +
                     number_with_unit(column.maxCoeff(), r.unit));
  }
  return "Over the " + counted(static_cast<std::size_t>(input.front.Y.rows()), "point") +
         " of the trade-off, " + listed(ranges) + ".";
}

/// The successful confirmation nearest to x (nullptr: none), and its distance: the largest difference in a variable,
/// as a share of its range.
std::pair<const CheckedRun*, double> nearest_confirmation(const ReportInput& input,
                                                          const Eigen::VectorXd& x) {
  std::pair<const CheckedRun*, double> nearest{nullptr, std::numeric_limits<double>::infinity()};
  for (const CheckedRun& checked : input.confirmations.runs) {
    if (checked.outcome.failed()) continue;
    const double apart = largest_difference(input.problem, checked.x, x);
    if (apart < nearest.second) nearest = {&checked, apart};
  }
  return nearest;
}

/// What the simulation nearest to a point of the front gave.
std::string nearest_sentence(const ReportInput& input, const Eigen::VectorXd& x) {
  const auto [run, apart] = nearest_confirmation(input, x);
  if (!run) return "";
  std::string values;
  for (const std::size_t j : objectives(input.problem)) {
    const doe::Response& r = input.problem.responses[j];
    values += (values.empty() ? "" : ", ") + pretty(r.name) + " " +
              number_with_unit(run->outcome.values()[static_cast<Eigen::Index>(j)], r.unit);
  }
  return " Of the points simulated to confirm a front, run " + std::to_string(run->run) +
         " is the nearest to it, within " + percent(apart) + " of each range: it gave " + values + ".";
}

std::string balanced_sentence(const ReportInput& input) {
  const Eigen::Index row = balanced_point(input.problem, input.front);
  return "A balanced choice, nearest to the best of every objective at once, is " +
         point_text(input.problem, input.front.X.row(row).transpose()) + ": " + values_text(input, row, -1) +
         "." + nearest_sentence(input, input.front.X.row(row).transpose());
}

/// What simulation said of predicted fronts; no front is to be believed without.
std::string confirmation_sentence(const ReportInput& input) {
  const CheckedRuns& checked = input.confirmations;
  if (checked.runs.empty())
    return "None of these points has been simulated: the command " + input.confirming +
           " has that done for those that matter.";
  return "Of the fronts predicted so far, simulation has checked " + text(checked) + ".";
}

/// By how much the surrogates of the objectives miss the mean of many runs.
std::string error_sentence(const ReportInput& input) {
  std::vector<std::string> errors;
  for (const std::size_t j : objectives(input.problem))
    if (j < input.mean_errors.size() && std::isfinite(input.mean_errors[j].nrmse()))
      errors.push_back(pretty(input.problem.responses[j].name) + " by " +
                       percent(input.mean_errors[j].nrmse()));
  return errors.empty() ? ""
                        : "How sure is that? Validation runs say that the surrogates miss the mean of " +
                              listed(errors) + " of the range seen.";
}

/// How much of the front would stay if the surrogates knew the means.
std::string certainty_sentence(const ReportInput& input) {
  const Eigen::VectorXd& known = input.uncertainty.non_dominated;
  if (known.size() == 0) return "";
  return "As sure as the surrogates are of the means of many runs, " +
         std::to_string((known.array() >= 0.5).count()) + " of these " +
         counted(static_cast<std::size_t>(known.size()), "point") +
         " are non-dominated with a chance of one half or more.";
}

/// The objectives that say nothing, each in a sentence, and the other responses in one.
void append_flat(const ReportInput& input, json& all) {
  std::vector<std::string> others;
  for (const FlatResponse& flat : input.flat) {
    const std::string name = pretty(input.problem.responses[flat.response].name);
    if (doe::is_objective(flat.asked))
      all.push_back(capital(name) + ": " + flat_text(flat, input.problem) + ".");
    else
      others.push_back(name);
  }
  if (!others.empty())
    all.push_back("Of " + listed(others) +
                  " nothing is said: " + (others.size() > 1 ? "their models do" : "its model does") +
                  " not differ between strategies by clearly more than " +
                  (others.size() > 1 ? "their own errors." : "its own error."));
}

/// "alpha for production, beta for spill", of the responses whose surrogates are good enough to say so.
std::string drivers(const ReportInput& input, const std::vector<Eigen::VectorXd>& influence) {
  std::string text;
  for (std::size_t j = 0; j < influence.size(); ++j) {
    Eigen::Index k = 0;
    if (doe::is_standard_error(input.problem, j) || is_poor(input, j) || is_flat(input.flat, j) ||
        influence[j].maxCoeff(&k) <= 0.0)
      continue;
    text += (text.empty() ? "" : ", ") + pretty(input.problem.variables[static_cast<std::size_t>(k)].name) +
            " for " + pretty(input.problem.responses[j].name);
  }
  return text;
}

/// Which variable matters most for each response. A poor surrogate takes noise for influence.
std::string driver_sentence(const ReportInput& input, const std::vector<Eigen::VectorXd>& influence) {
  const std::string told = drivers(input, influence);
  std::string poor;
  for (std::size_t j = 0; j < influence.size(); ++j)
    if (is_poor(input, j) && !is_flat(input.flat, j))
      poor += (poor.empty() ? "" : ", ") + pretty(input.problem.responses[j].name);
  std::string text = told.empty() ? "" : "The variable that matters most is " + told + ".";
  if (!poor.empty())
    text += (text.empty() ? "" : " ") + ("Which variable matters most is not said for " + poor +
                                         ": a surrogate this poor takes noise for influence.");
  return text;
}

json sentences(const ReportInput& input, const std::vector<Eigen::VectorXd>& influence) {
  json all = json::array();
  const auto chosen = objectives(input.problem);
  const auto done = input.training.rows.size() - static_cast<std::size_t>(input.training.failed());
  if (done == 0) all.push_back("No training run succeeded, so there is nothing to fit, predict or search.");
  if (input.front.Y.rows() > 0 && !chosen.empty()) {
    all.push_back(best_sentence(input, 0, chosen[0]));
    if (const std::string sure = error_sentence(input); !sure.empty()) all.push_back(sure);
    if (chosen.size() > 1) all.push_back(balanced_sentence(input));
    if (chosen.size() > 1) all.push_back(range_sentence(input));
    if (const std::string sure = certainty_sentence(input); chosen.size() > 1 && !sure.empty())
      all.push_back(sure);
    all.push_back(confirmation_sentence(input));
  }
  append_flat(input, all);
  const std::string driving = driver_sentence(input, influence);
  if (input.problem.variables.size() > 1 && !driving.empty()) all.push_back(driving);
  return all;
}

json next_json(const ReportInput& input) {
  json all = json::array();
  for (const NextStep& step : next_steps(input))
    all.push_back({{"text", step.text}, {"command", step.command}});
  return all;
}

}  // namespace

json summary(const ReportInput& input, const std::vector<Eigen::VectorXd>& influence) {
  return {{"cards", cards(input)},
          {"sentences", sentences(input, influence)},
          {"trust", trust(input)},
          {"cautions", cautions(input)},
          {"next", next_json(input)}};
}

}  // namespace drawpoint::studies::detail
