// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Simulates a scene and writes one of its steps as a contact problem file, before it is solved.
///
/// `settled_pile`: 600 rocks of the blasted ore's sizes in a box of 4 m x 4 m, poured and left to rest.
/// `bucket_at_breakout`: a loading cycle in the default drift with 45 t of ore, in the step of its first two
/// stages (drive in, lift) that loads the bucket's hinge most. `bucket_full`: the same cycle when the curl
/// ends. Both also with `_rolling_0` and `_rolling_0.1`: the default scene of 120 t, about 1750 rocks and 8000
/// points, with that rolling resistance; and with `_at_lindmark2016_scale` before it: 290 t, about 4200 rocks.
/// Friction between rocks is 0.9, no spinning resistance; else the calibrated materials. The steps are those of
/// the engine's defaults; the start impulses are what the step before left. Minutes; at the larger scale some ten.
namespace drawpoint::benchmarks {

/// In the order of the help text; empty if this build cannot simulate them.
std::vector<std::string> scene_names();

/// Throws std::invalid_argument for an unknown scene, and std::runtime_error if the scene does not come about
/// or this build holds too little of the engine to simulate it.
void record_scene(const std::string& scene, const std::filesystem::path& file);

}  // namespace drawpoint::benchmarks
