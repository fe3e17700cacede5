// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Programs of others that draw and film, found when they are needed: a browser of the Chromium family, and
/// ffmpeg.

#include <filesystem>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// The file that the shell would start by this name or path; empty: there is none.
std::filesystem::path program_named(const std::string& name);

/// The one that DRAWPOINT_BROWSER names, or the first on the PATH. Throws std::runtime_error that says what
/// to install.
std::filesystem::path found_browser();

/// Throws std::runtime_error that says what to install.
std::filesystem::path found_ffmpeg();

/// The end of what a program has printed to this file but for complaints of a missing message bus, or that
/// there is nothing.
std::string last_words(const std::filesystem::path& printed);

}  // namespace drawpoint::studies
