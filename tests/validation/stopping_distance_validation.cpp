// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <numbers>

using namespace drawpoint;
using Eigen::Vector3d;
using engine::World;
using validation::record;

namespace {

const validation::Problem stopping{
    "stopping_distance", validation::Group::single_body, "Stopping distance of a sliding block",
    "A block of 0.8 m x 0.8 m x 0.2 m is thrown over a level floor (friction 0.5) at 2 m/s in 16 "
    "directions, by the default settings."};

constexpr double g = 9.81, mu = 0.5, speed = 2, stiffness = 1e8;

struct Path {
  double length, aside, turn, substep;
};

Path slide(double phi) {
  World world({}, support::one_material({mu, 0.0, stiffness, 0}));
  support::add_floor(world);
  const auto body = support::box_body({0.4, 0.4, 0.1});
  const Vector3d forward(std::cos(phi), std::sin(phi), 0);
  world.add_rock(body, support::at(0, 0, 0.1 - body.mass * g / stiffness), speed * forward);
  while (world.time() < 1) world.step();
  const auto& rock = world.rocks()[0];
  const Vector3d path = rock.pose.translation();
  return {path.dot(forward), path.dot(Vector3d::UnitZ().cross(forward)),
          std::atan2(rock.pose.linear()(1, 0), rock.pose.linear()(0, 0)),
          world.options().step / world.options().solver.substeps};
}

}  // namespace

// Coulomb's decelerating impulse is μ times the normal impulse, which over the slide is m g t but for the
// vertical speed, zero at both ends. With substeps s the speeds v − n μ g s are exact and the positions are
// their sums: v²/(2 μ g) − v s/2, and up to μ g s²/8 for the last, broken substep.
TEST(StoppingDistance, IsTheSameInEveryDirection) {
  constexpr double exact = speed * speed / (2 * mu * g);
  double shortest = 1e9, longest = 0, aside = 0, turn = 0, substep = 0;
  for (int k = 0; k < 16; ++k) {
    const Path path = slide(2 * std::numbers::pi * k / 16 + 0.1);
    shortest = std::min(shortest, path.length);
    longest = std::max(longest, path.length);
    aside = std::max(aside, std::abs(path.aside));
    turn = std::max(turn, std::abs(path.turn));
    substep = path.substep;
  }
  const double lag = speed * substep / 2, broken = mu * g * substep * substep / 8;
  record(stopping, {.quantity = "mean of shortest and longest distance",
                    .unit = "m",
                    .expected = exact,
                    .source = "v²/(2 μ g)",
                    .measured = (shortest + longest) / 2,
                    .budget = lag + broken + 1e-6 * exact,
                    .budget_reason =
                        "Distance: semi-implicit Euler sums the speeds at the ends of the substeps s, v s/2 "
                        "short; 1e-6 of it for the solver's convergence."});
  record(stopping, {.quantity = "longest minus shortest of 16 directions",
                    .unit = "m",
                    .expected = 0,
                    .source = "circular cone",
                    .measured = longest - shortest,
                    .budget = 1e-4 * exact,
                    .budget_reason =
                        "Spread: a pyramid of friction would spread them by 29 %; the circle's remainder is "
                        "the shear settling of the first steps, which depends on the direction: μ m g/k of "
                        "overlap at the edges, 1e-4 of the way."});
  record(stopping, {.quantity = "largest distance aside of the straight line",
                    .unit = "m",
                    .expected = 0,
                    .source = "circular cone",
                    .measured = aside,
                    .budget = 1e-4 * exact,
                    .budget_reason = "Aside and turn: as the spread."});
  record(stopping, {.quantity = "largest turn about the vertical",
                    .unit = "rad",
                    .expected = 0,
                    .source = "no moment of uniform sliding",
                    .measured = turn,
                    .budget = 1e-4,
                    .budget_reason = "Aside and turn: as the spread."});
}
