// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The runs of a folder with their responses taken anew from their logs, as runs of a new folder.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <vector>

namespace drawpoint::studies {

/// Throws UsageError where `from` is the store of another study, of other variables, or of options that decide
/// what is simulated and are other ones than given. By whatever simulator its runs were made: the new folder is
/// that simulator's too.
void require_same_simulation(const Study& study, const Identity& from, const OptionValues& given);

/// The options of the new folder: those that decide responses as given, else the study's; the others as
/// stored.
OptionValues options_anew(const Study& study, const Identity& from, const OptionValues& given);

/// All runs of `from`, ids and logs kept. A run that has ended has the outcome that Logs::responses gives;
/// what it throws is a failure of that run. Runs without a log stay failed, or, imported ones, become so.
/// Planned runs stay planned. Confirmation runs become adaptive ones: what was predicted of them was of other
/// responses. Throws std::runtime_error that names the runs whose logs are gone or damaged.
std::vector<Run> runs_with_responses_anew(const Study& study, const Folder& from,
                                          const std::vector<Run>& runs, const OptionValues& options);

/// Puts the logs and the shared files of `from` into `to`, by links where the file system can. Throws
/// std::filesystem::filesystem_error.
void bring_files(const Folder& from, const Folder& to, const std::vector<Run>& runs);

}  // namespace drawpoint::studies
