// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/energy_ledger.hpp>

using namespace drawpoint;
using engine::World;
using validation::record;

namespace {

const validation::Problem newtons_cradle{
    "newtons_cradle", validation::Group::impact, "Newton's cradle",
    "A cube of 0.5 m strikes a row of others at 2 m/s without friction or gravity; touching ones "
    "share all impacts in one step, where a real cradle passes them on as cubes 0.1 m apart do "
    "(default settings)."};

constexpr double side = 0.5, v = 2;  // halves and quarters: touching faces have a gap of exactly zero

// n cubes, the first arriving with v from a distance of 5 mm and the others `apart`.
World cradle(int n, double restitution, double apart) {
  engine::WorldOptions options;
  options.gravity.setZero();
  World world(options, support::one_material({.friction = 0, .restitution = restitution}));
  for (int k = 0; k < n; ++k)
    world.add_rock(support::box_body({side / 2, side / 2, side / 2}),
                   support::at(k * (side + apart) - (k == 0 ? 0.005 : 0), 0, 0),
                   Eigen::Vector3d(k == 0 ? v : 0, 0, 0));
  return world;
}

const char* const precision_reason =
    "Velocities pass through single precision: ten roundings of 6e-8 of 2 m/s, and, where cubes carry no "
    "load, 25 600 of 3e-8 m/s as a random walk, 4.8e-6 m/s.";
// Cubes that go on together make all 64 iterations that have or precede momentum, in 50 x 16 substeps.
constexpr double precision = 10 * 6e-8 * v + 4.8e-6;

void record_velocity(const World& world, const std::string& which, int cube, double expected,
                     const std::string& source) {
  record(newtons_cradle, {.quantity = "velocity of cube " + std::to_string(cube + 1) + ", " + which,
                          .unit = "m/s",
                          .expected = expected,
                          .source = source,
                          .measured = world.rocks()[cube].velocity.x(),
                          .budget = precision,
                          .budget_reason = precision_reason});
}

// Steps 0.5 s; no step may add energy.
void run(World& world, const std::string& which) {
  validation::EnergyLedger ledger(world);
  const double energy = world.kinetic_energy();
  while (world.time() < 0.5) {
    world.step();
    ledger.note();
  }
  validation::record_energy(
      newtons_cradle, which, ledger.largest_rise(), 2 * energy * 10 * 6e-8,
      "Nothing overlaps, so only the velocities' roundings are left, twice that for their squares.");
}

}  // namespace

// Newton's law with all contacts at once: the struck contact separates with e v, the others, at rest before,
// do not open as all push: v2 = ... = vn = w, w − v1 = e v and v1 + (n − 1) w = v, so w = (1 + e) v / n and
// v1 = w − e v. Energy is kept for e = 1 with any n: (2/n − 1)² + (n − 1) 4/n² = 1. A Gauss-Seidel iteration
// that took each impact as it came would pass it on: (0, 0, v).
TEST(NewtonsCradle, SharesTheBlowAtOnceWhenTouching) {
  const std::string law = "Newton's law, all contacts at once";
  for (double e : {1.0, 0.5}) {
    World world = cradle(3, e, 0);
    const std::string which = "3 touching, e = " + std::to_string(e).substr(0, 3);
    run(world, which);
    const double w = (1 + e) * v / 3;
    record_velocity(world, which, 0, w - e * v, law);
    record_velocity(world, which, 1, w, law);
    record_velocity(world, which, 2, w, law);
  }
  World five = cradle(5, 1, 0);
  run(five, "5 touching, e = 1.0");
  record_velocity(five, "5 touching, e = 1.0", 0, -0.6 * v, law);
  record_velocity(five, "5 touching, e = 1.0", 4, 0.4 * v, law);
}

// 0.1 m apart a cube needs five steps from one to the next: the impacts come one by one, each swaps two
// velocities.
TEST(NewtonsCradle, PassesTheBlowOnWhenApart) {
  const std::string which = "3 apart, e = 1.0", law = "one impact after the other";
  World world = cradle(3, 1, 0.1);
  run(world, which);
  record_velocity(world, which, 0, 0, law);
  record_velocity(world, which, 1, 0, law);
  record_velocity(world, which, 2, v, law);
}
