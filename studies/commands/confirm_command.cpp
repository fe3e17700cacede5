// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/commands/options/points.h>
#include <drawpoint/studies/commands/planning.h>
#include <drawpoint/studies/model/fronts/confirmations.h>
#include <drawpoint/studies/model/fronts/front.h>
#include <drawpoint/studies/model/sampling/confirmation_round.h>
#include <drawpoint/studies/run/execution.h>
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/session.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace drawpoint::studies {
namespace {

/// Whether the last round came out as predicted; says so.
bool judge_round(const Store& store, int messages, int round) {
  const CheckedRuns last =
      check_predictions(store.runs(), store.identity().problem, Kind::confirmation, store.sampling().rounds)
          .last_round();
  const char* verdict = "prediction and simulation do not agree";
  if (last.agree()) verdict = "no more misses than chance explains";
  if (last.values == 0 && last.failed == 0) verdict = "no objective and no limit to judge by";
  dprintf(messages, "round %d: %s: %s\n", round, text(last).c_str(), verdict);
  return last.agree() || (last.failed == 0 && last.values == 0);
}

bool has_unfinished_round(const std::vector<Run>& runs) {
  return std::any_of(runs.begin(), runs.end(), [](const Run& run) {
    return run.kind == Kind::confirmation && (run.status == Status::planned || run.status == Status::running);
  });
}

/// First what a stopped command left, then rounds.
void confirm_front(Store& store, const Study& study, const Folder& folder, const Settings& settings) {
  const int messages = message_descriptor(settings);
  store.plan_again(settings.execution.retry_failed);
  bool added = has_unfinished_round(store.runs());
  carry_out_runs(store, folder, settings, messages);
  for (int round = 1; round <= settings.confirm.rounds; ++round, added = false) {
    if (!added) {
      if (!add_round(store, study, settings.confirm, round, messages)) return;
      carry_out_runs(store, folder, settings, messages);
    }
    if (judge_round(store, messages, round)) return;
  }
  dprintf(messages, "the rounds are spent; give the same command again for more\n");
}

}  // namespace

int confirm_command(const Study& study, const Settings& settings) {
  require_simulator(study);
  if (settings.confirm.x.empty() && !has_objective(study.problem))
    throw UsageError(
        "confirm: no response is minimized or maximized, so there is no front; name points with --x");
  if (settings.confirm.x.empty() && settings.confirm.points == 0)
    throw UsageError("--points 0: no point is named with --x either; name one, or give --points 1 or more");
  named_points(study.problem, settings.confirm);  // refused before anything is done
  open_store(study, Folder{settings.out});
  return work_in_folder(
      study, settings, [&](const Folder& folder) { return open_store(study, folder); },
      [&](Store& store, const Folder& folder) {
        begin_runs(study, store, settings, true);
        confirm_front(store, study, folder, settings);
      });
}

}  // namespace drawpoint::studies
