// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Carries out the planned runs of a study: processes of this very program, several at a time, each finished
/// run stored at once.
///
/// A child that ends without an outcome (a signal, exit, a time limit) is a failed run with that reason. The
/// study stops where the next runs would fail too: the disk is full, the program cannot be started (such runs
/// do not count, and are planned again), or the first few all failed alike (first_failures.h).

#include <drawpoint/studies/run/budget.h>
#include <drawpoint/studies/run/run_ends.h>
#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

namespace drawpoint::studies {

/// Fills folder.shared() in a child process, if the study asks for it and it is not there yet. The folder
/// appears complete or not at all. What is there is checked (shared_files.h). Throws std::runtime_error with
/// the child's reason or the file that is damaged, Interrupted after a signal.
void prepare_shared(const Study& study, const OptionValues& options, const Folder& folder,
                    int message_descriptor);

/// Until no run is planned, or the budget is spent: returns how many runs that leaves out, training and validation
/// runs in proportion. Tasks of a cluster
/// then go on, and the next command takes them over. Requires an InterruptGuard. Throws Interrupted after a
/// signal, with all children ended, std::runtime_error where the study stops.
int carry_out_runs(Store& store, const Folder& folder, const Settings& settings, int message_descriptor,
                   Budget& budget);
/// Without a budget.
void carry_out_runs(Store& store, const Folder& folder, const Settings& settings, int message_descriptor);

}  // namespace drawpoint::studies
