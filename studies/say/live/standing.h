// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a study that is looked at stands, and what to do next.

#include <drawpoint/studies/run/counts.h>
#include <drawpoint/studies/run/progress.h>
#include <drawpoint/studies/say/live/follower.h>

#include <ctime>
#include <string>

namespace drawpoint::studies {

enum class StandingKind {
  absent,      ///< no study there yet
  unreadable,  ///< not now; what was read last stays
  working,     ///< a command works in the folder
  stopped,     ///< none does, and runs are missing
  ended        ///< none does, and none are missing
};
std::string to_string(StandingKind kind);

struct Standing {
  StandingKind kind = StandingKind::absent;
  std::string text;  ///< sentences
  std::string next;  ///< the command to give next, without the program; empty: none
};

Standing standing_of(const Study& study, const Folder& folder, const View& view);

/// Progress of the command that works there since its first run began, as `run` shows it; without one, counts
/// alone. Runs made elsewhere are no progress.
ProgressState progress_of(const View& view, std::time_t now);

}  // namespace drawpoint::studies
