// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/analysis/confirmations.h>
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/commands/points.h>
#include <drawpoint/studies/runs/execution.h>
#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/sampling/confirmation.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace drawpoint::studies {
namespace {

/// Simulates what matters on the front of this moment. False when there was nothing left to do, or what came
/// out agrees with what was predicted.
bool confirm_round(Store& store, const Folder& folder, const Settings& settings, int round) {
  const int messages = message_descriptor(settings);
  const doe::Problem& problem = store.identity().problem;
  const std::vector<Run> runs = store.runs();
  const bool first = round == 1 && !settings.confirm.x.empty();
  const Eigen::MatrixXd named = first
                                    ? checked_points(problem, settings.confirm.x)
                                    : Eigen::MatrixXd(0, static_cast<Eigen::Index>(problem.variables.size()));
  const auto added = confirmation_round(store.identity(), runs, named, settings.confirm.points);
  if (added.empty()) {
    dprintf(messages, "every point of the front that matters has been simulated\n");
    return false;
  }
  const int before = count_points(runs, Kind::confirmation);
  dprintf(messages, "round %d: %d points to simulate\n", round,
          count_points(added, Kind::confirmation) - before);
  store.add(added);
  carry_out_runs(store, folder, settings, messages);
  const auto checked = check_predictions(store.runs(), problem, Kind::confirmation,
                                         static_cast<std::int64_t>(runs.size()) + 1);
  const bool agree = checked.agree() && checked.failed == 0;
  dprintf(messages, "round %d: %s: %s\n", round, text(checked).c_str(),
          agree ? "prediction and simulation agree" : "prediction and simulation do not agree yet");
  return !agree;
}

}  // namespace

int confirm_command(const Study& study, const Settings& settings) {
  const auto objective = [](const doe::Response& response) { return doe::is_objective(response.goal); };
  const auto& responses = study.problem.responses;
  if (settings.confirm.x.empty() && std::none_of(responses.begin(), responses.end(), objective))
    throw UsageError(
        "confirm: no response is minimized or maximized, so there is no front; name points with --x");
  if (!settings.confirm.x.empty()) checked_points(study.problem, settings.confirm.x);
  open_store(study, Folder{settings.out});
  return work_in_folder(
      study, settings, [&](const Folder& folder) { return open_store(study, folder); },
      [&](Store& store, const Folder& folder) {
        store.plan_again(settings.retry_failed);
        carry_out_runs(store, folder, settings, message_descriptor(settings));
        int round = 1;
        while (round <= settings.confirm.rounds && confirm_round(store, folder, settings, round)) ++round;
      });
}

}  // namespace drawpoint::studies
