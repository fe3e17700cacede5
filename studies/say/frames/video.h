// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Frames as a film, by ffmpeg.

#include <filesystem>

namespace drawpoint::studies {

struct Video {
  std::filesystem::path file;  ///< .mp4 (H.264) or .webm (VP9), whose frames have even width and height
  double fps = 20.0;           ///< frames per second
};

/// Throws std::runtime_error where no file can be made in its folder: asked before anything is drawn.
void check_film_can_be_written(const std::filesystem::path& file);

/// From all frames of the folder (frame_files.h). The file appears whole or not at all. Requires an
/// InterruptGuard. Throws Interrupted after a signal, std::runtime_error with what ffmpeg printed last.
void film(const Video& video, const std::filesystem::path& folder, const std::filesystem::path& ffmpeg);

}  // namespace drawpoint::studies
