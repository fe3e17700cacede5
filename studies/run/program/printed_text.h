// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run has printed, for the reason of its failure.

#include <filesystem>
#include <string>

namespace drawpoint::studies {

/// "; it printed last \"no mesh\" (logs/run_0001.txt)", with the last line that is not empty; "" where the file
/// is none, or empty.
std::string printed_last(const std::filesystem::path& printed);

/// A reason without the name of the file, which differs from run to run: equal failures have equal ones.
std::string without_log_name(const std::string& reason);

/// How a line begins that tells of an attempt and is not the program's.
inline constexpr const char* attempt_begins = "drawpoint: attempt ";

/// How printed_last begins, behind a reason.
inline constexpr const char* printed_last_begins = "; it printed last ";

}  // namespace drawpoint::studies
