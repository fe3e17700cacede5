// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/fits/words.h>
#include <drawpoint/studies/model/fronts/front_points.h>
#include <drawpoint/studies/model/trust.h>
#include <drawpoint/studies/say/page/answer.h>
#include <drawpoint/studies/say/page/next_steps.h>

#include <algorithm>

namespace drawpoint::studies::detail {
namespace {

constexpr std::size_t most_steps = 3;
constexpr int some_more = 2;  // for those that fail

using Steps = std::vector<NextStep>;

std::string command(const ReportInput& input, const std::string& options) {
  return command_text(input, input.going_on.making + " " + options);
}

/// Names of the responses with poor models, flat ones aside: those with noisy runs if `noisy`, else the others.
std::string poor_names(const ReportInput& input, bool noisy) {
  std::string names;
  for (std::size_t j = 0; j < input.validations.size(); ++j)
    if (is_poor(input, j) && is_noisy(input, j) == noisy && !is_flat(input.flat, j))
      names += (names.empty() ? "" : ", ") + pretty(input.problem.responses[j].name);
  return names;
}

/// A quarter of the points more, eight at least. Where some response is noise, places chosen by the models
/// are chosen by noise: an even design then.
std::string more_runs(const ReportInput& input) {
  const Continuation& c = input.going_on;
  const int more = std::max(8, (c.training + c.adaptive) / 4);
  bool noisy = false;
  for (std::size_t j = 0; j < input.validations.size(); ++j)
    noisy = noisy || (!doe::is_standard_error(input.problem, j) && is_noisy(input, j));
  return command(input, noisy ? "--runs " + std::to_string(c.training + more)
                              : "--adaptive " + std::to_string(c.adaptive + more));
}

Steps steps_for_failures(const ReportInput& input) {
  const int failed = input.training.failed() + input.validation.failed();
  if (failed == 0) return {};
  return {{"See why " + counted(static_cast<std::size_t>(failed), "run") +
               " failed, and mend the cause; failed runs can be made again.",
           command(input, "--retry-failed")}};
}

Steps steps_for_errors(const ReportInput& input) {
  const int ended = static_cast<int>(input.validation.rows.size()), known = ended - input.validation.failed();
  if (known >= enough_points || input.models.empty() || input.going_on.validation > ended) return {};
  const int wanted = input.going_on.validation + static_cast<int>(enough_points) + some_more - known;
  return {
      {"Give the errors a base: validation runs are apart from those that the models know, and ten or more "
       "tell an error.",
       command(input, "--validation " + std::to_string(wanted))}};
}

Steps steps_for_models(const ReportInput& input) {
  Steps steps;
  if (const std::string flat = flat_objectives(input.flat, input.problem); !flat.empty())
    steps.push_back(
        {"Strategies do not differ clearly in " + flat +
             ": decide on more cycles or samples per run in a study begun anew, or on another response.",
         ""});
  if (const std::string noisy = poor_names(input, true); !noisy.empty())
    steps.push_back(
        {"Make runs quieter before more of them: single runs scatter more in " + noisy +
             " than the models err. Longer runs, if the study has an option for it, or replicates, "
             "both in a study begun anew.",
         ""});
  if (const std::string rough = poor_names(input, false); !rough.empty())
    steps.push_back({"Add runs: the models of " + rough + " are poor.", more_runs(input)});
  return steps;
}

Steps steps_for_front(const ReportInput& input) {
  if (input.front.Y.rows() == 0) return {};
  const std::string confirm = command_text(input, input.confirming);
  const CheckedRuns last = input.confirmations.last_round();
  if (last.runs.empty())
    return {
        {"Have the points of the front that matter simulated: what is predicted only is not to be decided "
         "on.",
         confirm}};
  if (!last.agree())
    return {
        {"Predictions and simulations of the front do not agree yet: go on confirming, the models learn from "
         "it.",
         confirm}};
  if (input.recommended && input.recommended->simulated.empty())
    return {{"Have the recommended strategy simulated.", confirming_point(input, input.recommended->x)}};
  return {};
}

void append(Steps& all, const Steps& more) { all.insert(all.end(), more.begin(), more.end()); }

}  // namespace

std::vector<NextStep> next_steps(const ReportInput& input) {
  if (objectives(as_asked(input.problem, input.flat)).empty()) return {};
  if (!input.going_on.possible)
    return {
        {"Begin a study with today's simulator in another folder: another, or one with fewer responses, made "
         "the runs of this one, and none can be added to them.",
         ""}};
  Steps open = steps_for_errors(input);
  append(open, steps_for_models(input));
  append(open, steps_for_front(input));
  if (open.empty() && input.front.Y.rows() > 0)
    open.push_back(
        {"Choose: the front has the points that matter, with what simulation gave; repeat the one that "
         "you would take with other seeds before deciding.",
         command_text(input, "front")});
  Steps all = steps_for_failures(input);
  append(all, open);
  if (all.size() > most_steps) all.resize(most_steps);
  return all;
}

}  // namespace drawpoint::studies::detail
