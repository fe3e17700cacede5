// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/record.hpp>
#include <drawpoint/tests/validation/settings.hpp>
#include <numbers>

using namespace drawpoint;
using engine::NormalLaw;
using validation::record;

namespace {

const validation::Problem overlap{
    "overlap", validation::Group::single_body, "Overlap of a resting block",
    "Cubes of 20 kg and 160 kg come to rest on the floor within 4 s, by a linear contact of 1e6 N/m "
    "and by Hertz's law (E* = 1 MPa), in steps of 5 ms by the reference settings."};

constexpr double g = 9.81;

double resting_overlap(double side, const engine::Material& material) {
  const engine::WorldOptions options = validation::reference_settings();
  engine::World world(options, support::one_material(material));
  support::add_floor(world);
  world.add_rock(support::box_body(Eigen::Vector3d::Constant(side / 2)), support::at(0, 0, side / 2));
  while (world.time() < 4) world.step();
  return side / 2 - world.rocks()[0].pose.translation().z();
}

double weight(double side) { return 2500 * side * side * side * g; }

// The block swings on its contact, ω² = g/δ (3g/(2δ) with Hertz), and is damped by τ: slowly at the rate ω²
// τ/2, 28/s or more here, or 1/τ = 10/s: after 4 s by e^-40 at least. With an equal load every step the
// solver converges to round-off: 1e-16 of the overlap for each of some thousand roundings since the last
// digits moved.
constexpr double converged = 1e-12;
const std::string reason =
    "Overlap: the damping leaves e^-40 of the first swing, so nothing but round-off, 1e-12 of the overlap, "
    "is left.";

}  // namespace

TEST(Overlap, OfTheLinearLawIsForceOverStiffness) {
  for (const double side : {0.2, 0.4}) {
    const double exact = weight(side) / 1e6;
    record(overlap, {.quantity = side < 0.3 ? "linear, 20 kg" : "linear, 160 kg",
                     .unit = "m",
                     .expected = exact,
                     .source = "m g / k",
                     .measured = resting_overlap(side, {0.5, 0, 1e6, 0}),
                     .budget = converged * exact,
                     .budget_reason = reason});
  }
}

TEST(Overlap, OfHertzLawIsItsPowerOfTheForce) {
  for (const double side : {0.2, 0.4}) {
    engine::Material material{0.5, 0, 1e6, 0.1};
    material.law = NormalLaw::hertz;
    const double radius = side * std::cbrt(3 / (4 * std::numbers::pi));
    const double exact = std::pow(weight(side) / (4.0 / 3 * 1e6 * std::sqrt(radius)), 2.0 / 3);
    record(overlap, {.quantity = side < 0.3 ? "Hertz, 20 kg" : "Hertz, 160 kg",
                     .unit = "m",
                     .expected = exact,
                     .source = "(m g / k_n)^(2/3), k_n = 4/3 E* √R*",
                     .measured = resting_overlap(side, material),
                     .budget = converged * exact,
                     .budget_reason = reason});
  }
}
