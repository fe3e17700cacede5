// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/machine/machine.hpp>
#include <drawpoint/tests/support/scenes.hpp>

using namespace drawpoint;
using Eigen::Vector3d;

namespace {

constexpr double mass = 2, g = 9.81, seconds = 0.9;
constexpr int substeps = 16;

struct Moved {
  double way, speed;
};

// A sledge on a slider that a motor drives at its largest force from rest.
Moved driven(const Vector3d& axis, double force, double h) {
  engine::machine::MachineSpec spec;
  spec.bodies = {{.name = "sledge",
                  .joint = engine::machine::JointKind::slider,
                  .joint_axis = axis,
                  .mass = mass,
                  .inertia = Eigen::Matrix3d::Identity()}};
  spec.motors = {{.name = "drive", .bodies = {0}, .max_force = force}};
  engine::machine::Machine machine(spec);
  engine::WorldOptions options;
  options.step = h;
  engine::World world(options, support::one_material({.friction = 0}));
  world.attach(&machine);
  machine.set_motor(0, 1e3);
  for (int k = 0; k < std::lround(seconds / h); ++k) world.step();
  return {machine.coordinate(0), machine.speed(0)};
}

}  // namespace

// s = a t²/2. The force of a step acts at the beginning of each substep, by which the sledge gets h/(2 · 16) of its
// change of speed too far; once the force is known from the step before, as against weight, that is taken off again.
// So the first step alone errs, by a h²/32, and the rest is round-off of 900 additions to 2 m: 4e-13.
TEST(DrivenMachine, LiftsAsItsForceDoes) {
  for (const double h : {0.001, 0.01, 0.03}) {
    const double force = 30, a = force / mass - g;
    const Moved moved = driven(Vector3d::UnitZ(), force, h);
    EXPECT_NEAR(moved.speed, a * seconds, 1e-12);
    EXPECT_NEAR(moved.way, 0.5 * a * seconds * seconds, a * h * h / (2 * substeps) + 1e-12) << h;
  }
}

// Nothing tells whether a force without weight against it lasts: every step errs so, by h v/32 in all.
TEST(DrivenMachine, PushesAsItsForceDoesButForSubsteps) {
  for (const double h : {0.001, 0.01, 0.03}) {
    const double force = 4, a = force / mass, v = a * seconds;
    const Moved moved = driven(Vector3d::UnitX(), force, h);
    EXPECT_NEAR(moved.speed, v, 1e-12);
    EXPECT_NEAR(moved.way, 0.5 * v * seconds, h * v / (2 * substeps) + 1e-12) << h;
  }
}
