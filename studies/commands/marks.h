// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points that a user names on the command line: --mark 'today=1.2,0.8,0.8,0'.

#include <drawpoint/studies/runs/settings.h>
#include <drawpoint/studies/study.hpp>

#include <CLI/CLI.hpp>
#include <string>

namespace drawpoint::studies {

void add_mark_option(CLI::App& command, const doe::Problem& problem, Settings& settings);

/// Adds the marks of the settings to those of the study; one of the same name replaces it. Throws UsageError for
/// what is no mark of the problem.
void add_marks(Study& study, const Settings& settings);

}  // namespace drawpoint::studies
