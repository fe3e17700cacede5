// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/commands/options/mark_options.h>
#include <drawpoint/studies/run/execution.h>
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/spot_check.h>
#include <drawpoint/studies/run/workers.h>
#include <drawpoint/studies/say/analysis.h>
#include <drawpoint/studies/say/study_summary.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace drawpoint::studies {
namespace {

std::string resume_message(const Folder& folder) {
  return "interrupted; every finished run is stored in " + folder.store().string() +
         "; give the same command again to go on\n";
}

/// A message on the tasks that go on with Slurm; empty where there are none.
std::string slurm_message(const Folder& folder) {
  const std::string arrays = arrays_of(folder);
  if (arrays.empty()) return "";
  return "the tasks that Slurm has go on, and the same command takes them over; to end them: scancel "
         "--name=NAME "
         "for each of " +
         arrays + "\n";
}

}  // namespace

int work_in_folder(const Study& study, const Settings& settings,
                   const std::function<Store(const Folder& folder)>& open,
                   const std::function<void(Store& store, const Folder& folder)>& work) {
  const Folder folder{settings.out};
  if (std::filesystem::exists(folder.store()))  // before anything is written there
    require_same_simulator(study, open_store(study, folder), folder);
  make_writable(folder);
  const FolderLock lock(folder);
  const InterruptGuard guard(resume_message(folder));
  try {
    Store store = open(folder);
    keep_marks(store, study, settings, message_descriptor(settings));
    prepare_shared(study, store.identity().options, folder, message_descriptor(settings));
    work(store, folder);
    const EndsAtOnce now;
    return conclude(study, store, folder, settings);
  } catch (const Interrupted&) {
    dprintf(STDERR_FILENO, "%s%s", resume_message(folder).c_str(), slurm_message(folder).c_str());
    return 130;
  }
}

void begin_runs(const Study& study, const Store& store, const Settings& settings, bool more) {
  const int messages = message_descriptor(settings);
  const std::vector<Run> runs = store.runs();
  const bool resumes = std::any_of(runs.begin(), runs.end(), has_ended);
  if (!resumes && !study.simulator.note.empty()) dprintf(messages, "%s\n", study.simulator.note.c_str());
  if (!resumes || (!more && std::all_of(runs.begin(), runs.end(), has_ended))) return;
  spot_check(store, Folder{settings.out}, settings, messages);
}

int conclude(const Study& study, const Store& store, const Folder& folder, const Settings& settings) {
  const int messages = message_descriptor(settings);
  dprintf(messages, "fitting the models and searching for the front ...\n");
  const Summary summary = analyse(study, store, folder, {settings.command, settings.program});
  dprintf(messages, "%s", text(summary).c_str());
  if (!summary.error.empty()) dprintf(STDERR_FILENO, "%s\n", summary.error.c_str());
  if (settings.json) std::printf("%s\n", json_line(summary).c_str());
  return summary.error.empty() ? 0 : 1;
}

}  // namespace drawpoint::studies
