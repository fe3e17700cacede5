// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// The last 24 bytes of a file, after the end that HDF5 knows: a mark, the length before it, and the 64-bit
/// FNV-1a checksum of that. With it a reader sees truncation and damage before the library does, which on
/// damaged files leaks, or worse. Private to engine/record.
namespace drawpoint::engine::record::detail {

void append_trailer(std::vector<std::byte>& image);

/// What is wrong with a file's trailer, in words that follow its name; empty: nothing. Reads the whole file
/// in pieces.
std::string trailer_fault(const std::filesystem::path& path);

}  // namespace drawpoint::engine::record::detail
