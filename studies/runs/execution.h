// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Carries out the planned runs of a study: processes of this very program, several at a time, each finished
/// run stored at once.
///
/// A child that ends without an outcome (a signal, exit, a time limit) is a failed run with that reason. A
/// run that fails while the disk is full does not count: it is planned again and the study stops, because the
/// next ones would fail too.

#include <drawpoint/studies/runs/settings.h>
#include <drawpoint/studies/store/folder.h>
#include <drawpoint/studies/store/store.h>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/processes.hpp>
#include <drawpoint/studies/study.hpp>

#include <string>

namespace drawpoint::studies {

/// Fills folder.shared() in a child process, if the study asks for it and it is not there yet. The folder
/// appears complete or not at all. What is there is checked (shared_files.h). Throws std::runtime_error with
/// the child's reason or the file that is damaged, Interrupted after a signal.
void prepare_shared(const Study& study, const OptionValues& options, const Folder& folder,
                    int message_descriptor);

/// Until no run is planned. Requires an InterruptGuard. Throws Interrupted after a signal, with all children
/// ended.
void carry_out_runs(Store& store, const Folder& folder, const Settings& settings, int message_descriptor);

/// What a child says through its reply channel.
std::string reply_text(const doe::Outcome& outcome);
/// The outcome of a child that has ended; `printed` is named in the reason of a crash if the file exists.
doe::Outcome outcome_of(const doe::ProcessEnd& end, const std::filesystem::path& printed);

}  // namespace drawpoint::studies
