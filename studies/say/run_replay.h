// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The replay of one run of a study, from its log.

#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// A run, or one cycle of it.
struct Replayed {
  const Run& run;
  std::optional<int> cycle = {};
};

/// Writes the page to `file`. `command` is the command line that it shows. Throws std::runtime_error where
/// the run has no log, the log is not what the run wrote, or nothing can be drawn of it; UsageError where it
/// has no such cycle. Requires Presentation::illustrate.
void replay(const Study& study, const Store& store, const Folder& folder, const Replayed& shown,
            const std::filesystem::path& file, const std::string& command);

/// The page itself. Throws as `replay` does.
std::string replay_page(const Study& study, const Identity& identity, const Folder& folder,
                        const Replayed& shown, const std::string& command);

/// The first scene of the page, as the page has it: panels.h; null where the study draws none of this run.
/// Throws as `replay` does.
nlohmann::json scene_of_run(const Study& study, const Identity& identity, const Folder& folder,
                            const Replayed& shown);

/// The figures of the page but for scenes to play, of several cycles those of the last; a sentence for each
/// that cannot be drawn goes to `cautions`. Throws as `replay` does.
nlohmann::json flat_figures(const Study& study, const Identity& identity, const Folder& folder,
                            const Run& run, std::vector<std::string>& cautions);

}  // namespace drawpoint::studies
