// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/same_place.h>
#include <drawpoint/studies/model/fits/stop_rule.h>
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/decision_points.h>
#include <drawpoint/studies/model/recommendation.h>
#include <drawpoint/studies/run/logged_runs.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/left_out.h>
#include <drawpoint/studies/say/analysis.h>
#include <drawpoint/studies/say/facts.h>
#include <drawpoint/studies/say/findings.h>
#include <drawpoint/studies/say/hauled.h>
#include <drawpoint/studies/say/page/answer.h>
#include <drawpoint/studies/say/page/report.h>
#include <drawpoint/studies/say/report_input.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

/// Rank by rank away from the tenth that is best in the first objective: a good run that is not the luckiest.
std::vector<const Run*> good_runs(std::vector<const Run*> runs, const doe::Problem& problem) {
  const auto objective =
      std::find_if(problem.responses.begin(), problem.responses.end(),
                   [](const doe::Response& response) { return doe::is_objective(response.goal); });
  const bool none = objective == problem.responses.end();
  const Eigen::Index column = none ? 0 : objective - problem.responses.begin();
  const double sign = none ? -1.0 : doe::sign_of(objective->goal);
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const Run* a, const Run* b) { return sign * a->y[column] < sign * b->y[column]; });
  if (!runs.empty())
    std::rotate(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 10), runs.end());
  return runs;
}

/// The nearest to the recommended place first.
std::vector<const Run*> runs_near(const doe::Problem& problem, const Eigen::VectorXd& x,
                                  std::vector<const Run*> runs) {
  std::stable_sort(runs.begin(), runs.end(), [&](const Run* a, const Run* b) {
    return detail::largest_difference(problem, a->x, x) < detail::largest_difference(problem, b->x, x);
  });
  return runs;
}

std::string why_shown(const ReportInput& input, const Run& run) {
  const std::optional<Recommendation>& recommended = input.recommended;
  const std::string who =
      "Run " + std::to_string(run.id) + ", " + detail::point_text(input.problem, run.x) + ", ";
  if (!recommended) return who + "has a tenth of the runs before it in the first objective, or nearly so.";
  if (is_same_place(input.problem, run.x, recommended->x)) return who + "is the recommended strategy.";
  return who + "is the run nearest to the recommendation, within " +
         detail::percent(detail::largest_difference(input.problem, run.x, recommended->x)) +
         " of each range.";
}

/// By the first run that can be shown; a few that cannot become warnings.
void illustrate(ReportInput& input, const Study& study, const std::vector<const Run*>& runs,
                const OptionValues& options, const Folder& folder) {
  const int most_attempts = 5;
  input.illustrations = nlohmann::json::array();
  if (!study.presentation.illustrate) return;
  int attempts = 0;
  for (const Run* run : input.recommended ? runs_near(input.problem, input.recommended->x, runs)
                                          : good_runs(runs, study.problem)) {
    if (attempts++ == most_attempts) return;
    try {
      input.illustrations = study.presentation.illustrate(folder.log(run->id), options);
      input.shown = why_shown(input, *run);
      input.facts.emplace_back("Run shown", std::to_string(run->id));
      return;
    } catch (const std::exception& e) {
      input.warnings.push_back("Run " + std::to_string(run->id) + " could not be shown: " + e.what());
    }
  }
}

/// What cannot be told becomes a warning.
void contrast(ReportInput& input, const Study& study, const std::vector<const Run*>& runs,
              const OptionValues& options, const Folder& folder) {
  if (!study.presentation.contrast || runs.empty()) return;
  std::vector<std::filesystem::path> logs;
  for (const Run* run : runs) logs.push_back(folder.log(run->id));
  try {
    input.contrasts = study.presentation.contrast(logs, options);
  } catch (const std::exception& e) {
    input.warnings.push_back(std::string("Runs could not be set against each other: ") + e.what());
  }
}

Summary summary_of(const Study& study, const std::vector<Run>& runs) {
  Summary summary;
  summary.study = study.name;
  summary.left_out = left_out_texts(runs);
  summary.confirming = confirming_command(study);
  for (const auto& run : runs) {
    if (run.status == Status::failed && !run.left_out) ++summary.failed;
    if (has_ended(run))
      ++summary.ended[run.kind];
    else
      ++summary.unfinished;
  }
  for (std::size_t j = 0; j < study.problem.responses.size(); ++j)
    if (!doe::is_standard_error(study.problem, j))
      summary.nrmse.emplace_back(study.problem.responses[j].name, std::numeric_limits<double>::quiet_NaN());
  return summary;
}

void tell_of_models(Summary& summary, const ReportInput& input) {
  auto said = summary.nrmse.begin();
  for (std::size_t j = 0; j < input.validations.size(); ++j)
    if (!doe::is_standard_error(input.problem, j)) {
      summary.mean_errors[said->first] = input.mean_errors[j];
      (said++)->second = input.validations[j].nrmse;
    }
  summary.answer = answer_sentences(input);
  if (input.recommended) {
    summary.recommended = input.recommended->x;
    summary.problem = input.problem;
  }
  summary.flat = texts_of(input.flat, input.problem);
  summary.no_front = input.no_front;
  summary.front = static_cast<int>(input.front.X.rows());
  summary.polishing = input.polishing;
  summary.not_polished = input.not_polished;
}

}  // namespace

Summary analyse(const Study& study, const Store& store, const Folder& folder, const Typed& typed) {
  const std::vector<Run> runs = store.runs();
  Summary summary = summary_of(study, runs);
  summary.adaptive_wanted = store.sampling().points;
  summary.stopped = store.sampling().stopped;
  ReportInput input = input_of(study, store, runs);
  summary.thinned = input.warnings;
  input.command = typed.command;
  input.going_on.program = typed.program;
  input.going_on.folder = out_option(folder);
  summary.confirmations = input.confirmations;
  const std::vector<const Run*> logged = runs_with_log(study, store.identity(), runs, folder, input.warnings);
  input.headlines = summary.headlines =
      headlines_of(study, logged, store.identity().options, folder, input.warnings);
  input.facts = facts(study, store, runs);
  try {
    add_models(input, store.identity().seed);
  } catch (const std::invalid_argument& e) {
    const bool none = input.training.X().rows() == 0;
    summary.error =
        "no models, so no report: " + std::string(none ? "no training run has given values" : e.what());
    const std::string failures = failure_warning(input);
    if (!failures.empty()) summary.error += "; " + failures;
    summary.answer = answer_sentences(input);
    return summary;
  }
  input.recommended = recommend(input);
  add_hauls(input, study, logged, store.identity().options, folder);
  tell_of_models(summary, input);
  const StopState reached = stop_state(stop_rule_from(store.sampling().until, study.problem), study.problem,
                                       input.validations, input.mean_errors);
  summary.until = reached.text;
  summary.until_met = reached.met;
  add_warnings(input, runs);
  illustrate(input, study, logged, store.identity().options, folder);
  contrast(input, study, logged, store.identity().options, folder);
  summary.findings = hold_findings(input, study, logged, store.identity().options, folder);
  write_report(folder.report(), input);
  summary.report = std::filesystem::absolute(folder.report()).lexically_normal();
  return summary;
}

}  // namespace drawpoint::studies
