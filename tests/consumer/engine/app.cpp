// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Links the installed engine and lets both of its private packages work: Simbody holds a rod, FCL finds a
// block. The answers are known exactly, so that a wrong or half-linked library shows.

#include <cmath>
#include <cstdio>
#include <drawpoint/engine/collision/contact_finder.hpp>
#include <drawpoint/engine/machine/machine.hpp>

namespace {

using namespace drawpoint::engine;

// A rod of mass m and length l that is turned from lying to standing gains m g l/2. The joint's angle is set
// to 1e-9 at least; the rest is round-off.
bool rod_gains_its_energy() {
  const double mass = 10, length = 2;
  const Eigen::Vector3d gravity(0, 0, -9.81);
  machine::BodySpec rod;
  rod.name = "rod";
  rod.joint = machine::JointKind::hinge;
  rod.joint_axis = -Eigen::Vector3d::UnitY();  // positive: end up
  rod.mass = mass;
  rod.centre = {length / 2, 0, 0};
  rod.inertia = mass * length * length / 12 * Eigen::Vector3d(1e-3, 1, 1).asDiagonal();
  machine::MachineSpec spec;
  spec.bodies = {rod};

  machine::Machine pendulum(spec);
  pendulum.place(Eigen::Isometry3d::Identity());
  const double lying = pendulum.energy(gravity);
  pendulum.set_coordinate(0, std::acos(0.0));
  const double gained = pendulum.energy(gravity) - lying;
  const double expected = mass * 9.81 * length / 2;
  std::printf("rod: gained %.12g J, expected %.12g J\n", gained, expected);
  return std::abs(gained - expected) < 1e-6 * expected;
}

// A cube of 1 m that stands 1 mm deep in the ground has four contact points there; 1e-9 m is far above
// round-off.
bool block_is_found() {
  ContactFinder finder;
  Collider ground, block;
  ground.shape = std::make_shared<const Shape>(HalfSpace{Eigen::Vector3d::UnitZ(), 0.0});
  ground.moves = false;
  block.shape = std::make_shared<const Shape>(box({0.5, 0.5, 0.5}));
  block.body = 1;
  finder.add(ground);
  finder.set_pose(finder.add(block), Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.499)));

  const auto& manifolds = finder.find();
  if (manifolds.size() != 1) return false;
  const Manifold& found = manifolds.front();
  std::printf("block: %d points, gap %.6f m, expected 4 and -0.001000 m\n", found.count, found.points[0].gap);
  return found.count == 4 && std::abs(found.points[0].gap + 0.001) < 1e-9;
}

}  // namespace

int main() {
  const bool rod = rod_gains_its_energy();
  const bool block = block_is_found();
  return rod && block ? 0 : 1;
}
