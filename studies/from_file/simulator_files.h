// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The files that make a program beside those that its command names, such as modules that it imports: a change
/// of one is a change of the simulator.

#include <filesystem>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct SimulatorFiles {
  std::vector<std::filesystem::path> names = {};  ///< in order
  std::string checksum = {};                      ///< of names, relative to the folder, and contents
  std::string note = {};                          ///< why there are none, where they are too many
};

/// What the patterns of the shell name, relative to the folder; a folder stands for all files in it. Throws
/// std::runtime_error for a pattern that names nothing, and for a file that cannot be read.
SimulatorFiles files_named(const std::vector<std::string>& patterns, const std::filesystem::path& folder);

/// The files below the folders of these programs whose names end as theirs do (.py beside a .py), but for what
/// is hidden; none where they are more than 200 or 4 MB, which `note` says.
SimulatorFiles files_like(const std::vector<std::filesystem::path>& programs,
                          const std::filesystem::path& folder);

}  // namespace drawpoint::studies
