// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>

/// One loading cycle from a given pile: what the bucket feels and loads.
///
/// Cycles are chaotic: a rock at the toe decides where the loader stalls. Two choices of the engine are
/// compared over many piles, pair by pair.
namespace drawpoint::benchmarks {

struct CycleSample {
  /// Mean magnitude of the force in the bucket's pin, of its means over 10 ms, so that steps of any length
  /// compare [N].
  double bucket_force = 0;
  double loaded_mass = 0;           ///< [kg]
  double contact_ms = 0;            ///< wall time of contacts, all steps together
  double ms_step = 0;               ///< the same per step
  double mean_deepest_overlap = 0;  ///< over the steps, of the deepest overlap of a rock [m]
};

/// The scenario with the pile of another seed, kept as pile_SEED.h5 in the folder and poured when missing.
engine::loading::Scenario with_pile(engine::loading::Scenario scenario, const std::filesystem::path& folder,
                                    int seed);

/// Raises each rock by up to `most` [m], by the draws of `seed`; what lies there is not pressed together.
engine::loading::SettledPile displaced(engine::loading::SettledPile pile, std::uint64_t seed, double most);

/// The scenario's first cycle from this pile, whatever it was poured with. Throws std::runtime_error with the
/// run's message when it does not come to its end.
CycleSample cycle_run(engine::loading::Scenario scenario, const engine::loading::SettledPile& pile);

}  // namespace drawpoint::benchmarks
