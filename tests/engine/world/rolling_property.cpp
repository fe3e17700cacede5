// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A cylinder is round: it rolls on boxes, tiles and tilted plates as it does on a half-space, and for ever where
// nothing resists.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/machine/machine.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <random>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;
using engine::machine::Machine;

namespace {

constexpr double radius = 0.5, half_width = 0.3;

engine::machine::MachineSpec wheel(double mass) {
  engine::machine::BodySpec body;
  body.name = "wheel", body.mass = mass;
  const double side = mass * (3 * radius * radius + 4 * half_width * half_width) / 12;
  body.inertia = Vector3d(side, 0.5 * mass * radius * radius, side).asDiagonal();
  engine::machine::MachineSpec spec;
  spec.bodies.push_back(body);
  return spec;
}

// A wheel of a ton on a floor in the frame R, at v along its x axis, rolling.
struct Rolling {
  Rolling(const Eigen::Matrix3d& R, double friction, double v, double stiffness = 1e8)
      : machine(wheel(1000)),
        world(options_of(R), support::one_material({.friction = friction, .stiffness = stiffness})) {
    world.attach(&machine);
    world.add_part_shape(0, support::shared(engine::Cylinder{radius, half_width}),
                         Eigen::Isometry3d::Identity(), 0);
    Eigen::Isometry3d X(R);
    X.translation() = R * Vector3d(0, 0, radius);
    machine.place(X);
    std::vector<double> state = machine.state();
    const Vector3d spin = R * Vector3d(0, v / radius, 0), velocity = R * Vector3d(v, 0, 0);
    for (int i = 0; i < 3; ++i) state[7 + i] = spin[i], state[10 + i] = velocity[i];
    machine.set_state(state);
  }
  static engine::WorldOptions options_of(const Eigen::Matrix3d& R) {
    engine::WorldOptions options;
    options.gravity = -9.81 * R.col(2);
    return options;
  }
  Machine machine;
  World world;
};

void add_box(World& world, const Eigen::Matrix3d& R, const Vector3d& half, const Vector3d& at) {
  Eigen::Isometry3d X(R);
  X.translation() = R * at;
  world.add_static(support::shared(engine::box(half)), X, 0);
}

}  // namespace

// 2 m/s for 10 s are 20 m, on one box and on tiles of 0.4 m, level in frames that stand anyhow. The wheel
// sinks in by 50 um at the start, which turns m g 50 um = 0.5 J of the 3000 J into heat, 0.01 % of the speed;
// single precision drifts by as much. Where the contact changes tiles within a step, the wheel sinks in anew:
// ten times that.
TEST(Wheel, RollsOnBoxesAsFarAsItShould) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 4; ++trial) {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    if (trial > 1)
      R = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
              .normalized()
              .toRotationMatrix();
    Rolling scene(R, 0.6, 2);
    if (trial % 2 == 0)
      add_box(scene.world, R, {30, 1, 0.5}, {20, 0, -0.5});
    else
      for (int k = -3; k < 60; ++k) add_box(scene.world, R, {0.2, 1, 0.5}, {0.4 * k, 0, -0.5});
    for (int k = 0; k < 1000; ++k) scene.world.step();
    const Vector3d p = R.transpose() * scene.machine.pose(0).translation();
    EXPECT_NEAR(p.x(), 20, trial % 2 ? 0.1 : 0.02) << trial;
    EXPECT_NEAR(p.y(), 0, 0.02) << trial;
    EXPECT_NEAR(p.z(), radius, 1e-3) << trial;
  }
}

// Over the edge of a box onto a lower one and against one that is higher: a wheel of 0.5 m at 0.5 m/s does
// not climb 0.2 m.
TEST(Wheel, IsStoppedByAKerb) {
  Rolling scene(Eigen::Matrix3d::Identity(), 0.3, 0.5);
  add_box(scene.world, Eigen::Matrix3d::Identity(), {5, 1, 0.5}, {0, 0, -0.5});
  add_box(scene.world, Eigen::Matrix3d::Identity(), {1, 1, 0.1}, {2, 0, 0.1});
  for (int k = 0; k < 400; ++k) {
    scene.world.step();
    // It touches the kerb's edge, 0.2 m high, where the centre is sqrt(R² - (R - 0.2)²) = 0.4 m before it.
    ASSERT_LT(scene.machine.pose(0).translation().x(), 1 - 0.4 + 0.02) << k;
  }
}
