// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/studies/store/folder.h>

#include <filesystem>
#include <string>

namespace drawpoint::studies {

/// Of a file or folder that a command is told to write with an option. Throws UsageError where a study keeps
/// its own: the store, run logs, what runs share; and for what is neither file nor folder.
void check_output_file(const Folder& folder, const std::filesystem::path& file,
                       const std::string& option = "--file");

/// Where a link leads: a file that is written whole replaces that file, not the link.
std::filesystem::path behind_links(const std::filesystem::path& file);

}  // namespace drawpoint::studies
