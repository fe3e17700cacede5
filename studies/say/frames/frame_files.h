// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Frames as files: frame_000001.png, frame_000002.png, ... in one folder.

#include <cstddef>
#include <filesystem>
#include <string>

namespace drawpoint::studies {

/// As many as six digits name.
inline constexpr double most_frames = 999'999;
/// As printf, and so ffmpeg, writes the names.
inline constexpr const char* frame_pattern = "frame_%06d.png";

/// number: from 1.
std::string frame_name(std::size_t number);

/// Makes the folder where it is not there. Throws UsageError where it holds frames, because a film would mix
/// them with the new ones, or is no folder; std::runtime_error where it cannot be made.
void prepare_frame_folder(const std::filesystem::path& folder);

}  // namespace drawpoint::studies
