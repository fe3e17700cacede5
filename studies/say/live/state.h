// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the live page shows, as one JSON object per question. It is bounded whatever the number of runs, but for the
/// improvements, one per run that was better than all before it: the page keeps the rows that it has, and asks for
/// those that came since.
///
///     study, about, folder, program, now (UTC), standing {kind, text, next}; then, where there is a study,
///     problem, total, counts {kind: {state: n}}, progress (text), runs_per_hour, seconds_left and left
///     (the same as text; null: unknown), seconds and time (in runs),
///     responses [{lowest, highest, done, within, improvements [[ended, run, value]],
///                 best {run, kind, x, y}, best_error (as that run says of itself, or null)}],
///     failures [{reason, times, run}], more_failures, running [{run, kind, x, started}],
///     last {run, kind, x, y or null, reason, seconds, finished}, logged (run whose figures there are, or
///     null), epoch (text), from, rows [[run, kind, x, y or null]], ended

#include <drawpoint/studies/say/live/follower.h>

#include <cstddef>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

/// Rows that the page has: the first `since` of the epoch.
struct Kept {
  std::string epoch;
  std::size_t since = 0;
};

/// In one answer, at most.
inline constexpr std::size_t most_rows = 1000, most_failures = 20, most_running = 64, longest_reason = 600;

/// The study that is followed.
struct Followed {
  const Study& study;
  Folder folder;
  std::string program;  ///< what is typed before a command
};

nlohmann::ordered_json state_of(const Followed& followed, const View& view, const Kept& kept,
                                std::time_t now);

}  // namespace drawpoint::studies
