// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/analysis.h>
#include <drawpoint/studies/analysis/confirmations.h>
#include <drawpoint/studies/analysis/facts.h>
#include <drawpoint/studies/analysis/findings.h>
#include <drawpoint/studies/analysis/front.h>
#include <drawpoint/studies/analysis/models.h>
#include <drawpoint/studies/analysis/suspects.h>
#include <drawpoint/studies/analysis/tables.h>
#include <drawpoint/studies/report/report.h>
#include <drawpoint/studies/store/run_logs.h>
#include <drawpoint/doe/evaluations.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

std::string failure_warning(const doe::Evaluations& training, const doe::Evaluations& validation) {
  std::map<std::string, int> reasons;
  for (const auto* table : {&training, &validation}) {
    for (const auto& row : table->rows) {
      if (row.outcome.failed()) ++reasons[row.outcome.reason()];
    }
  }
  const int most = 5;  // crashes name their output, so their reasons differ
  int shown = 0;
  std::string text;
  for (const auto& [reason, count] : reasons) {
    if (shown++ == most) return text + "; and others, which the command status lists";
    text += (text.empty() ? "" : "; ") + std::to_string(count) + " failed: " + reason;
  }
  return text;
}

void warn_of_places(ReportInput& input, const Failures& failures) {
  if (failures.none()) return;
  input.warnings.push_back(failures.text() +
                           ". Fronts and adaptive runs keep away from where a run is likelier to fail.");
  const auto doubtful = (input.success.array() < 0.9).count();
  if (doubtful > 0)
    input.warnings.push_back(
        "At " + std::to_string(doubtful) + " of " + std::to_string(input.success.size()) +
        " points of the front a run fails with a chance of more than 10 %: see its table.");
}

void warn(ReportInput& input, const std::vector<Run>& runs, const Failures& places) {
  const std::string failures = failure_warning(input.training, input.validation);
  if (!failures.empty())
    input.warnings.push_back("Runs that failed are left out of the models. " + failures + ".");
  warn_of_places(input, places);
  const auto missing = std::count_if(runs.begin(), runs.end(), [](const Run& run) {
    return run.status == Status::planned || run.status == Status::running;
  });
  if (missing > 0) input.warnings.push_back(std::to_string(missing) + " planned runs are not finished yet.");
  for (std::size_t j = 0; j < input.models.size(); ++j) {
    if (input.models[j].status() == kriging::Status::converged) continue;
    input.warnings.push_back("Model of " + input.problem.responses[j].name + ": " +
                             input.models[j].message() + ".");
  }
  if (!input.no_front.empty() && has_objective(input.problem))
    input.warnings.push_back("There is no front: " + input.no_front + ".");
  if (input.validation.X().rows() == 0) {
    input.warnings.push_back("Without a validation run, nothing tells how good the models are.");
  }
}

/// Of the runs that are done, those whose log is as they wrote it; what is wrong with others becomes a
/// warning.
std::vector<const Run*> runs_with_log(const std::vector<Run>& runs, const Folder& folder,
                                      std::vector<std::string>& warnings) {
  std::vector<const Run*> sound;
  std::string others;
  for (const auto& run : runs) {
    if (run.status != Status::done) continue;
    const LogState state = log_state(folder, run);
    if (state == LogState::sound) sound.push_back(&run);
    if (state == LogState::other)
      others += (others.empty() ? "" : ", ") + folder.log(run.id).filename().string();
  }
  if (!others.empty())
    warnings.push_back(
        "Logs that are damaged, or not what their run wrote, are left out: " + others +
        ". The responses in the store stand; evaluate --run N --log logs/run_000N.h5 makes one again.");
  return sound;
}

/// Best first in the first objective.
std::vector<const Run*> runs_to_show(std::vector<const Run*> runs, const doe::Problem& problem) {
  const auto objective =
      std::find_if(problem.responses.begin(), problem.responses.end(),
                   [](const doe::Response& response) { return doe::is_objective(response.goal); });
  const bool none = objective == problem.responses.end();
  const Eigen::Index column = none ? 0 : objective - problem.responses.begin();
  const double sign = none ? -1.0 : doe::sign_of(objective->goal);
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const Run* a, const Run* b) { return sign * a->y[column] < sign * b->y[column]; });
  return runs;
}

/// By the best run that can be shown; a few that cannot become warnings.
void illustrate(ReportInput& input, const Study& study, const std::vector<const Run*>& runs,
                const Folder& folder) {
  const int most_attempts = 5;
  input.illustrations = nlohmann::json::array();
  if (!study.illustrate) return;
  int attempts = 0;
  for (const Run* run : runs_to_show(runs, study.problem)) {
    if (attempts++ == most_attempts) return;
    try {
      input.illustrations = study.illustrate(folder.log(run->id));
      input.facts.emplace_back("Run shown", std::to_string(run->id));
      return;
    } catch (const std::exception& e) {
      input.warnings.push_back("Run " + std::to_string(run->id) + " could not be shown: " + e.what());
    }
  }
}

std::vector<Headline> headlines_of(const Study& study, const std::vector<const Run*>& runs,
                                   const OptionValues& options, const Folder& folder,
                                   std::vector<std::string>& warnings) {
  if (!study.headlines) return {};
  std::vector<std::filesystem::path> logs;
  for (const Run* run : runs) {  // those that are spread over the whole box
    if (run->kind == Kind::training || run->kind == Kind::validation) logs.push_back(folder.log(run->id));
  }
  try {
    return study.headlines(logs, options);
  } catch (const std::exception& e) {
    warnings.push_back(std::string("What the study says first could not be told: ") + e.what());
    return {};
  }
}

std::map<std::int64_t, std::string> kinds_of(const std::vector<Run>& runs) {
  std::map<std::int64_t, std::string> kinds;
  for (const auto& run : runs) kinds[run.id] = name_of(run.kind);
  return kinds;
}

Summary summary_of(const Study& study, const std::vector<Run>& runs) {
  Summary summary;
  summary.study = study.name;
  for (const auto& run : runs) {
    if (run.status == Status::failed) ++summary.failed;
    if (run.status == Status::failed || run.status == Status::done)
      ++summary.ended[run.kind];
    else
      ++summary.unfinished;
  }
  for (const auto& response : study.problem.responses) {
    summary.nrmse.emplace_back(response.name, std::numeric_limits<double>::quiet_NaN());
  }
  return summary;
}

}  // namespace

Summary analyse(const Study& study, const Store& store, const Folder& folder, const std::string& command) {
  const std::vector<Run> runs = store.runs();
  Summary summary = summary_of(study, runs);
  summary.adaptive_wanted = store.sampling().points;
  ReportInput input;
  input.study = study.name;
  input.about = study.about;
  input.command = command;
  input.problem = study.problem;
  const Tables tables = tables_of(runs, study.problem);
  input.training = tables.training;
  input.validation = tables.validation;
  input.kinds = kinds_of(runs);
  input.confirmations = summary.confirmations =
      check_predictions(runs, study.problem, Kind::confirmation, store.sampling().rounds);
  const std::vector<const Run*> logged = runs_with_log(runs, folder, input.warnings);
  input.headlines = summary.headlines =
      headlines_of(study, logged, store.identity().options, folder, input.warnings);
  std::vector<std::string> ways;
  try {
    Models fitted = fit_models(tables);
    for (std::string& sentence : suspects(fitted, tables)) input.warnings.push_back(std::move(sentence));
    input.models = std::move(fitted.models);
    input.validations = std::move(fitted.validations);
    ways = std::move(fitted.ways);
  } catch (const std::invalid_argument& e) {
    summary.error = "no models, so no report: " + std::string(e.what());
    const std::string failures = failure_warning(input.training, input.validation);
    if (!failures.empty()) summary.error += "; " + failures;
    return summary;
  }
  for (std::size_t j = 0; j < input.validations.size(); ++j)
    summary.nrmse[j].second = input.validations[j].nrmse;
  PredictedFront predicted = predicted_front(input.models, tables, store.identity().seed);
  if (!predicted.failures.none() && predicted.found.front.X.rows() > 0)
    input.success = predicted.failures.probability_of_success(predicted.found.front.X);
  input.front = std::move(predicted.found.front);
  input.polishing = std::move(predicted.found.polishing);
  if (predicted.found.status == pareto::PolishedFrontStatus::not_polished)
    input.not_polished = std::move(predicted.found.message);
  input.no_front = summary.no_front = predicted.missing;
  summary.front = static_cast<int>(input.front.X.rows());
  summary.polishing = input.polishing;
  summary.not_polished = input.not_polished;
  input.facts = facts(store, runs);
  for (std::size_t j = 0; j < ways.size(); ++j)
    input.facts.emplace_back("Model of " + study.problem.responses[j].name, ways[j]);
  warn(input, runs, predicted.failures);
  illustrate(input, study, logged, folder);
  summary.findings = hold_findings(input, study, logged, folder);
  write_report(folder.report(), input);
  summary.report = std::filesystem::absolute(folder.report()).lexically_normal();
  return summary;
}

}  // namespace drawpoint::studies
