// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

/// A file that is either the old one or the whole new one, whatever happens (POSIX).
namespace drawpoint::engine {

/// Writes beside the target, syncs, renames over the target and syncs the folder. Throws std::runtime_error
/// with the system's reason; the target is then as it was and nothing is left beside it. So it is with what
/// `check` throws, which sees the path of the written file before that becomes the target.
void write_atomically(const std::filesystem::path& target, std::span<const std::byte> bytes,
                      const std::function<void(const std::filesystem::path&)>& check = {});

}  // namespace drawpoint::engine
