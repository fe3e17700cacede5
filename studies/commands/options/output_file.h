// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/studies/run/store/folder.h>

#include <filesystem>
#include <string>

namespace drawpoint::studies {

/// The file or folder that a command is told to write with an option, empty as it is; where it is a link, the
/// file that it leads to: what is written whole replaces that, not the link. Throws UsageError where a study
/// keeps its own, the store, run logs, what runs share, and for what is neither file nor folder.
std::filesystem::path output_file(const Folder& folder, const std::filesystem::path& file,
                                  const std::string& option = "--file");

}  // namespace drawpoint::studies
