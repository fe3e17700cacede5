// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The logs of runs: each is remembered by its checksum when its run ends, and used only while it fits.

#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace drawpoint::studies {

/// The most bytes that the log of a run may have: 4 GiB.
inline constexpr std::uintmax_t largest_log = std::uintmax_t{4} << 30;

/// Checksum of a file's bytes, as in Run::log. Throws std::runtime_error if it cannot be read or is no regular file,
/// such as a pipe, which it does not wait for.
std::string file_checksum(const std::filesystem::path& file);

enum class LogState {
  none,   ///< the run wrote none, or it is gone
  sound,  ///< as the run wrote it
  other   ///< damaged, not readable, or another run's
};

LogState log_state(const Folder& folder, const Run& run);

}  // namespace drawpoint::studies
