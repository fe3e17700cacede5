// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/tests/support/scenes.hpp>

/// Contact problems, not yet solved, for tests of what solves and evaluates them.
namespace drawpoint::support {

/// A step of a little heap of boxes, before it is solved: 4 x 3 boxes fallen on each other askew, in motion.
inline engine::ContactProblem heap_of_boxes() {
  engine::WorldOptions options;
  options.step = 0.005;
  options.solver = {
      .method = engine::Method::sequential, .substeps = 1, .iterations = 25, .iteration_budget = 0};
  engine::World world(options, one_material({0.6, 0.2, 1e8, 0, 0.05}));
  add_floor(world);
  for (int k = 0; k < 12; ++k) {
    Eigen::Isometry3d pose = at(0.35 * (k % 4), 0.02 * (k / 4), 0.17 + 0.34 * (k / 4));
    pose.linear() = Eigen::AngleAxisd(0.1 * k, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    world.add_rock(box_body({0.15, 0.12, 0.16}), pose);
  }
  engine::ContactProblem kept;
  world.before_solve([&](const engine::ContactProblem& problem) { kept = problem; });
  for (int step = 0; step < 160; ++step) world.step();
  return kept;
}

}  // namespace drawpoint::support
