// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/run/logged_runs.h>
#include <drawpoint/studies/run/session.h>
#include <drawpoint/studies/run/store/run_logs.h>

#include <drawpoint/doe/detail/task_files.hpp>

#include <filesystem>

namespace drawpoint::studies {
namespace {

std::string how_made_again(const Study& study, const Identity& identity, const Folder& folder,
                           const std::string& run, const std::string& log) {
  if (study.simulator.name != identity.simulator)
    return "only the program that made this folder, " + named(identity.simulator) + ", makes it again";
  return "make it again with evaluate --run " + run + " --out " +
         doe::detail::quoted_for_shell(folder.path.string()) + " --log " +
         doe::detail::quoted_for_shell((folder.logs() / log).string());
}

}  // namespace

std::string how_made_again(const Study& study, const Identity& identity, const Folder& folder,
                           std::int64_t run) {
  return how_made_again(study, identity, folder, std::to_string(run), folder.log(run).filename().string());
}

std::vector<const Run*> runs_with_log(const Study& study, const Identity& identity,
                                      const std::vector<Run>& runs, const Folder& folder,
                                      std::vector<std::string>& warnings) {
  std::vector<const Run*> sound;
  std::string others;
  std::size_t wrote = 0;
  for (const auto& run : runs) {
    if (run.status != Status::done) continue;
    wrote += !run.log.empty();
    const LogState state = log_state(folder, run);
    if (state == LogState::sound) sound.push_back(&run);
    if (state == LogState::other)
      others += (others.empty() ? "" : ", ") + folder.log(run.id).filename().string();
  }
  if (!others.empty())
    warnings.push_back("Logs that are damaged, or not what their run wrote, are left out: " + others +
                       ". The responses in the store stand. To have a log again: " +
                       how_made_again(study, identity, folder, "N", "run_000N.h5") + ".");
  else if (!sound.empty() && sound.size() < wrote)
    warnings.push_back(
        "The folder has the logs of " + std::to_string(sound.size()) + " of " + std::to_string(wrote) +
        " runs: what is read from logs, as the figures below the answer, is by these alone. To have a "
        "log again: " +
        how_made_again(study, identity, folder, "N", "run_000N.h5") + ".");
  return sound;
}

std::vector<Headline> headlines_of(const Study& study, const std::vector<const Run*>& runs,
                                   const OptionValues& options, const Folder& folder,
                                   std::vector<std::string>& warnings) {
  if (!study.presentation.headlines) return {};
  std::vector<std::filesystem::path> logs;
  for (const Run* run : runs) {  // those that are spread over the whole box
    if (run->kind == Kind::training || run->kind == Kind::validation) logs.push_back(folder.log(run->id));
  }
  try {
    return study.presentation.headlines(logs, options);
  } catch (const std::exception& e) {
    warnings.push_back(std::string("What the study says first could not be told: ") + e.what());
    return {};
  }
}

}  // namespace drawpoint::studies
