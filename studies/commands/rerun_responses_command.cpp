// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/commands/commands.h>
#include <drawpoint/studies/commands/folder_work.h>
#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/responses_anew.h>
#include <drawpoint/studies/run/session.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

namespace drawpoint::studies {
namespace {

namespace fs = std::filesystem;

/// "results/new/" is the folder "results/new".
fs::path without_slash(const fs::path& path) { return path.has_filename() ? path : path.parent_path(); }

void check_folders(const Folder& from, const Folder& to) {
  if (!fs::exists(from.store()))
    throw std::runtime_error("rerun-responses: there is no study in " + from.path.string() +
                             " (no file study.db); name one with --from");
  if (fs::exists(to.path) && !fs::is_empty(to.path))
    throw UsageError("rerun-responses: " + to.path.string() +
                     " is not empty, and what is there is not touched; name a new folder with --out");
}

/// Adaptive runs may have been confirmation runs: there are as many wanted as there are.
Sampling sampling_anew(Sampling sampling, const std::vector<Run>& runs) {
  sampling.points = std::max(sampling.points, count_points(runs, Kind::adaptive));
  sampling.rounds.clear();
  return sampling;
}

/// The folder appears complete or not at all.
void write_folder(const Folder& to, const Folder& from, const Identity& identity, const Store& source,
                  const std::vector<Run>& runs) {
  const Folder draft{to.path.string() + ".unfinished"};
  fs::remove_all(draft.path);
  bring_files(from, draft, runs);
  {
    Store store = Store::create(draft.store(), identity);
    store.set_sampling(sampling_anew(source.sampling(), runs));
    if (const std::vector<Mark> marks = source.marks(); !marks.empty()) store.set_marks(marks);
    store.add(runs);
  }
  fs::rename(draft.path, to.path);
}

}  // namespace

int rerun_responses_command(const Study& study, const Settings& settings) {
  if (!study.logs.responses)
    throw UsageError(
        "rerun-responses: this study does not say how its responses follow from a run's log "
        "(Logs::responses), so "
        "only new runs give them");
  const Folder from{settings.rerun.from}, to{without_slash(settings.out)};
  check_folders(from, to);
  const Store source = Store::open(from.store());
  require_same_simulation(study, source.identity(), settings.options);
  Identity identity = source.identity();
  identity.problem = study.problem;
  identity.options = options_anew(study, source.identity(), settings.options);
  const std::vector<Run> stored = source.runs();
  dprintf(message_descriptor(settings), "taking the responses of %zu runs from their logs ...\n",
          stored.size());
  const std::vector<Run> runs = runs_with_responses_anew(study, from, stored, identity.options);
  write_folder(to, from, identity, source, runs);
  return conclude(study, open_store(study, to), to, settings);
}

}  // namespace drawpoint::studies
