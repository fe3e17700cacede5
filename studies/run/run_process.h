// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The processes of a study's runs: this very program, with words that say which run.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/doe/processes.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// The program's own file.
std::string own_executable();

/// A task on another machine knows no /proc of this process. Throws std::runtime_error where the file is gone.
void require_own_file();

/// The words of a child's command line, with those of the study before them and its options behind.
std::vector<std::string> whole_line(std::vector<std::string> leading, const std::vector<std::string>& words,
                                    const OptionValues& options);

/// Equal runs are equal processes, wherever the command is given: names of files are whole.
doe::Process process_of_run(const Run& run, const Folder& given, const OptionValues& options,
                            const Settings& settings);

}  // namespace drawpoint::studies
