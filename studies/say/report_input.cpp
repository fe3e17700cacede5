// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/suspects.h>
#include <drawpoint/studies/model/fits/tables.h>
#include <drawpoint/studies/model/fits/unevenness.h>
#include <drawpoint/studies/model/fronts/confirmations.h>
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/studies/model/fronts/front_uncertainty.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/program/printed_text.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/left_out.h>
#include <drawpoint/studies/run/store/marks.h>
#include <drawpoint/studies/say/report_input.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace drawpoint::studies {
namespace {

std::map<std::int64_t, std::string> kinds_of(const std::vector<Run>& runs) {
  std::map<std::int64_t, std::string> kinds;
  for (const auto& run : runs) kinds[run.id] = name_of(run.kind);
  return kinds;
}

/// How likely a run succeeds at the points of the front, and what to be careful about.
void tell_of_failures(ReportInput& input, const Failures& failures) {
  if (input.front.X.rows() > 0) input.success = failures.probability_of_success(input.front.X);
  input.warnings.push_back(
      failures.text() + (failures.model()->place_tells()
                             ? ". Front and adaptive runs keep away from where a run is likelier to fail."
                             : ". Front and adaptive runs keep away from the places of failed runs alone."));
  const auto doubtful = (input.success.array() < 0.9).count();
  if (doubtful > 0)
    input.warnings.push_back("At " + std::to_string(doubtful) + " of " +
                             std::to_string(input.success.size()) +
                             " points of the front a run fails with a chance of more than 10 %.");
}

}  // namespace

ReportInput input_of(const Study& study, const Store& store, const std::vector<Run>& runs) {
  ReportInput input;
  input.study = study.name;
  input.about = study.about;
  input.problem = study.problem;
  input.marks = with_marks(study.presentation.marks, store.marks());
  Tables tables = tables_of(runs, study.problem);
  input.warnings = tables.thinned;
  input.training = std::move(tables.training);
  input.validation = std::move(tables.validation);
  input.kinds = kinds_of(runs);
  input.confirming = confirming_command(study);
  input.going_on = {.possible = store.identity().simulator == study.simulator.name,
                    .making = making_command(study),
                    .training = count_points(runs, Kind::training),
                    .validation = count_points(runs, Kind::validation),
                    .adaptive = std::max(count_points(runs, Kind::adaptive), store.sampling().points)};
  input.confirmations = check_predictions(runs, study.problem, Kind::confirmation, store.sampling().rounds);
  return input;
}

void add_models(ReportInput& input, doe::Seed seed) {
  const Tables tables{.training = input.training, .validation = input.validation};
  if (const std::string failed = failure_warning(input); !failed.empty())
    input.warnings.push_back("Runs that failed are left out of the models. " + failed + ".");
  Models fitted = fit_models(tables);
  for (std::string& sentence : suspects(fitted, tables)) input.warnings.push_back(std::move(sentence));
  for (std::string& sentence : unevenness(fitted, tables)) input.warnings.push_back(std::move(sentence));
  input.models = std::move(fitted.models);
  input.validations = std::move(fitted.validations);
  input.mean_errors = std::move(fitted.mean_errors);
  for (std::size_t j = 0; j < fitted.ways.size(); ++j)
    if (!doe::is_standard_error(input.problem, j))
      input.facts.emplace_back("Model of " + input.problem.responses[j].name, fitted.ways[j]);
  PredictedFront predicted = predicted_front(input.models, tables, seed);
  input.problem = std::move(predicted.problem);
  input.flat = std::move(predicted.flat);
  input.front = std::move(predicted.found.front);
  input.uncertainty = uncertainty_of(input.front, input.models, input.problem, seed);
  if (!predicted.failures.none()) tell_of_failures(input, predicted.failures);
  input.polishing = std::move(predicted.found.polishing);
  if (predicted.found.status == pareto::PolishedFrontStatus::not_polished)
    input.not_polished = std::move(predicted.found.message);
  input.no_front = std::move(predicted.missing);
}

ReportInput input_with_models(const Study& study, const Store& store, const std::vector<Run>& runs,
                              const std::string& command) {
  ReportInput input = input_of(study, store, runs);
  try {
    add_models(input, store.identity().seed);
  } catch (const std::invalid_argument& e) {
    if (input.training.X().rows() == 0) {
      std::string said = command + ": no training run has given values";
      if (const std::string failed = failure_warning(input); !failed.empty()) said += ": " + failed;
      throw std::runtime_error(said + "; the command status says more");
    }
    throw std::runtime_error(command + ": there are no models: " + std::string(e.what()) +
                             "; make more runs with the command run, or ask and tell");
  }
  return input;
}

void add_warnings(ReportInput& input, const std::vector<Run>& runs) {
  for (std::string& sentence : left_out_texts(runs)) input.warnings.push_back(std::move(sentence));
  const auto missing = std::count_if(runs.begin(), runs.end(), [](const Run& run) {
    return run.status == Status::planned || run.status == Status::running;
  });
  if (missing > 0) input.warnings.push_back(std::to_string(missing) + " planned runs are not finished yet.");
  for (std::size_t j = 0; j < input.models.size(); ++j) {
    if (input.models[j].status() == kriging::Status::converged || doe::is_standard_error(input.problem, j))
      continue;
    input.warnings.push_back("Model of " + input.problem.responses[j].name + ": " +
                             input.models[j].message() + ".");
  }
  if (!input.no_front.empty() && has_objective(as_asked(input.problem, input.flat)))
    input.warnings.push_back("There is no front: " + input.no_front + ".");
  if (input.validation.X().rows() == 0) {
    input.warnings.push_back("Without a validation run, nothing tells how good the models are.");
  }
}

std::string failure_warning(const ReportInput& input) {
  std::map<std::string, int> reasons;
  std::map<std::string, std::string> first;  // of the reasons that differ in the name of a log alone
  for (const auto* table : {&input.training, &input.validation}) {
    for (const auto& row : table->rows) {
      if (!row.outcome.failed()) continue;
      const std::string& reason = row.outcome.reason();
      ++reasons[first.emplace(without_log_name(reason), reason).first->second];
    }
  }
  const int most = 5;
  int shown = 0;
  std::string text;
  for (const auto& [reason, count] : reasons) {
    if (shown++ == most) return text + "; and others, which the command status lists";
    text += (text.empty() ? "" : "; ") + std::to_string(count) + " failed: " + reason;
  }
  return text;
}

}  // namespace drawpoint::studies
