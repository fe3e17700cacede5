// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The part of the command line that makes no runs: commands that read a folder, and say or write what is in
/// it.

#include <drawpoint/studies/run/settings.h>
#include <CLI/CLI.hpp>
#include <drawpoint/studies/study.hpp>

#include <functional>
#include <string>

namespace drawpoint::studies {

/// What is wrong with the name of a folder, or "".
std::string folder_complaint(const std::string& text);

/// --out alone.
void add_folder_option(CLI::App& command, Settings& settings);

/// --format and --file of a table.
void add_table_options(CLI::App& command, ExportSettings& settings,
                       const std::vector<std::string>& formats = {"csv", "json"});

/// --out and --json.
void add_folder_options(CLI::App& command, Settings& settings);

/// The options fill `settings`; `action` becomes the command that is given. All three must outlive `app`.
void define_reading_commands(CLI::App& app, const Study& study, Settings& settings,
                             std::function<int()>& action);

}  // namespace drawpoint::studies
