// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What Study::prepare wrote, remembered by its checksums in DIR/shared.checksums: a settled pile that is
/// damaged would fail every run, or, worse, change them.

#include <drawpoint/studies/run/store/folder.h>

#include <filesystem>

namespace drawpoint::studies {

/// Remembers every file below `written`, which is about to become folder.shared().
void remember_shared(const Folder& folder, const std::filesystem::path& written);

/// Throws std::runtime_error that names the first file that is gone or changed and says what to do. A folder
/// that came without checksums is taken as it is.
void check_shared(const Folder& folder);

}  // namespace drawpoint::studies
