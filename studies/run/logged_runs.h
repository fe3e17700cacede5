// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The runs whose logs may be used, and what a study says first of them.

#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// How the log of a run is made again: "make it again with evaluate ...", as a shell takes it, or that only the
/// simulator of the folder does.
std::string how_made_again(const Study& study, const Identity& identity, const Folder& folder,
                           std::int64_t run);

/// The runs that are done whose log is as they wrote it. A warning names logs that are damaged or not the run's; if
/// there are none such, but some are gone, it tells how many runs have theirs.
std::vector<const Run*> runs_with_log(const Study& study, const Identity& identity,
                                      const std::vector<Run>& runs, const Folder& folder,
                                      std::vector<std::string>& warnings);

/// Presentation::headlines of these runs; where it throws, none and a warning.
std::vector<Headline> headlines_of(const Study& study, const std::vector<const Run*>& runs,
                                   const OptionValues& options, const Folder& folder,
                                   std::vector<std::string>& warnings);

}  // namespace drawpoint::studies
