// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/report/next_steps.h>
#include <drawpoint/studies/report/run_noise.h>
#include <drawpoint/studies/report/summary.h>
#include <drawpoint/studies/report/text.h>

#include <algorithm>

namespace drawpoint::studies::detail {
namespace {

constexpr std::size_t most_steps = 3;
constexpr std::size_t enough_validation = 10;  // runs, below which errors are rough

std::string making(const ReportInput& input) { return input.asked ? "ask" : "run"; }

/// A quarter of the runs more, eight at least; --adaptive counts all adaptive points.
std::string more_runs(const ReportInput& input) {
  const auto is_adaptive = [&](const doe::Evaluation& e) {
    const auto kind = input.kinds.find(e.run);
    return kind != input.kinds.end() && kind->second == "adaptive";
  };
  const auto& runs = input.training.rows;
  const auto made = static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), is_adaptive));
  return making(input) + " --adaptive " + std::to_string(made + std::max<std::size_t>(8, runs.size() / 4));
}

/// Names of the responses whose models are poor, by whether single runs scatter by more than the rest.
std::string poor_names(const ReportInput& input, bool noisy) {
  std::string names;
  for (std::size_t j = 0; j < input.validations.size(); ++j) {
    if (!is_poor(input, j) || noise_leads(input.validations[j]) != noisy) continue;
    names += (names.empty() ? "" : ", ") + pretty(input.problem.responses[j].name);
  }
  return names;
}

void steps_for_runs(const ReportInput& input, std::vector<NextStep>& all) {
  const auto failed = static_cast<std::size_t>(input.training.failed() + input.validation.failed());
  if (failed == 0) return;
  all.push_back(
      {"See why " + counted(failed, "run") + " failed, and mend the cause; failed runs can be made again.",
       making(input) + " --retry-failed"});
}

void steps_for_errors(const ReportInput& input, std::vector<NextStep>& all) {
  const auto known = input.validation.rows.size() - static_cast<std::size_t>(input.validation.failed());
  if (known >= enough_validation || input.models.empty()) return;
  all.push_back(
      {"Give the errors a base: validation runs are apart from those that the models know, and ten or more "
       "tell an error.",
       making(input) + " --validation " + std::to_string(enough_validation + 2)});
}

void steps_for_models(const ReportInput& input, std::vector<NextStep>& all) {
  if (const std::string noisy = poor_names(input, true); !noisy.empty())
    all.push_back(
        {"Make runs quieter before more of them: single runs scatter more in " + noisy +
             " than the models err. Longer runs, if the study has an option for it, or replicates, both in "
             "a study begun anew.",
         ""});
  if (const std::string rough = poor_names(input, false); !rough.empty())
    all.push_back(
        {"Add runs where they teach most: the models of " + rough + " are poor.", more_runs(input)});
}

void steps_for_front(const ReportInput& input, std::vector<NextStep>& all) {
  if (input.front.Y.rows() == 0) return;
  const CheckedRuns last = input.confirmations.last_round();
  if (last.runs.empty())
    all.push_back(
        {"Have the points of the front that matter simulated: what is predicted only is not to be decided "
         "on.",
         input.confirming});
  else if (!last.agree())
    all.push_back(
        {"Predictions and simulations of the front do not agree yet: go on confirming, the models learn from "
         "it.",
         input.confirming});
}

}  // namespace

std::vector<NextStep> next_steps(const ReportInput& input) {
  std::vector<NextStep> all;
  if (objectives(input.problem).empty()) return all;
  steps_for_runs(input, all);
  steps_for_errors(input, all);
  steps_for_models(input, all);
  steps_for_front(input, all);
  if (all.empty() && input.front.Y.rows() > 0)
    all.push_back(
        {"Choose: the front has the points that matter, with what simulation gave; repeat the one that you "
         "would take with other seeds before deciding.",
         "front"});
  if (all.size() > most_steps) all.resize(most_steps);
  return all;
}

}  // namespace drawpoint::studies::detail
