// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// A machine of one's own: a boom on a hinge lifts a rock on its tray; what its motor and its bearing feel is known from
// statics. docs/tutorials/first-pile.md, part 3.

#include <cmath>
#include <cstdio>
#include <drawpoint/engine/machine/machine.hpp>
#include <drawpoint/engine/world/world.hpp>

using namespace drawpoint::engine;
using Eigen::Vector3d;

namespace {

constexpr double boom_mass = 120, boom_length = 2, boom_height = 1;  // [kg], [m], [m]
constexpr double g = 9.81;

// Everything is given once, in the pose in which all joint coordinates are zero: a rod along x, hinged at (0, 0, 1).
machine::MachineSpec boom_on_a_hinge() {
  //! [spec]
  machine::BodySpec boom;
  boom.name = "boom";
  boom.joint = machine::JointKind::hinge;
  boom.joint_point = {0, 0, boom_height};
  boom.joint_axis = -Vector3d::UnitY();  // positive: its end goes up
  boom.mass = boom_mass;
  boom.centre = {boom_length / 2, 0, boom_height};
  boom.inertia = Vector3d(2, 41, 41).asDiagonal();

  machine::MachineSpec spec;
  spec.bodies = {boom};
  spec.motors = {{"lift", {0}, 10e3}};        // at most 10 kN m
  spec.stops = {{"travel", {0}, -0.3, 0.8}};  // [rad]
  //! [spec]
  return spec;
}

bool close(const char* what, double value, double expected, double share) {
  std::printf("%-22s %10.1f, by statics %10.1f\n", what, value, expected);
  return std::abs(value - expected) <= share * std::abs(expected);
}

}  // namespace

int main() {
  MaterialTable materials(1);
  materials.set(0, 0, {.friction = 0.6, .stiffness = 1e8});
  World world({}, materials);

  //! [machine]
  machine::Machine boom(boom_on_a_hinge());
  boom.place(Eigen::Isometry3d::Identity());
  world.attach(&boom);
  // A part's shape is placed in the part's frame, whose origin is the centre of mass: the tray is 0.9 m ahead of it.
  world.add_part_shape(0, std::make_shared<const Shape>(box({0.3, 0.3, 0.05})),
                       Eigen::Isometry3d(Eigen::Translation3d(0.9, 0, 0)), 0);
  //! [machine]

  // A cube of 0.4 m and 2700 kg/m³, 173 kg, on the tray.
  const ConvexPolyhedron cube = box({0.2, 0.2, 0.2});
  const int rock = world.add_rock(RockBody::from_hull(cube.vertices(), 2700),
                                  Eigen::Isometry3d(Eigen::Translation3d(1.9, 0, boom_height + 0.25)));
  const double rock_mass = world.rock(rock).body.mass;

  boom.set_motor(0, 0);  // holds
  while (world.time() < 1) world.step();
  const double arm = world.rock(rock).pose.translation().x();
  const double torque = g * (boom_mass * boom_length / 2 + rock_mass * arm),
               load = g * (boom_mass + rock_mass);
  bool good = close("torque of the motor", boom.motor_force(0), torque, 0.01);
  good &= close("force in the hinge", boom.joint_wrench(0).force.norm(), load, 0.01);
  good &= close("force on the tray", -world.part_wrench(0).force.z(), g * rock_mass, 0.01);

  boom.set_motor(0, 0.1);  // lifts by 0.1 rad/s
  while (world.time() < 3) world.step();
  std::printf("lifted by %.4f rad, rock at a height of %.3f m\n", boom.coordinate(0),
              world.rock(rock).pose.translation().z());
  good &= std::abs(boom.coordinate(0) - 0.2) < 0.002 &&
          world.rock(rock).pose.translation().z() > boom_height + 0.5;
  return good ? 0 : 1;
}
