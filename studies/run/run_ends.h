// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How the process of a run ended, for the one that started it.

#include <drawpoint/studies/run/program/program_trouble.h>
#include <drawpoint/doe/outcome.hpp>
#include <drawpoint/doe/processes.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace drawpoint::studies {

struct RunEnd {
  doe::Outcome outcome;
  bool not_started = false;  ///< no run can be made: the outcome is the system's reason
};

/// What a child says through its reply channel. `trouble`: why its program gave no outcome.
std::string reply_text(const doe::Outcome& outcome, std::optional<ProgramTrouble::Kind> trouble = {});

/// The end of a run, from that of its child process. For a crash the reason names `printed` and its last line. It
/// does not throw, whatever the reply is.
RunEnd run_end(const doe::ProcessEnd& end, const std::filesystem::path& printed);
doe::Outcome outcome_of(const doe::ProcessEnd& end, const std::filesystem::path& printed);

}  // namespace drawpoint::studies
