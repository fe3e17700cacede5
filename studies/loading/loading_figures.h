// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the loading study adds to a study: the settled pile that all runs share, and the figures of one run.
///
/// Figures of a cycle: planned and actual tip path over the pile's contour, the pile from above, the scene to play and
/// turn, drive forces and the torque that twists hinge G over time, the rock in the bucket; and a table of the cycles.
/// Read from the run log alone.

#include <drawpoint/engine/loading/scenario.hpp>
#include <drawpoint/studies/options.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace drawpoint::studies {

/// Heaps up the scenario's pile into its pile file, on up to eight threads, and tells on standard error (of a
/// study: logs/prepare.txt) how far it is and how the pile lies. About a minute.
void settle_pile(engine::loading::Scenario scenario);

/// Panels for the report from a run log, of its first cycle; the yield torque that they show is that of the
/// options. Throws std::runtime_error if the log cannot be read.
nlohmann::json loading_figures(const std::filesystem::path& log, const OptionValues& options = {});

/// Gives those of every cycle, each with its number as "cycle" (Presentation::replay). Throws likewise.
nlohmann::json loading_replay(const std::filesystem::path& log, const OptionValues& options = {});

}  // namespace drawpoint::studies
