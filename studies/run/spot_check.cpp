// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/interrupt.h>
#include <drawpoint/studies/run/program/one_process.h>
#include <drawpoint/studies/run/run_ends.h>
#include <drawpoint/studies/run/run_files.h>
#include <drawpoint/studies/run/run_process.h>
#include <drawpoint/studies/run/spot_check.h>
#include <drawpoint/studies/run/store/left_out.h>
#include <unistd.h>
#include <drawpoint/doe/detail/csv.hpp>
#include <drawpoint/doe/detail/stranger_file.hpp>

#include <algorithm>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace drawpoint::studies {
namespace {

/// Beside the numbers of runs, whose files the check has no business with.
constexpr std::int64_t checked_id = 0;

/// One of the quicker half, another one as the runs grow more; nothing where none was made here and left as it came.
const Run* run_to_check(const std::vector<Run>& runs, const std::vector<Correction>& corrections) {
  std::set<std::int64_t> corrected;
  for (const Correction& c : corrections)
    if (c.what == replace_word) corrected.insert(c.run);
  std::vector<const Run*> made;
  for (const Run& run : runs)
    if (run.status == Status::done && run.kind != Kind::imported && !run.started.empty() &&
        !corrected.contains(run.id))
      made.push_back(&run);
  if (made.empty()) return nullptr;
  std::stable_sort(made.begin(), made.end(),
                   [](const Run* a, const Run* b) { return a->seconds < b->seconds; });
  const std::size_t quicker_half = (made.size() + 1) / 2;
  return made[made.size() % quicker_half];
}

doe::ProcessEnd made_again(const Run& run, const Store& store, const Folder& folder,
                           const Settings& settings) {
  Run again = run;
  again.id = checked_id;
  make_way(folder, checked_id);
  const doe::Process process = process_of_run(again, folder, store.identity().options, settings);
  if (settings.execution.slurm) {
    require_own_file();
    return end_on_cluster(
        process,
        {.folder = folder.path / "slurm_check", .options = settings.execution.slurm_options, .poll = 1.0});
  }
  const doe::ProcessEnd end = end_of(process);
  if (ended_by_stop_signal(end) && soon(InterruptGuard::requested)) throw Interrupted{};
  return end;
}

/// The first response that differs.
std::string difference(const doe::Problem& problem, const Eigen::VectorXd& there,
                       const Eigen::VectorXd& here) {
  for (Eigen::Index k = 0; k < there.size() && k < here.size(); ++k)
    if (there[k] != here[k])
      return problem.responses[static_cast<std::size_t>(k)].name + " " + doe::detail::number_text(there[k]) +
             " then, " + doe::detail::number_text(here[k]) + " now";
  return "another number of responses";
}

std::string complaint(const Run& run, const doe::Outcome& outcome, const doe::Problem& problem) {
  if (outcome.failed()) return "it fails now: " + outcome.reason();
  return outcome.values() == run.y ? "" : difference(problem, run.y, outcome.values());
}

}  // namespace

void spot_check(const Store& store, const Folder& folder, const Settings& settings, int message_descriptor) {
  if (!settings.execution.spot_check) return;
  const std::vector<Run> runs = store.runs();
  const Run* run = run_to_check(runs, store.corrections());
  if (run == nullptr) return;
  const std::string name = "run " + std::to_string(run->id);
  dprintf(message_descriptor, "making %s again%s, to see that the simulator is the same ...\n", name.c_str(),
          settings.execution.slurm ? " on the cluster" : "");
  const doe::ProcessEnd end = made_again(*run, store, folder, settings);
  const doe::Outcome outcome = run_end(end, folder.printed(checked_id)).outcome;
  drop_unfinished_log(folder, checked_id);
  if (end.timed_out) {
    dprintf(message_descriptor, "%s: stopped by the time limit before it could be compared\n", name.c_str());
    return;
  }
  if (const std::string text = complaint(*run, outcome, store.identity().problem); !text.empty())
    throw std::runtime_error(
        "studies: " + name + " does not come out as it is stored in " + folder.path.string() + ": " + text +
        ". The simulator has changed, or equal x and seed do not give equal values: one model does not take "
        "both. Begin a study with another --out, bring the simulator back, or go on with --no-spot-check");
  doe::detail::clear_away(folder.printed(checked_id));
  dprintf(message_descriptor, "%s: as stored, bit for bit\n", name.c_str());
}

}  // namespace drawpoint::studies
