// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks the panels of a report; where a scene's bodies are is packed (scene_tracks.h).

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drawpoint::studies::detail {

/// The panels that can be drawn; a sentence for each that cannot goes to cautions.
nlohmann::json checked_panels(const nlohmann::json& panels, std::vector<std::string>& cautions);

/// Checked panels without those "in_scene", whose curves a scene shows too, where there is a scene.
nlohmann::json without_repeated(nlohmann::json panels);

}  // namespace drawpoint::studies::detail
