// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points that a user names on the command line, --mark 'today=1.2,0.8,0.8,0', and takes away by --mark 'today='. The
/// folder keeps them.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/study.hpp>

#include <CLI/CLI.hpp>
#include <string>

namespace drawpoint::studies {

void add_mark_option(CLI::App& command, const doe::Problem& problem, Settings& settings);

/// Throws UsageError for what is no mark of the problem, for one name twice, and where the folder has no mark of a
/// name that is to be taken away. Changes nothing.
void check_typed_marks(const Study& study, const Settings& settings);

/// Puts the marks of the settings into the store, and says on the descriptor which it replaces or takes away. Throws
/// like check_typed_marks.
void keep_marks(Store& store, const Study& study, const Settings& settings, int messages);

}  // namespace drawpoint::studies
