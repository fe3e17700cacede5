// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/world.hpp>

/// The settings with which laws are validated: the reference method in double precision, one substep of 25
/// iterations or more, started from all of the last step's impulses, so that the solver's answers to the same problem
/// converge from step to step and errors come from the law and the time step alone. The engine's defaults,
/// which trade some of that for speed, have lines of their own.
namespace drawpoint::validation {

inline engine::WorldOptions reference_settings(double step = 0.005) {
  engine::WorldOptions options;
  options.step = step;
  options.solver.method = engine::Method::sequential;
  options.solver.substeps = 1;
  options.solver.iterations = 25;
  options.warm_start = 1;
  return options;
}

}  // namespace drawpoint::validation
