// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <drawpoint/tests/validation/settings.hpp>
#include <numbers>

using namespace drawpoint;
using engine::World;
using validation::record;

namespace {

const validation::Problem incline{
    "incline", validation::Group::single_body, "Block on an incline",
    "A flat block of 0.8 m x 0.8 m x 0.2 m lies on a slope with friction 0.6 (friction angle 30.96°), "
    "in steps of 5 ms by the reference settings, and twice by the default settings."};

constexpr double g = 9.81, mu = 0.6, stiffness = 1e8, degree = std::numbers::pi / 180;

// Laid down with the overlap m g cos α / k, so that there is nothing to settle but the shear.
World block_on_slope(double angle, engine::WorldOptions options = validation::reference_settings()) {
  options.gravity = support::tilted_gravity(angle);
  World world(options, support::one_material({mu, 0.0, stiffness, 0}));
  support::add_floor(world);
  const auto body = support::box_body({0.4, 0.4, 0.1});
  world.add_rock(body, support::at(0, 0, 0.1 - body.mass * g * std::cos(angle) / stiffness));
  return world;
}

const engine::Rock& after(World& world, double time) {
  while (world.time() < time - 1e-9) world.step();
  return world.rocks()[0];
}

}  // namespace

// Half a second is left for the load to shift to the lower edge, which turns the block by m g / k over its
// length. After that it must not move. A row of the solve is off by its last change, which converges
// geometrically to the round-off of an impulse, 1e-16 m g h: speeds of 1e-16 g h = 5e-18 m/s and, over 2 s,
// 1e-17 m; a thousand times that covers the sum over points and iterations.
TEST(Incline, Sticks) {
  for (const double degrees : {15.0, 30.9}) {
    World world = block_on_slope(degrees * degree);
    const double settled = after(world, 0.5).pose.translation().x();
    record(incline,
           {.quantity = degrees < 20 ? "creep in 2 s at 15°" : "creep in 2 s at 30.9°",
            .unit = "m",
            .expected = 0,
            .source = "Coulomb",
            .measured = after(world, 2.5).pose.translation().x() - settled,
            .budget = 1e-14,
            .budget_reason = "Creep: sticking solves the step's equations exactly, so only the round-off of "
                             "impulses is left, a thousand times 1e-16 g h over 2 s."});
  }
}

TEST(Incline, HoldsWithTheDefaults) {
  World world = block_on_slope(30 * degree, {});
  const double settled = after(world, 0.5).pose.translation().x();
  record(incline, {.quantity = "creep in 2 s at 30° with the default settings",
                   .unit = "m",
                   .expected = 0,
                   .source = "Coulomb",
                   .measured = after(world, 2.5).pose.translation().x() - settled,
                   .budget = 2e-4,
                   .budget_reason =
                       "Creep and acceleration with the defaults: the engine's aim for standing piles, 0.1 "
                       "mm/s, as an error of the speed gained in 1 s."});
  World sliding = block_on_slope(32 * degree, {});
  const double early = after(sliding, 0.5).velocity.x(), late = after(sliding, 1.5).velocity.x();
  record(incline, {.quantity = "acceleration at 32° with the default settings",
                   .unit = "m/s²",
                   .expected = g * (std::sin(32 * degree) - mu * std::cos(32 * degree)),
                   .source = "g (sin α − μ cos α)",
                   .measured = late - early,
                   .budget = 1e-4,
                   .budget_reason =
                       "Creep and acceleration with the defaults: the engine's aim for standing piles, 0.1 "
                       "mm/s, as an error of the speed gained in 1 s."});
}

TEST(Incline, SlidesWithTheExactAcceleration) {
  for (const double degrees : {32.0, 45.0}) {
    World world = block_on_slope(degrees * degree);
    const double early = after(world, 0.5).velocity.x(), late = after(world, 1.5).velocity.x();
    record(incline, {.quantity = "acceleration at " + std::to_string(static_cast<int>(degrees)) + "°",
                     .unit = "m/s²",
                     .expected = g * (std::sin(degrees * degree) - mu * std::cos(degrees * degree)),
                     .source = "g (sin α − μ cos α)",
                     .measured = late - early,
                     .budget = 1e-6 * g,
                     .budget_reason =
                         "Acceleration: under a constant force the stepper's speed is exact; what is left is "
                         "the convergence of the normal load, 1e-6."});
  }
}

// Bisection on whether a block that slides at 0.1 m/s is faster after 2 s than after 1 s, when the load has
// long shifted to the lower edge.
TEST(Incline, Threshold) {
  double low = 25 * degree, high = 35 * degree;
  while (high - low > 1e-7) {
    const double angle = 0.5 * (low + high);
    World world = block_on_slope(angle);
    world.set_rock_velocity(0, Eigen::Vector3d(0.1, 0, 0), Eigen::Vector3d::Zero());
    const double early = after(world, 1).velocity.x(), late = after(world, 2).velocity.x();
    (early > 1e-6 && late > early ? high : low) = angle;
  }
  const double phi = std::atan(mu);
  record(incline,
         {.quantity = "slope on which a sliding block keeps its speed",
          .unit = "rad",
          .expected = phi,
          .source = "atan μ",
          .measured = 0.5 * (low + high),
          .budget = 1e-7 + 1e-6 * std::cos(phi),
          .budget_reason = "Threshold: the acceleration's budget of 1e-6 g, and the bisection's 1e-7."});
}
