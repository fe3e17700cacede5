// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Opening the store that belongs to a study and to the options given, and refusing any other.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <cstdint>

namespace drawpoint::studies {

/// The existing store. Throws std::runtime_error if there is none or it is unsound, UsageError if it belongs
/// to another study or to another problem, saying what differs.
Store open_store(const Study& study, const Folder& folder, Access access = Access::change);

/// For who reads a folder: the study, or where it has gained recorded responses since the folder was begun, as
/// it was then, with a simulator of another name than the folder's. Never throws and never writes: a store
/// that is not there, busy or damaged is left to whoever opens it next, who waits, cleans up or says so.
Study as_begun(const Study& study, const Folder& folder);

/// The run of that number, from 1. Throws UsageError that names --run and says which there are.
Run stored_run(const Store& store, const Folder& folder, std::int64_t id);

/// The command that makes the runs of this study, or gives them to who makes them.
std::string making_command(const Study& study);
/// The command that has points of a front simulated.
std::string confirming_command(const Study& study);
/// " --out FOLDER", for a command that a shell is given.
std::string out_option(const Folder& folder);

/// Throws UsageError for a study whose runs are made elsewhere: it has no black box.
void require_simulator(const Study& study);

/// For messages: in quotes, or that it has none.
std::string named(const std::string& simulator);
/// Before runs are made: throws UsageError where another simulator made those in the folder.
void require_same_simulator(const Study& study, const Store& store, const Folder& folder);

/// Throws UsageError for options that do not go together in a new folder: asked before anything is written.
void check_new_study(const Study& study, const Settings& settings);

/// Throws UsageError for values that cannot go together. `given` may leave out defaults.
void check_options(const Study& study, const OptionValues& given);

/// The store of this study, new if there is none, with all runs that the options ask for planned. Options
/// that are not given are those of the store. Throws like open_store, and UsageError if seed, replicates or
/// numbers of points do not fit what is stored.
Store plan_study(const Study& study, const Folder& folder, const Settings& settings);

}  // namespace drawpoint::studies
