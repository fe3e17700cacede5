// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/commands/planning.h>
#include <drawpoint/studies/runs/execution.h>
#include <drawpoint/studies/runs/plan.h>
#include <drawpoint/studies/runs/session.h>
#include <unistd.h>

#include <chrono>
#include <vector>

namespace drawpoint::studies {

using Clock = std::chrono::steady_clock;

int run_command(const Study& study, const Settings& settings) {
  require_simulator(study);
  const auto start = Clock::now();
  const auto seconds_left = [&] {
    return 3600.0 * settings.hours - std::chrono::duration<double>(Clock::now() - start).count();
  };
  check_request(study, settings);
  const int messages = message_descriptor(settings);
  return work_in_folder(
      study, settings, [&](const Folder& folder) { return plan_study(study, folder, settings); },
      [&](Store& store, const Folder& folder) {
        const std::vector<Run> runs = store.runs();
        begin_runs(study, store, settings, store.sampling().points > count_points(runs, Kind::adaptive));
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
