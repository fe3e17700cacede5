// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/scenario.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// The common initial state of all runs: a pile heaped up under the raise and left to settle, saved and read
/// back.
///
/// Rocks are let go low over the growing heap (granular::Emitter), as ore comes down a choked raise, so that
/// the pile lies at the ore's angle of repose (pile_shape.hpp).
///
/// The file carries what the pile was made from (drift, rocks, materials, step, solver) as one line of text,
/// its provenance key, which version 1 of the format calls "recipe"; reading it for anything else is refused,
/// so that a study can never start from another study's pile unnoticed.
namespace drawpoint::engine::loading {

struct SettledPile {
  std::vector<granular::PlacedRock> rocks;
  double poured_s = 0;          ///< simulated time to pour and settle [s]
  bool timed_out = false;       ///< still creeping when the rest criterion's cap was reached
  std::string provenance = {};  ///< what it was made from; empty: not by pour_pile()
};

/// What decides the pile, as text.
std::string pile_provenance(const Scenario& scenario);

/// Pours and settles. `progress` gets the poured share of the mass, 0 to 1, about once per simulated second.
/// Stops early when the pile reaches max_height or the raise is full.
SettledPile pour_pile(const Scenario& scenario, const std::function<void(double)>& progress = {},
                      const std::function<void(const engine::StepReport&)>& on_step = {});

/// Atomic. Throws std::runtime_error if the file cannot be written / read, is damaged or was made from
/// something else.
void write_pile(const std::filesystem::path& path, const SettledPile& pile, const Scenario& scenario);
SettledPile read_pile(const std::filesystem::path& path, const Scenario& scenario);

/// Reads scenario.pile_file if it exists, else pours the pile and saves it there (if a path is given).
SettledPile prepared_pile(const Scenario& scenario, const std::function<void(double)>& progress = {});

}  // namespace drawpoint::engine::loading
