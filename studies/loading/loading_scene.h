// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A loading cycle to play: the machine and the rock of a log, with speed, torque and load in time with them.

#include <drawpoint/engine/loading/log/responses.hpp>

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

/// A panel of the report (study.hpp). `who` begins the caption: which cycle of which run. The poster shows the
/// bucket as it breaks out; the plot of the torque has the part that `damage` counts, and the yield torque.
nlohmann::json scene_panel(const engine::loading::LoadingLog& log, const engine::loading::CycleRecord& cycle,
                           const std::string& who, const std::string& title,
                           const engine::loading::DamageOptions& damage);

}  // namespace drawpoint::studies
