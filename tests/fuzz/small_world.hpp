// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/tests/support/scenes.hpp>

/// The world whose snapshots are fuzzed: five boxes that fall on a floor beside a wall, one of them removed.
/// Two iterations per substep: the reader is fuzzed, not the solver's accuracy. No cylinder: its record is
/// that of any hull, and each restore would make its prism of 48 sides anew, at a hundred times the cost of
/// all else.
namespace drawpoint::fuzz {

inline std::unique_ptr<engine::World> small_world() {
  using namespace drawpoint::support;
  engine::WorldOptions options;
  options.solver.iterations = 2;
  options.solver.iteration_budget = 0;
  auto world = std::make_unique<engine::World>(
      options, one_material({.friction = 0.5, .rolling = 0.02, .stiffness = 1e8}));
  add_floor(*world);
  world->add_static(shared(engine::box({0.1, 2, 1})), at(1, 0, 1), 0);
  for (int k = 0; k < 5; ++k)
    world->add_rock(box_body({0.2, 0.15, 0.1 + 0.02 * k}), at(0.1 * k, 0, 0.15 + 0.26 * k), {0.3 * k, 0, 0});
  return world;
}

}  // namespace drawpoint::fuzz
