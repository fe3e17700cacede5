// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Turning bodies of a machine: momentum and energy of free ones, the precession of a gyroscope, the order of the
// method.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/machine/machine.hpp>
#include <drawpoint/tests/support/scenes.hpp>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;
using engine::machine::Machine;
using engine::machine::MachineSpec;

namespace {

constexpr double g = 9.81;

// Gimbals about z (precession) and y (tilt), and a disc that spins about x on an arm of length `arm` along x.
MachineSpec gyroscope(double arm) {
  using engine::machine::BodySpec;
  using engine::machine::JointKind;
  const auto light = [](const char* name, int parent, const Vector3d& axis) {
    BodySpec body;
    body.name = name, body.parent = parent, body.joint = JointKind::hinge, body.joint_axis = axis;
    body.mass = 1e-6, body.inertia = 1e-9 * Eigen::Matrix3d::Identity();
    return body;
  };
  MachineSpec spec;
  spec.bodies.push_back(light("precession", -1, Vector3d::UnitZ()));
  spec.bodies.push_back(light("tilt", 0, Vector3d::UnitY()));
  BodySpec disc = light("disc", 1, Vector3d::UnitX());
  disc.mass = 2, disc.inertia = Vector3d(0.04, 0.02, 0.02).asDiagonal();
  disc.centre = disc.joint_point = Vector3d(arm, 0, 0);
  spec.bodies.push_back(disc);
  return spec;
}

MachineSpec free_body(const Vector3d& inertia) {
  engine::machine::BodySpec body;
  body.name = "body", body.mass = 3, body.inertia = inertia.asDiagonal();
  MachineSpec spec;
  spec.bodies.push_back(body);
  return spec;
}

// The state of a free body: four numbers of a quaternion, three of a place, then three speeds of turning.
constexpr int turning = 7;

void spin(Machine& machine, const Vector3d& w) {
  std::vector<double> state = machine.state();
  for (int i = 0; i < 3; ++i) state[turning + i] = w[i];
  machine.set_state(state);
}

Vector3d angular_momentum(const Machine& machine, const Vector3d& inertia) {
  const std::vector<double> state = machine.state();
  const Eigen::Matrix3d R = machine.pose(0).linear();
  return R * inertia.asDiagonal() * R.transpose() * Eigen::Map<const Vector3d>(state.data() + turning);
}

void run(World& world, double h, double seconds) {
  for (int k = static_cast<int>(std::lround(seconds / h)); k > 0; --k) world.step(h);
}

// Angle about z and energy of a gyroscope that is let go level, precessing steadily, after `seconds`.
struct Gyration {
  double angle, tilt, energy_gain;
};
Gyration gyrate(double h, double seconds, double spin) {
  const double arm = 0.2;
  Machine machine(gyroscope(arm));
  engine::WorldOptions options;
  World world(options, support::one_material({.friction = 0}));
  world.attach(&machine);
  const double rate = 2 * g * arm / (0.04 * spin);  // of steady precession of a level axis: exact
  machine.set_velocity(Vector3d::Zero(), {{0, rate}, {2, spin}});
  const Vector3d gravity(0, 0, -g);
  const double before = machine.energy(gravity);
  run(world, h, seconds);
  return {machine.coordinate(0) - rate * seconds, machine.coordinate(1),
          machine.energy(gravity) / before - 1};
}

}  // namespace

// A level gyroscope precesses steadily at m g l/(C spin), whatever its other moments. 50 rad/s turn by half a
// radian in a step of 10 ms. The fourth-order flow in steps of 0.05 rad leaves 0.05⁴/120 of a rate, 5e-8: an
// angle of 2 rad is right to 1e-6, energy too.
TEST(Gyroscope, PrecessesAtTheExactRate) {
  for (const double h : {0.001, 0.01})
    for (const double spin : {30.0, 50.0, 200.0}) {
      const Gyration end = gyrate(h, 2, spin);
      EXPECT_NEAR(end.angle, 0, 1e-6) << "h " << h << ", spin " << spin;
      EXPECT_NEAR(end.tilt, 0, 1e-6) << "h " << h << ", spin " << spin;
      EXPECT_NEAR(end.energy_gain, 0, 1e-6) << "h " << h << ", spin " << spin;
    }
}

// A slender body thrown with 200 rad/s about a skew axis: no force acts, so momentum and energy stay. The
// flow loses x⁶/72 of its energy per step of x = 0.05 rad: 2e-10, 8e3 of them in 2 s of 200 rad/s.
TEST(FreeBody, KeepsMomentumAndEnergyAtAnySpeed) {
  for (const double h : {0.001, 0.005})
    for (const Vector3d& inertia : {Vector3d(0.002, 0.1, 0.1), Vector3d(0.03, 0.06, 0.08)}) {
      Machine machine(free_body(inertia));
      engine::WorldOptions options;
      options.gravity = Vector3d::Zero();
      World world(options, support::one_material({.friction = 0}));
      world.attach(&machine);
      spin(machine, Vector3d(150, 120, 60));
      const double before = machine.energy(Vector3d::Zero());
      const Vector3d momentum = angular_momentum(machine, inertia);
      run(world, h, 2);
      EXPECT_NEAR(machine.energy(Vector3d::Zero()), before, 1e-4 * before) << h;
      EXPECT_LT((angular_momentum(machine, inertia) - momentum).norm(), 1e-4 * momentum.norm()) << h;
    }
}
