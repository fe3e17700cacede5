// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/json_output.h>
#include <drawpoint/studies/run/points/told_outcomes.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>

#include <algorithm>
#include <cstdio>

namespace drawpoint::studies {

int tell_command(const Study& study, const Settings& settings) {
  if (settings.tell.replace && settings.tell.why.find_first_not_of(" \t\n") == std::string::npos)
    throw UsageError("tell --replace: say why with --why TEXT; it is kept in the ledger of corrections");
  const Folder folder{settings.out};
  open_store(study, folder);  // refused before anything is locked
  make_writable(folder);
  const FolderLock lock(folder);
  Store store = open_store(study, folder);
  const auto [told, left_alone] =
      told_outcomes(settings.tell.table, store.identity().problem, store.runs(), settings.tell.replace);
  for (const ToldOutcome& outcome : told) {
    if (outcome.replaces)
      store.replace(outcome.run, outcome.y, outcome.reason, outcome.seconds, settings.tell.why);
    else if (outcome.y.size() > 0)
      store.save_done(outcome.run, outcome.y, outcome.seconds);
    else
      store.save_failed(outcome.run, outcome.reason, outcome.seconds);
  }
  const std::vector<Run> runs = store.runs();
  const auto failed =
      std::count_if(told.begin(), told.end(), [](const ToldOutcome& o) { return o.y.size() == 0; });
  const auto waiting = std::count_if(runs.begin(), runs.end(), [](const Run& run) {
    return run.status == Status::planned || run.status == Status::running;
  });
  const auto taken = static_cast<long>(told.size());
  const auto replaced =
      std::count_if(told.begin(), told.end(), [](const ToldOutcome& o) { return o.replaces; });
  if (settings.json) {
    print_json({{"study", study.name},
                {"done", taken - failed},
                {"failed", failed},
                {"replaced", replaced},
                {"left_alone", left_alone},
                {"waiting", waiting}});
    return 0;
  }
  std::printf("%ld runs taken: %ld done, %ld failed\n", taken, taken - failed, static_cast<long>(failed));
  if (replaced > 0)
    std::printf(
        "%ld of them had ended otherwise; what stood there is in the ledger, which the command exclude "
        "lists\n",
        static_cast<long>(replaced));
  if (left_alone > 0) std::printf("%d rows say neither done nor failed and are left alone\n", left_alone);
  if (waiting > 0)
    std::printf("%ld more are asked for\n", static_cast<long>(waiting));
  else
    std::printf(
        "all that were asked for are told; the next ones: the command ask; what they show: the command "
        "report\n");
  return 0;
}

}  // namespace drawpoint::studies
