// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The files of a run, before it begins and after it has ended. What a run leaves where they should be may be
/// anything: it fails that run and nothing else.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>

#include <cstdint>
#include <string>

namespace drawpoint::studies {

/// Clears away what no run may find: anything but a file where its output goes, and anything but a folder
/// where logs do.
void make_way(const Folder& folder, std::int64_t id);

/// The log gets its final name before the run counts as done, so that each run that is done has its log, and
/// keeps the other one until then: who dies between leaves it for the next to publish. On disk when the call
/// returns. Returns its checksum; empty: there is none. Throws std::runtime_error that says what lies there in
/// its place.
std::string publish_log(const Folder& folder, const Settings& settings, std::int64_t id);

void drop_unfinished_log(const Folder& folder, std::int64_t id);
/// The published one, too.
void drop_logs(const Folder& folder, std::int64_t id);

}  // namespace drawpoint::studies
