// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/commands/options/mark_options.h>
#include <drawpoint/studies/commands/planning.h>
#include <drawpoint/studies/run/budget.h>
#include <drawpoint/studies/run/counts.h>
#include <drawpoint/studies/run/execution.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/progress.h>
#include <drawpoint/studies/run/session.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace drawpoint::studies {

using Clock = std::chrono::steady_clock;

namespace {

/// The mean of the runs of before says how long another one takes.
void learn_durations(Budget& budget, const std::vector<Run>& runs) {
  for (const Run& run : runs)
    if (has_ended(run) && run.kind != Kind::imported) budget.run_ended(run.seconds);
}

/// "50 of 60 training and 10 of 12 validation runs, and 8 adaptive points"
std::string left_out_text(const std::vector<Run>& runs, int adaptive_points) {
  std::vector<std::string> parts;
  const Counts counts = count(runs);
  for (const Kind kind : all_kinds) {
    int all = 0;
    for (const Status state : all_states) all += counts.of(kind, state);
    if (const int left = counts.of(kind, Status::planned); left > 0)
      parts.push_back(std::to_string(left) + " of " + std::to_string(all) + " " + name_of(kind));
  }
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k)
    text += (k == 0 ? "" : k + 1 == parts.size() ? " and " : ", ") + parts[k];
  if (!text.empty()) text += " runs";
  if (adaptive_points > 0)
    text += (text.empty() ? "" : ", and ") + std::to_string(adaptive_points) + " adaptive points";
  return text;
}

/// Whole seconds in which a run fits, and with it the one that is made again on resume.
std::string enough_seconds(const Budget& budget, const Settings& settings) {
  return std::to_string(
      static_cast<long>(std::ceil(budget.mean_seconds() * (settings.execution.spot_check ? 2 : 1))) + 1);
}

/// Where the budget left something out, it is kept with the study, whose last words say it. `begun`: whether this
/// command made a run.
void remember_what_is_left_out(Store& store, const Budget& budget, bool begun, const Settings& settings) {
  Sampling sampling = store.sampling();
  const std::vector<Run> runs = store.runs();
  const int adaptive = sampling.stopped.enough ? 0 : sampling.points - count_points(runs, Kind::adaptive);
  const std::string left_out = left_out_text(runs, adaptive);
  if (left_out.empty() || budget.has_room()) return;
  if (begun || budget.runs() == 0 || settings.execution.slurm)
    sampling.stopped = {.why = "the budget of " + budget.text() + " is spent: left out are " + left_out,
                        .go_on = "give the same command again"};
  else
    sampling.stopped = {
        .why = "no run fits into the budget of " + budget.text() + ": one takes " +
               duration_text(budget.mean_seconds()) + ", the mean of " + std::to_string(budget.runs()) +
               " runs; left out are " + left_out,
        .go_on = "give --budget " + enough_seconds(budget, settings) + "s or more, or leave it out"};
  store.set_sampling(sampling);
}

}  // namespace

int run_command(const Study& study, const Settings& settings) {
  require_simulator(study);
  const auto start = Clock::now();
  Budget budget(settings.execution.budget);
  const auto time_is_up = [&]() -> std::string {
    if (!budget.has_room()) return "the budget of " + budget.text() + " is spent";
    const bool in_time =
        std::chrono::duration<double>(Clock::now() - start).count() < 3600.0 * settings.plan.hours;
    return in_time ? "" : "--hours is over";
  };
  check_request(study, settings);
  const int messages = message_descriptor(settings);
  return work_in_folder(
      study, settings, [&](const Folder& folder) { return plan_study(study, folder, settings); },
      [&](Store& store, const Folder& folder) {
        const std::vector<Run> runs = store.runs();
        learn_durations(budget, runs);
        const int known = budget.runs();
        if (budget.has_room())
          begin_runs(study, store, settings, store.sampling().points > count_points(runs, Kind::adaptive));
        int left_out = 0;
        do {
          left_out = carry_out_runs(store, folder, settings, messages, budget);
        } while (left_out == 0 && add_batch(store, time_is_up(), messages));
        remember_what_is_left_out(store, budget, budget.runs() > known, settings);
      });
}

int report_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  Store store = open_store(study, folder);
  keep_marks(store, study, settings, message_descriptor(settings));
  return conclude(study, store, folder, settings);
}

}  // namespace drawpoint::studies
