// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/tests/support/pile_world.hpp>
#include <functional>
#include <vector>

#include "command.hpp"

/// Steps of the pile, timed: wall clock of World::step() and the parts that it reports, in milliseconds.
namespace drawpoint::benchmarks {

struct PhaseTimes {
  std::vector<double> wall;                                         ///< of each step [ms]
  double broad = 0, narrow = 0, solver = 0, machine = 0, rest = 0;  ///< sums over the steps [ms]
  int points = 0, manifolds = 0;                                    ///< of the last step
  long computed = 0, refused = 0;  ///< pairs computed anew, and of these answers of FCL that were wrong; sums
  double complementarity = 0, cone = 0;  ///< largest residual of a step, relative to the normal load

  double median() const;         ///< [ms], 0 without steps
  double mean() const;           ///< [ms], 0 without steps
  nlohmann::json parts() const;  ///< means over the steps [ms]
};

/// Makes a step and adds its times. Returns its report. Throws std::runtime_error when the engine refuses it.
engine::StepReport add_step(PhaseTimes& times, engine::World& world);

/// Called after a step with its report.
using AfterStep = std::function<void(const engine::StepReport&)>;

/// Makes `steps` steps. Throws std::runtime_error when a rock's position or velocity is no longer finite or a
/// rock has left the box by more than a metre.
PhaseTimes run_phase(support::PileWorld& world, const std::string& name, int steps, Progress& progress,
                     const AfterStep& after = {});

/// The number of steps that make up a time.
int steps_in(double seconds, double step);

}  // namespace drawpoint::benchmarks
