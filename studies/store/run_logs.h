// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The logs of runs: each is remembered by its checksum when its run ends, and used only while it fits.

#include <drawpoint/studies/store/folder.h>
#include <drawpoint/studies/store/store.h>

#include <filesystem>
#include <string>

namespace drawpoint::studies {

/// Of a file's bytes, as Run::log has it. Throws std::runtime_error if it cannot be read.
std::string file_checksum(const std::filesystem::path& file);

enum class LogState {
  none,   ///< the run wrote none, or it is gone
  sound,  ///< as the run wrote it
  other   ///< damaged, not readable, or another run's
};

LogState log_state(const Folder& folder, const Run& run);

}  // namespace drawpoint::studies
