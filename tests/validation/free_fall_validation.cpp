// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/rocks.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <drawpoint/tests/validation/settings.hpp>

using namespace drawpoint;
using Eigen::Vector3d;
using validation::record;

namespace {

const validation::Problem free_fall{
    "free_fall", validation::Group::single_body, "Free fall",
    "A rock of 0.5 m is thrown at (3, -1, 4) m/s and falls for 2 s in steps of 5 ms."};

constexpr double h = 0.005, g = 9.81;
constexpr int steps = 400;
const Vector3d start(0, 0, 100), velocity(3, -1, 4);

const engine::Rock& thrown() {
  static engine::World world(validation::reference_settings(h), support::one_material({.friction = 0}));
  if (world.rocks().empty()) {
    world.add_rock(support::rock_body(0, 0.5), support::at(start.x(), start.y(), start.z()), velocity);
    for (int k = 0; k < steps; ++k) world.step();
  }
  return world.rocks()[0];
}

}  // namespace

// A step without contact is v += h g, q += h (v + v + h g) / 2: after n steps v = v0 - g t and q = q0 + v0 t - g t² /
// 2, the parabola itself, but for the round-off of n additions to numbers below 110: n · 110 · 1.1e-16 = 5e-12, and as
// many roundings of speeds below 20, each carried on by q for up to t: 400 · 20 · 1.1e-16 · 2 s = 2e-12.
TEST(FreeFall, IsTheParabola) {
  const double t = steps * h;
  const Vector3d exact = start + velocity * t - Vector3d(0, 0, g * t * t / 2);
  const std::string reason =
      "Only the round-off of 400 additions remains: 400 x 110 m x 1.1e-16, and half as much from the speeds.";
  record(free_fall, {.quantity = "distance from the parabola",
                     .unit = "m",
                     .expected = 0,
                     .source = "closed form",
                     .measured = (thrown().pose.translation() - exact).norm(),
                     .budget = 7e-12,
                     .budget_reason = reason});
  record(free_fall, {.quantity = "speed downwards",
                     .unit = "m/s",
                     .expected = g * t - velocity.z(),
                     .source = "closed form",
                     .measured = -thrown().velocity.z(),
                     .budget = 7e-12,
                     .budget_reason = reason});
}
