// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/run_noise.h>
#include <drawpoint/studies/model/fits/stated_interval.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/model/trust.h>
#include <drawpoint/studies/say/page/cautions.h>
#include <drawpoint/studies/say/page/trust_texts.h>

#include <cmath>

namespace drawpoint::studies::detail {
namespace {

constexpr double enough_coverage = 0.75;

/// Against a large error of the mean: runs whose noise hides it, or too few of them.
std::string remedy(const ReportInput& input, std::size_t response) {
  return is_noisy(input, response)
             ? "single runs scatter by more than that; make them longer, if they can be, "
               "or begin a study with more --replicates"
             : "add runs";
}

void caution_about_models(const ReportInput& input, std::vector<std::string>& all) {
  for (std::size_t j = 0; j < input.validations.size(); ++j) {
    const kriging::Validation& v = input.validations[j];
    const std::string name = pretty(input.problem.responses[j].name);
    if (v.observed.size() == 0 || doe::is_standard_error(input.problem, j)) continue;
    if (is_poor(input, j) && !is_flat(input.flat, j))
      all.push_back("The surrogate of " + name + " is poor: it misses the mean by " +
                    share_text(input.mean_errors[j]) + "; " + remedy(input, j) +
                    ", or read only its trends.");
    const double within =
        count_within(v, input.problem.responses[j]) / static_cast<double>(v.observed.size());
    if (v.observed.size() >= enough_points && within < enough_coverage)
      all.push_back("The error bars of " + name + " are too narrow: only " + percent(within) +
                    " of the validation runs lie within their 95 % interval.");
  }
}

/// A model that takes noise for signal follows it, and its intervals are too narrow.
void caution_about_noise(const ReportInput& input, std::vector<std::string>& all) {
  for (std::size_t j = 0; j < input.validations.size(); ++j) {
    const doe::Response& r = input.problem.responses[j];
    const double told = told_noise(input.headlines, r.name);
    if (input.validations[j].observed.size() == 0 || !std::isfinite(told)) continue;
    const double taken = std::sqrt(kriging::modelled_noise(input.validations[j], 1).variance);
    if (taken < 0.5 * told)
      all.push_back("The surrogate of " + pretty(r.name) + " takes a run to scatter by " +
                    number_with_unit(taken, r.unit) + ", the runs themselves say " +
                    number_with_unit(told, r.unit) + ": its intervals are too narrow.");
  }
}

void caution_about_extrapolation(const ReportInput& input, std::vector<std::string>& all) {
  const auto chosen = objectives(input.problem);
  for (std::size_t k = 0; k < chosen.size() && input.front.Y.rows() > 0; ++k) {
    const doe::Response& r = input.problem.responses[chosen[k]];
    const Eigen::VectorXd y = input.training.y(r.name);
    if (y.size() == 0) continue;
    const auto column = static_cast<Eigen::Index>(k);
    const double best = input.front.Y(best_point(input.problem, input.front, column), column);
    const double range = y.maxCoeff() - y.minCoeff();
    const double beyond = r.goal == doe::Goal::maximize ? best - y.maxCoeff() : y.minCoeff() - best;
    if (range > 0.0 && beyond > 0.1 * range)
      all.push_back("The " + superlative(r) + " " + pretty(r.name) + " predicted, " +
                    number_with_unit(best, r.unit) + ", lies " + percent(beyond / range) +
                    " of the range beyond every training run: simulate it before believing it.");
  }
}

void caution_about_confirmations(const ReportInput& input, std::vector<std::string>& all) {
  const CheckedRuns& checked = input.confirmations;
  const CheckedRuns last = checked.last_round();
  if (!last.may_be_chance())
    all.push_back("The front promised what simulation did not keep: in the last round only " +
                  std::to_string(last.within) + " of " + std::to_string(last.values) +
                  " values lay within their 95 % interval. Read the simulated points, not the front, and add "
                  "runs.");
  if (checked.breaking > 0)
    all.push_back(std::to_string(checked.breaking) + " of " + counted(checked.runs.size(), "point") +
                  " of predicted fronts broke a limit when simulated.");
  if (checked.failed > 0)
    all.push_back(std::to_string(checked.failed) + " of " + counted(checked.runs.size(), "point") +
                  " of predicted fronts failed when simulated.");
}

}  // namespace

std::vector<std::string> cautions(const ReportInput& input) {
  std::vector<std::string> all = input.warnings;
  const std::size_t runs = input.training.rows.size() + input.validation.rows.size();
  const auto failed = static_cast<std::size_t>(input.training.failed() + input.validation.failed());
  if (failed > 0)
    all.push_back(std::to_string(failed) + " of " + counted(runs, "run") + " failed (" +
                  percent(static_cast<double>(failed) / static_cast<double>(runs)) +
                  "); the section on the runs shows where.");
  const Eigen::Index points =
      static_cast<Eigen::Index>(input.validation.rows.size()) - input.validation.failed();
  if (points > 0 && points < enough_points)
    all.push_back("Only " + counted(static_cast<std::size_t>(points), "validation point") +
                  ": the errors stated here are rough; use 10 or more.");
  caution_about_models(input, all);
  caution_about_noise(input, all);
  caution_about_extrapolation(input, all);
  caution_about_confirmations(input, all);
  return all;
}

}  // namespace drawpoint::studies::detail
