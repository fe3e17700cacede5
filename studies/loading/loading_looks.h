// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the bodies of a loading scene are made of, and the drift around them, for a page to draw (study.hpp).

#include <drawpoint/engine/loading/log/loading_log.hpp>

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

/// "look" of a body: rock, tyre, steel, paint, glass, lamp, or drift for floor, walls and roof.
std::string look_of(const engine::loading::SceneBody& body);

/// "drift" of a scene by its floor and roof [m]; null where a log has not both.
nlohmann::json drift_of(const engine::loading::SceneRecord& scene);

}  // namespace drawpoint::studies
