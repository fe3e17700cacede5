// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// A saved state (engine::World::save()) in a file, written whole or not at all and verified when read.
///
/// Layout, little-endian: 8 bytes of mark ("DPSNAP\r\n"), version (u32, 1), zero (u32), length of the state
/// (u64), the state, and the 64-bit FNV-1a checksum of all before. A plain file and not HDF5: the state is
/// one block that only this program reads, and a parser of a few lines can be fuzzed to the end
/// (tests/fuzz/snapshot_reader.cpp). A cut or flipped byte anywhere is seen before the state is looked at.
///
/// Disk and damage are std::runtime_error with file, fault and next step. Cost: about a second per gigabyte.
namespace drawpoint::engine::record {

void write_snapshot(const std::filesystem::path& path, std::span<const std::byte> state);
std::vector<std::byte> read_snapshot(const std::filesystem::path& path);

namespace detail {

/// The file's bytes around a state.
std::vector<std::byte> wrapped_snapshot(std::span<const std::byte> state);

/// The state in a file's bytes; `name` is the file's in messages.
std::span<const std::byte> unwrapped_snapshot(std::span<const std::byte> file, const std::string& name);

}  // namespace detail
}  // namespace drawpoint::engine::record
