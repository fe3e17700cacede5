// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/runs/execution.h>
#include <drawpoint/studies/runs/interrupt.h>
#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/runs/session.h>
#include <drawpoint/studies/sampling/adaptive.h>
#include <drawpoint/studies/sampling/criteria.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace drawpoint::studies {
namespace {

using Clock = std::chrono::steady_clock;

Batch chosen_batch(const Store& store, const std::vector<Run>& runs) {
  const EndsAtOnce now;
  return next_batch(store.identity(), store.sampling(), runs);
}

/// Plans a batch of adaptive runs. False when the study has what it wants, or no models to go by.
bool add_batch(Store& store, double seconds_left, int messages) {
  const std::vector<Run> runs = store.runs();
  const int wanted = store.sampling().points;
  const int made = count_points(runs, Kind::adaptive);
  if (made < wanted && seconds_left <= 0.0) {
    dprintf(messages, "no further adaptive runs, the time is up: %d of %d made\n", made, wanted);
    return false;
  }
  if (made < wanted) dprintf(messages, "fitting the models, choosing adaptive points ...\n");
  const Batch batch = chosen_batch(store, runs);
  const char* what = batch.message.c_str();
  switch (batch.status) {
    case BatchStatus::planned:
      dprintf(messages, "adaptive points %d to %d of %d: %s\n", made + 1,
              count_points(batch.runs, Kind::adaptive), wanted, what);
      store.add(batch.runs);
      return true;
    case BatchStatus::target_met:
      dprintf(messages, "no further adaptive runs, the target is met: %s\n", what);
      return false;
    case BatchStatus::exhausted:
      dprintf(messages, "no further adaptive runs, %d of %d made: %s\n", made, wanted, what);
      return false;
    case BatchStatus::no_models:
      dprintf(messages, "no adaptive runs, because there are no models yet: %s\n", what);
      return false;
    default:
      return false;
  }
}

}  // namespace

int run_command(const Study& study, const Settings& settings) {
  const auto start = Clock::now();
  const auto seconds_left = [&] {
    return 3600.0 * settings.hours - std::chrono::duration<double>(Clock::now() - start).count();
  };
  if (settings.criteria) check_criteria(*settings.criteria, study.problem);
  if (!std::filesystem::exists(Folder{settings.out}.store())) check_new_study(study, settings);
  const int messages = message_descriptor(settings);
  return work_in_folder(
      study, settings, [&](const Folder& folder) { return plan_study(study, folder, settings); },
      [&](Store& store, const Folder& folder) {
        do {
          carry_out_runs(store, folder, settings, messages);
        } while (add_batch(store, seconds_left(), messages));
      });
}

int report_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  const Store store = open_store(study, folder);
  return conclude(study, store, folder, settings);
}

}  // namespace drawpoint::studies
