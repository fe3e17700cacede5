// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A scene as picture files, drawn by a headless browser from the code that draws the replay's page.
///
/// The browser draws in software, so that neither display nor graphics card is needed; it gets a folder of
/// its own for all that it keeps, and cannot reach a network. It ends with this process, however that ends.

#include <drawpoint/studies/say/frames/png.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drawpoint::studies {

struct Rendering {
  nlohmann::json scene;            ///< panel of a page, checked: say/page/panels.h
  std::vector<double> times = {};  ///< [s] of the scene, one per frame
  FrameSize size = {};
  std::string camera = "home";  ///< or side, above: the buttons of the page
};

struct Browser {
  std::filesystem::path program;
  std::chrono::milliseconds patience{120'000};  ///< between two frames, and until the first
};

/// Writes frame_000001.png and so on, each whole or not at all. Says on standard error how far it is.
/// Requires an InterruptGuard and a folder without frames. Throws Interrupted after a signal;
/// std::runtime_error where the browser ends, is silent for too long or cannot draw, or the disk refuses.
/// Frames that are written stay.
void render(const Rendering& rendering, const Browser& browser, const std::filesystem::path& folder);

}  // namespace drawpoint::studies
