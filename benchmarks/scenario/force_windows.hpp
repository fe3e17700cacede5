// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <vector>

/// The force on the bucket by several choices of step and solver, from the same states.
///
/// A cycle is driven by the scenario's own choice. While its bucket digs, each of the others goes on from the state
/// that the cycle is in, for a short window with the speeds that are set then, and is undone. Whole cycles differ by
/// what chaos makes of a micrometre; windows end before it does, so a few cycles tell the force to some percent. What
/// builds up over longer than a window, such as how loose the pile gets, they do not see.
namespace drawpoint::benchmarks {

struct WindowOptions {
  double interval = 0.2;        ///< between windows [s]
  double length = 0.3;          ///< of a window [s]
  double force_of_dig = 100e3;  ///< in the step before, on the bucket: below, it does not dig [N]
};

struct WindowChoice {
  double step = 0;  ///< [s]
  engine::SolverOptions solver;
  double nudge = 0;  ///< onto the velocity of every other rock, upwards [m/s]
};

struct WindowMeans {
  double force = 0;    ///< of contacts on the bucket: magnitude, in means over 10 ms [N]
  double ms_step = 0;  ///< wall time
};

/// By choice, then by window. Throws std::runtime_error when the cycle does not come to its end.
std::vector<std::vector<WindowMeans>> force_windows(engine::loading::Scenario scenario,
                                                    const engine::loading::SettledPile& pile,
                                                    const std::vector<WindowChoice>& choices,
                                                    const WindowOptions& options = {});

}  // namespace drawpoint::benchmarks
