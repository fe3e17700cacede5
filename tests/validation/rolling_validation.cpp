// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <drawpoint/tests/validation/settings.hpp>
#include <numbers>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;
using validation::record;

namespace {

const validation::Problem rolling{
    "rolling", validation::Group::single_body, "Rolling to rest, and from slip to rolling",
    "A cylinder (radius 0.5 m, width 0.6 m, 1 t) rolls to rest, and from slip to rolling, in steps of "
    "5 ms by the reference settings; R* is the radius of the sphere of its volume."};

constexpr double g = 9.81, R = 0.5, half_width = 0.3, mass = 1000, stiffness = 1e8;

engine::RockBody cylinder() {
  const double across = mass * (R * R / 4 + half_width * half_width / 3);
  return {support::shared(engine::Cylinder{R, half_width}), mass, Vector3d(across, mass * R * R / 2, across),
          0};
}

double radius_of_volume(double volume) { return std::cbrt(3 * volume / (4 * std::numbers::pi)); }

World floor_with(const engine::Material& material) {
  const engine::WorldOptions options = validation::reference_settings();
  World world(options, support::one_material(material));
  support::add_floor(world);
  return world;
}

double substep(const World& world) { return world.options().step / world.options().solver.substeps; }

}  // namespace

// Rolling without slip, (m + I/R²) a = −μ_r R* m g / R, from v to rest over v²/(2 |a|). The stepper's speeds
// are exact under a constant moment, its positions v s/2 short, s the substep. The overlap m g/k = 1e-4 m
// shortens the arm R by half of itself, as the point lies midway between the surfaces: 1e-4 of the way.
TEST(Rolling, CylinderRollsToRest) {
  constexpr double mu_r = 0.05, v = 2;
  World world = floor_with({0.8, mu_r, stiffness, 0});
  world.add_rock(cylinder(), support::at(0, 0, R - mass * g / stiffness), Vector3d(v, 0, 0),
                 Vector3d(0, v / R, 0));
  while (world.time() < 10) world.step();
  const double R_star = radius_of_volume(std::numbers::pi * R * R * 2 * half_width);
  const double braking = mu_r * R_star * g / (1.5 * R), exact = v * v / (2 * braking);
  const auto& rock = world.rocks()[0];
  record(rolling,
         {.quantity = "distance to rest of the cylinder, 2 m/s, μ_r 0.05",
          .unit = "m",
          .expected = exact,
          .source = "v²/(2a), a = μ_r R* g / (1.5 R)",
          .measured = rock.pose.translation().x(),
          .budget = v * substep(world) / 2 + 2 * mass * g / stiffness / R * exact,
          .budget_reason =
              "Rolling distance: v s/2 of the substep s, and the overlap m g/k on the radius, twice."});
  record(rolling, {.quantity = "speed of the cylinder afterwards",
                   .unit = "m/s",
                   .expected = 0,
                   .source = "Coulomb-like resistance",
                   .measured = rock.velocity.norm() + R * rock.angular_velocity.norm(),
                   .budget = 1e-9,
                   .budget_reason =
                       "Rest: sticking is a solution of the step's equations, so only round-off is left."});
}

// Thrown without spin it slips until v = 2/3 v0 at t = v0/(3 μ g): the friction's line lies in the floor, so
// m v + I ω / R is kept. The contact point lies half the overlap above the floor's plane, m g/(2k)/R = 1e-4.
TEST(Rolling, CylinderFromSlipToRolling) {
  constexpr double mu = 0.3, v = 3;
  World world = floor_with({mu, 0.0, stiffness, 0});
  world.add_rock(cylinder(), support::at(0, 0, R - mass * g / stiffness), Vector3d(v, 0, 0));
  double rolls_from = 0;
  while (world.time() < 1) {
    world.step();
    const auto& rock = world.rocks()[0];
    if (rolls_from == 0 && rock.velocity.x() - R * rock.angular_velocity.y() < 1e-3 * v)
      rolls_from = world.time();
  }
  record(rolling, {.quantity = "speed of the cylinder when it rolls, thrown at 3 m/s",
                   .unit = "m/s",
                   .expected = 2 * v / 3,
                   .source = "2/3 v₀",
                   .measured = world.rocks()[0].velocity.x(),
                   .budget = v * mass * g / stiffness / R,
                   .budget_reason =
                       "Speed after the slip: the contact point lies half the overlap m g/k inside, which "
                       "shortens the arm."});
  record(rolling, {.quantity = "time at which it rolls",
                   .unit = "s",
                   .expected = v / (3 * mu * g),
                   .source = "v₀/(3 μ g)",
                   .measured = rolls_from,
                   .budget = world.options().step,
                   .budget_reason = "Time of the slip: seen at whole steps."});
}
