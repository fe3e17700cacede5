// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What a step sets moving does not pass what it was not yet near when the step began: contacts are looked
// for as far as the velocities before the step carry, and again where the solved motion is another one.
#include <gtest/gtest.h>

#include <drawpoint/engine/machine/machine.hpp>
#include <drawpoint/tests/support/machines.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <random>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::Method;
using engine::World;

namespace {

constexpr double stiffness = 1e9, speed = 40, half = 0.1,
                 thin = 0.01;  // [N/m], [m/s], [m]: cubes and a plate

// A plate across x at x = 0, far larger than what flies at it.
World with_plate(Method method) {
  engine::WorldOptions options;
  options.gravity = Vector3d::Zero();
  options.solver.method = method;
  World world(options, support::one_material({.friction = 0.3, .stiffness = stiffness}));
  world.add_static(support::shared(engine::box({thin, 2, 2})), Eigen::Isometry3d::Identity(), 0);
  return world;
}

int add_cube(World& world, double x, double density, double v) {
  return world.add_rock(support::box_body(Vector3d::Constant(half), density), support::at(x, 0, 0),
                        {v, 0, 0});
}

double x_of(const World& world, int rock) { return world.rock(rock).pose.translation().x(); }

}  // namespace

class Reach : public testing::TestWithParam<Method> {};

// A heavy cube (m = 400 kg) strikes a light one (20 kg) that rests before the plate. It covers 0.4 m in a
// step: twice the light one's width and what is left beyond it. A spring of k stops it within v √(m/k) =
// 0.025 m, and the light cube is pressed in from both sides by no more than that: its centre, `half` from its
// faces, stays on its side, and so does the heavy one's, behind it.
TEST_P(Reach, AStruckRockDoesNotPassAPlate) {
  for (const double gap : {0.0, 0.005, 0.03, 0.15}) {
    World world = with_plate(GetParam());
    const double rest = -thin - gap - half;
    const int light = add_cube(world, rest, 2500, 0),
              heavy = add_cube(world, rest - 2 * half - 0.02, 50e3, speed);
    for (int k = 0; k < 20; ++k) {
      world.step();
      ASSERT_LT(x_of(world, light), -thin) << "gap " << gap << ", step " << k;
      ASSERT_LT(x_of(world, heavy), x_of(world, light) - half) << "gap " << gap << ", step " << k;
    }
  }
}

// Two equal cubes fly one behind the other, so that they do not near each other before the first is stopped
// by the plate.
TEST_P(Reach, AFollowerDoesNotPassTheOneThatIsStopped) {
  for (const double gap : {0.005, 0.05}) {
    World world = with_plate(GetParam());
    const double first = -thin - half - 0.1;
    const int front = add_cube(world, first, 2500, speed),
              back = add_cube(world, first - 2 * half - gap, 2500, speed);
    for (int k = 0; k < 20; ++k) {
      world.step();
      ASSERT_LT(x_of(world, front), -thin) << "gap " << gap << ", step " << k;
      ASSERT_LT(x_of(world, back), x_of(world, front) - half) << "gap " << gap << ", step " << k;
    }
  }
}

// A blade that stands when the step begins is driven to V within it by its motor, whose force knows no bound, or meets
// the cube while it slides on: what lay ahead of it is pushed, at any thickness, gap and speed, whichever way it goes.
// The cube goes with the blade or faster, so its centre stays before the blade's middle.
TEST_P(Reach, ABladeThatStartsAtOnceDoesNotPassARock) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const double thickness = 0.01 + 0.1 * unit(rng), gap = 0.2 * unit(rng), V = 1 + 30 * unit(rng);
    const double way = trial % 2 ? 1 : -1;
    engine::machine::Machine machine({{support::slider("blade", 1000, 100)}, {}, {{"drive", {0}, 1e9}}, {}});
    engine::WorldOptions options;
    options.gravity = Vector3d::Zero();
    options.solver.method = GetParam();
    World world(options, support::one_material({.friction = 0.3, .stiffness = stiffness}));
    world.attach(&machine);
    world.add_part_shape(0, support::shared(engine::box({thickness / 2, 1, 1})),
                         Eigen::Isometry3d::Identity(), 0);
    const int cube = add_cube(world, way * (thickness / 2 + gap + half), 2500, 0);
    for (int k = 0; k < 3; ++k) world.step();
    machine.set_motor(0, way * V);
    for (int k = 0; k < 40; ++k) {
      world.step();
      ASSERT_GT(way * x_of(world, cube), way * machine.coordinate(0)) << "trial " << trial << ", step " << k;
    }
    EXPECT_GT(way * world.rock(cube).velocity.x(), 0.99 * V) << "trial " << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Reach, testing::Values(Method::sequential, Method::batched),
                         [](const auto& info) { return std::string(to_string(info.param)); });
