// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Changes of an HDF5 file, four bytes each: which object, in order of the names; what is done to it; to which
/// element, attribute or size; and with which number of a few that are hard. So what is read is always sound
/// HDF5 with wrong contents: the library's own reader, which a checksum guards, is not what is tried.

#include <drawpoint/tests/fuzz/readers.hpp>

#include <filesystem>

namespace drawpoint::fuzz {

/// A copy of `sound` with these changes, and its trailer anew where `checked`.
void write_edited(const std::filesystem::path& sound, const std::filesystem::path& file, Bytes changes,
                  bool checked);

}  // namespace drawpoint::fuzz
