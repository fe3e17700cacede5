// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The options of the commands that plan and make runs.

#include <drawpoint/studies/run/settings.h>
#include <CLI/CLI.hpp>
#include <drawpoint/studies/study.hpp>

#include <string>

namespace drawpoint::studies {

/// What is wrong with a seed, or "": CLI11 would wrap a negative number around and cut a large one off.
std::string seed_complaint(const std::string& text);

/// "alpha,beta": the variables, as --x takes them.
std::string names_of(const doe::Problem& problem);

void add_run_options(CLI::App& command, Settings& settings, const Defaults& defaults);
void add_sampling_options(CLI::App& command, Settings& settings, const Defaults& defaults);
/// Beside those of sampling, for the command that makes runs itself.
void add_time_options(CLI::App& command, Settings& settings);
void add_execution_options(CLI::App& command, Settings& settings);
void add_confirm_options(CLI::App& command, ConfirmSettings& settings, const doe::Problem& problem);

}  // namespace drawpoint::studies
