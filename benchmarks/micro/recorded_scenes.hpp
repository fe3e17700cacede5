// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

/// Simulates a scene and writes one of its steps as a contact problem file, before it is solved.
///
/// `settled_pile`: 600 rocks of the blasted ore's sizes in a box of 4 m x 4 m, poured and left to rest.
/// `bucket_at_breakout`: a loading cycle in the default drift with 45 t of ore, in the step of its first two
/// stages (drive in, lift) that loads the bucket's hinge most. `bucket_full`: the same cycle when the curl
/// ends. The steps are those of the engine's defaults; the start impulses are what the step before left.
namespace drawpoint::benchmarks {

/// Throws std::invalid_argument for an unknown scene, and std::runtime_error if the scene does not come about
/// or this build holds too little of the engine to simulate it.
void record_scene(const std::string& scene, const std::filesystem::path& file);

}  // namespace drawpoint::benchmarks
