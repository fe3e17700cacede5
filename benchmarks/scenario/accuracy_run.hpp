// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pile_run.hpp"

/// One settled pile, gone on with by one choice of step and solver: how true it stays and what the blade
/// feels.
///
/// The pile is given as positions (at rest, nothing remembered), gets 0.5 s to take up the loads, is
/// held for 1 s, over which drift is measured, and is dug for 1 s. The drag is the contact force on the blade
/// against its motion, in windows of 10 ms so that steps of any length compare, over the last 0.6 s.
namespace drawpoint::benchmarks {

struct SettledState {
  support::RockPile pile;
  std::vector<support::RockState> states;
};

/// Settles the pile, whose rocks are at their start poses, for RockPile::settle_time.
SettledState settled(support::RockPile pile, const engine::WorldOptions& options, Progress& progress);

struct AccuracySample {
  double ms_rest = 0, ms_dig = 0;            ///< wall time per step, median and mean
  double overlap_mean = 0, overlap_p99 = 0;  ///< at rest
  double dig_overlap_p99 = 0;                ///< at the end of digging
  double drift = 0;                          ///< mean over rocks [m/s]
  double drag = 0;                           ///< mean [N]
  double drag_p95 = 0;                       ///< [N]
  double mass_moved = 0;                     ///< Σ m Δx / travel of the blade, over the whole dig [kg]
};

/// Goes on from the settled pile. `offset` [m] displaces every other rock upwards: a run and its replicate
/// with an offset of a micrometre differ by what chaos alone does.
AccuracySample accuracy_sample(const SettledState& settled, const engine::WorldOptions& options,
                               double offset, Progress& progress);

}  // namespace drawpoint::benchmarks
