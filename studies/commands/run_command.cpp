// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/commands/planning.h>
#include <drawpoint/studies/runs/budget.h>
#include <drawpoint/studies/runs/execution.h>
#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/runs/session.h>
#include <unistd.h>

#include <chrono>
#include <vector>

namespace drawpoint::studies {

using Clock = std::chrono::steady_clock;

namespace {

/// The mean of the runs of before says how long another one takes.
void learn_durations(Budget& budget, const std::vector<Run>& runs) {
  for (const Run& run : runs)
    if (has_ended(run) && run.kind != Kind::imported) budget.run_ended(run.seconds);
}

/// Where the budget left something out, it is kept with the study, whose last words say it.
void remember_what_is_left_out(Store& store, const Budget& budget, int runs) {
  Sampling sampling = store.sampling();
  const int adaptive = sampling.points - count_points(store.runs(), Kind::adaptive);
  if (runs == 0 && (adaptive <= 0 || budget.has_room())) return;
  sampling.stopped = "the budget of " + budget.text() + " was spent with " + std::to_string(runs) +
                     (runs == 1 ? " planned run" : " planned runs") + " left out";
  if (adaptive > 0) sampling.stopped += " and " + std::to_string(adaptive) + " adaptive points not chosen";
  store.set_sampling(sampling);
}

}  // namespace

int run_command(const Study& study, const Settings& settings) {
  require_simulator(study);
  const auto start = Clock::now();
  Budget budget(settings.budget);
  const auto seconds_left = [&] {
    const double hours =
        3600.0 * settings.hours - std::chrono::duration<double>(Clock::now() - start).count();
    return budget.has_room() ? hours : 0.0;
  };
  check_request(study, settings);
  const int messages = message_descriptor(settings);
  return work_in_folder(
      study, settings, [&](const Folder& folder) { return plan_study(study, folder, settings); },
      [&](Store& store, const Folder& folder) {
        const std::vector<Run> runs = store.runs();
        begin_runs(study, store, settings, store.sampling().points > count_points(runs, Kind::adaptive));
        learn_durations(budget, runs);
        int left_out = 0;
        do {
          left_out = carry_out_runs(store, folder, settings, messages, budget);
        } while (left_out == 0 && add_batch(store, seconds_left(), messages));
        remember_what_is_left_out(store, budget, left_out);
      });
}

int report_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  const Store store = open_store(study, folder);
  return conclude(study, store, folder, settings);
}

}  // namespace drawpoint::studies
