// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A run's scene as pictures and as a film.

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/say/run_replay.h>
#include <drawpoint/studies/study.hpp>

namespace drawpoint::studies {

/// Draws the scene of a run as frames or a film, of the first cycle where none is named. Prints the folder and the
/// file that it made. Returns 0, or 130 after a signal. Throws UsageError for times that the scene does not have and
/// for a folder with frames, std::runtime_error for what is missing or fails.
int render_frames(const Study& study, const Identity& identity, const Folder& folder, const Replayed& shown,
                  const FrameSettings& settings);

}  // namespace drawpoint::studies
