// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the commands that make runs have in common.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <functional>

namespace drawpoint::studies {

/// Opens the store, with the folder locked, prepares what runs share, has the work done, and concludes. A
/// signal ends the work in good order with exit code 130 and a word on how to go on.
int work_in_folder(const Study& study, const Settings& settings,
                   const std::function<Store(const Folder& folder)>& open,
                   const std::function<void(Store& store, const Folder& folder)>& work);

/// Before the runs of a command: says what counts as the simulator where none was made yet, else tries whether it
/// is the one of before. `more`: further runs will come, whatever is planned now.
void begin_runs(const Study& study, const Store& store, const Settings& settings, bool more);

/// Fits, searches, writes the report and prints the result. Returns the exit code.
int conclude(const Study& study, const Store& store, const Folder& folder, const Settings& settings);

}  // namespace drawpoint::studies
