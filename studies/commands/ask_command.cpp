// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/options/output_file.h>
#include <drawpoint/studies/commands/planning.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/say/export.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>

namespace drawpoint::studies {
namespace {

std::vector<Run> waiting(const std::vector<Run>& runs, int most) {
  std::vector<Run> asked;
  for (const Run& run : runs)
    if (run.status == Status::planned && static_cast<int>(asked.size()) < most) asked.push_back(run);
  return asked;
}

/// Those that are planned; where there are none, those of the next batch or, if it is wanted, of a round on
/// the front.
std::vector<Run> next_runs(Store& store, const Study& study, const Settings& settings) {
  const int most = settings.ask.count.value_or(std::numeric_limits<int>::max());
  std::vector<Run> asked = waiting(store.runs(), most);
  if (!asked.empty()) return asked;
  const int round = static_cast<int>(store.sampling().rounds.size()) + 1;
  const bool planned = settings.ask.confirm ? add_round(store, study, settings.confirm, round, STDERR_FILENO)
                                            : add_batch(store, "", STDERR_FILENO);
  if (planned) asked = waiting(store.runs(), most);
  return asked;
}

}  // namespace

int ask_command(const Study& study, const Settings& settings) {
  const Folder folder{settings.out};
  check_request(study, settings);
  ExportSettings wanted = settings.exported;
  wanted.file = output_file(folder, wanted.file);
  make_writable(folder);
  const FolderLock lock(folder);
  Store store = plan_study(study, folder, settings);
  const std::vector<Run> asked = next_runs(store, study, settings);
  write_table(study, asked_table(store.identity(), asked), wanted);
  std::fprintf(
      stderr,
      asked.empty() ? "no run is wanted\n" : "%zu runs to make; say what came out with the command tell\n",
      asked.size());
  return 0;
}

}  // namespace drawpoint::studies
