// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The options of `replay` that make pictures or a film in place of the page.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/say/frames/png.h>
#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace drawpoint::studies {

void add_frame_options(CLI::App& command, FrameSettings& settings);

/// Throws UsageError where there are options for frames that are not wanted.
bool wants_frames(const FrameSettings& settings);

/// The size that "1280x720" names; empty where the text is no size, or a side is not 16 to 4096 pixels.
std::optional<FrameSize> frame_size_from(const std::string& text);

}  // namespace drawpoint::studies
