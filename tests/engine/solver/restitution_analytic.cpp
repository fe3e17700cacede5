// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;

namespace {

engine::Material elastic(double e, double friction = 0) {
  engine::Material material;
  material.friction = friction;
  material.restitution = e;
  return material;
}

World free_space(double e) {
  engine::WorldOptions options;
  options.gravity.setZero();
  return World(options, support::one_material(elastic(e)));
}

}  // namespace

// A cube falls flat on the floor: the first bounce leaves with e times the speed of arrival. It comes early
// by at most a step, so the speed v = √(2 g H) of arrival is short by at most g h, and its rise, v² e²/2g, by
// the relative error 2 g h / v plus one of the same size for the step in which the top is seen, g h²/2, which
// is nothing: with H = 1 m and h = 10 ms 2 · 0.098 / 4.43 = 4.4 %.
TEST(Restitution, CubeBouncesToTheSquareOfEOfItsHeight) {
  for (const double e : {0.3, 0.6, 0.9}) {
    World world({}, support::one_material(elastic(e)));
    support::add_floor(world);
    world.add_rock(support::box_body({0.2, 0.2, 0.2}), support::at(0, 0, 1.2));
    const double arrival = std::sqrt(2 * 9.81 * 1.0), gh = 9.81 * world.options().step;
    double fastest = 0, top = 0;
    for (int k = 0; k < 140; ++k) {
      world.step();
      const double speed = world.rocks()[0].velocity.z();
      fastest = std::max(fastest, speed);
      if (fastest > 0) top = std::max(top, world.rocks()[0].pose.translation().z() - 0.2);
    }
    EXPECT_NEAR(fastest, e * arrival, e * gh + gh) << "e = " << e;
    EXPECT_NEAR(top, e * e, 2 * e * e * gh / arrival + 2 * e * gh * 0.01 + 5e-3) << "e = " << e;
  }
}

// Three equal cubes in a row, the first arrives with v. All impacts at once, with e = 1: u1' = -(-v) etc.
// give (-1/3, 2/3, 2/3) v, which keeps momentum and energy. The stage is solved to 1e-12; velocities pass
// through single precision: 1e-6 v.
TEST(Restitution, CradleSharesTheBlowAtOnce) {
  World world = free_space(1);
  const double v = 2;
  world.add_rock(support::box_body({0.2, 0.2, 0.2}), support::at(-0.605, 0, 0), Vector3d(v, 0, 0));
  for (int k = 0; k < 2; ++k)
    world.add_rock(support::box_body({0.2, 0.2, 0.2}), support::at(0.4 * k - 0.2, 0, 0));
  const double energy = world.kinetic_energy();
  world.step();
  const double expected[] = {-v / 3, 2 * v / 3, 2 * v / 3};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(world.rocks()[k].velocity.x(), expected[k], 1e-6 * v);
  EXPECT_NEAR(world.kinetic_energy(), energy, 4e-6 * energy);
}

// Normal impulses alone never add energy, at any e, however oblique the impact. What may is the push that
// takes an overlap back. A corner at r that turns at ω leaves its tangent by δ = ½ (ω h)² r in a step, by
// which it can overlap; that is taken back within the relaxation time 2h, at δ/2h = ¼ ω² h r: ½ m (¼ ω² h r)²
// a point. Tumbling by a splitting of second order (free_rotation.h) lets energy swing by less than (ω
// h)²/12 of it.
TEST(Restitution, AddsNoEnergyWithoutFriction) {
  for (const double e : {0.0, 0.5, 1.0}) {
    World world = free_space(e);
    const auto brick = support::box_body({0.2, 0.15, 0.1});
    for (int k = 0; k < 8; ++k)
      world.add_rock(brick, support::at(0.45 * (k % 2), 0.35 * (k / 2 % 2), 0.25 * (k / 4)),
                     Vector3d(k % 2 ? -3 : 2, k / 2 % 2 ? -1 : 1.5, k / 4 ? -2 : 1), Vector3d(k, 3 - k, 1));
    double last = world.kinetic_energy(), spin = 0;
    for (int k = 0; k < 100; ++k) {
      for (const auto& rock : world.rocks()) spin = std::max(spin, rock.angular_velocity.norm());
      const auto report = world.step();
      const double push = 0.25 * spin * spin * world.options().step * Vector3d(0.2, 0.15, 0.1).norm();
      const double swing = std::pow(spin * world.options().step, 2) / 12;
      EXPECT_LE(world.kinetic_energy(),
                last * (1 + 1e-6 + swing) + report.points * 0.5 * brick.mass * push * push)
          << "e = " << e << ", step " << k;
      last = world.kinetic_energy();
    }
  }
}
