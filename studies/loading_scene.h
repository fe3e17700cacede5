// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A loading cycle to play: the machine and the rock of a log, with speed, torque and load in time with them.

#include <drawpoint/engine/loading/log/loading_log.hpp>

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies {

/// A panel of the report (study.hpp). `who` begins the caption: which cycle of which run. The poster shows the
/// bucket as it breaks out; yield_torque [N m] is a line in the plot of the torque.
nlohmann::json scene_panel(const engine::loading::LoadingLog& log, const engine::loading::CycleRecord& cycle,
                           const std::string& who, const std::string& title, double yield_torque);

}  // namespace drawpoint::studies
