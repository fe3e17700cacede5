// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/machine/machine.hpp>
#include <drawpoint/tests/support/blocks.hpp>
#include <drawpoint/tests/support/scenes.hpp>

// A tower stands while a sledge of 1 t is driven past it. They share no contact, so nothing of what the sledge does may
// keep the solver from seeing that the tower stands: a step costs one iteration over its contacts, the sledge has its
// own.
using namespace drawpoint;
using engine::machine::JointKind;

namespace {

constexpr double speed = 1;  // of the sledge [m/s]
const Eigen::Vector3d half(0.5, 0.3, 0.2);

// Lies on the floor by its weight and slides along x, 3 m beside the origin.
engine::machine::MachineSpec sledge() {
  const auto body = [](const char* name, int parent, const Eigen::Vector3d& axis) {
    engine::machine::BodySpec b;
    b.name = name, b.parent = parent, b.joint = JointKind::slider, b.joint_axis = axis;
    b.mass = 500, b.centre = {0, 3, half.z()}, b.inertia = 100 * Eigen::Matrix3d::Identity();
    return b;
  };
  engine::machine::MachineSpec spec;
  spec.bodies = {body("carriage", -1, Eigen::Vector3d::UnitX()), body("sledge", 0, Eigen::Vector3d::UnitZ())};
  spec.motors = {{"drive", {0}, 20e3}};
  return spec;
}

}  // namespace

TEST(StandsBesideAMachine, CostsOneIteration) {
  engine::World world({}, support::one_material({.friction = 0.8, .stiffness = 1e8}));
  support::add_floor(world);
  for (int k = 0; k < 5; ++k)
    world.add_rock(support::box_body(Eigen::Vector3d::Constant(0.15)), support::at(0, 0, 0.3 * (k + 0.5)));
  engine::machine::Machine machine(sledge());
  world.attach(&machine);
  world.add_part_shape(1, std::make_shared<const engine::Shape>(engine::box(half)),
                       Eigen::Isometry3d::Identity(), 0);
  while (world.time() < 2) world.step();
  machine.set_motor(0, speed);
  while (world.time() < 2.5) world.step();  // (20 kN - 0.8 g 500 kg) / 1 t: 0.06 s to full speed
  const double start = machine.coordinate(0);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(world.step().iterations, 1) << "at " << world.time() << " s";
  EXPECT_NEAR(machine.coordinate(0) - start, speed, 1e-3 * speed);
}
