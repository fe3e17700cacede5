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

/// Six boxes on a floor, in motion, and a sled with a motor and a stop that pushes the last of them.
struct PushedStack {
  engine::ContactProblem problem;
  engine::SuperBody sled;
  PushedStack(const PushedStack&) = delete;  // the problem points to the sled
  PushedStack& operator=(const PushedStack&) = delete;

  PushedStack() {
    engine::World world({}, one_material({0.6, 0.2, 1e8, 0, 0.05}));
    add_floor(world);
    for (int k = 0; k < 6; ++k)
      world.add_rock(box_body({0.15, 0.12, 0.16}), at(0.05 * k, 0, 0.17 + 0.34 * k));
    world.before_solve([&](const engine::ContactProblem& p) { problem = p; });
    for (int step = 0; step < 20; ++step) world.step();
    add_sled();
  }

  void add_sled() {
    sled.velocity_before = Eigen::Vector2d(200, 10);
    sled.velocity = Eigen::Vector2d(201, 9);
    engine::SpatialMap map(6, 2);
    map << 0, 0, 0, 1e-3, 0, 0, 4e-3, 0, 0, 0, 0, 2e-3;
    sled.part_maps = {map, 2 * map};
    sled.origins = {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 0, 1)};
    engine::SuperBodyRow motor;
    motor.jacobian = Eigen::Vector2d(4e-3, 0);
    motor.target = 1;
    motor.lower = -300;
    motor.upper = 500;
    engine::SuperBodyRow stop = motor;
    stop.kind = engine::SuperBodyRow::Kind::stop;
    stop.gap = -1e-3;
    stop.recovery = 0.1;
    stop.lower = 0;
    stop.start = 1.5;
    sled.rows = {motor, stop};
    problem.machine = &sled;
    engine::ContactPair pair;
    pair.a = engine::machine_part(1);
    pair.b = static_cast<int>(problem.bodies.size()) - 1;
    pair.first = static_cast<int>(problem.points.size());
    pair.count = 1;
    problem.pairs.push_back(pair);
    engine::ContactPoint point = problem.points.back();
    point.feature = 0xfedcba98u;
    point.normal = Eigen::Vector3d::UnitX();
    problem.points.push_back(point);
  }
};

}  // namespace drawpoint::support
