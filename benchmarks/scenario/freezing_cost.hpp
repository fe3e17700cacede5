// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "command.hpp"

/// What rocks that stand still cost beside rocks that move.
///
/// Two boxes stand 20 m apart. In the far one a bed of rocks has come to rest and is frozen, all of it. Then
/// `moving` rocks are let go in the near one as in pile_scenario, fall and collapse for 1 s, and a blade is
/// dragged through them for 1 s. The bed is never touched, so the same rocks move with and without it, up to
/// chaos. A bed of no rocks is the near box alone. Processor time, one thread.
namespace drawpoint::benchmarks {

struct CostScene {
  int bed = 2700, moving = 300;
  std::uint64_t seed = 1;
  bool freeze = true;
  support::PileMaterial material = {};
};

struct FreezingCost {
  double fall_ms = 0, dig_ms = 0;  ///< mean processor time per step while rocks fall, while the blade digs
  double still_ms = 0;             ///< per step while only the frozen bed is there
  double fall_awake = 0, dig_awake = 0;  ///< mean number of rocks that were solved
  int frozen = 0;                        ///< of the bed, when the rocks are let go
  int solved_again = 0;                  ///< steps solved again in both phases
};

/// Throws std::runtime_error when the bed has not come to rest after 20 s.
FreezingCost freezing_cost(const CostScene& scene, engine::WorldOptions options);

}  // namespace drawpoint::benchmarks
