// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/tests/support/blocks.hpp>
#include <drawpoint/tests/validation/energy_ledger.hpp>
#include <limits>

using namespace drawpoint;
using engine::World;
using validation::record;

namespace {

const validation::Problem masonry_arch{
    "masonry_arch", validation::Group::assembly, "Masonry arch",
    "A semicircular arch of 24 voussoirs (mean radius 2 m, depth 0.6 m, 2500 kg/m³, μ = 0.8, 1e9 N/m "
    "per joint) is let go on the floor with closed joints, by the default settings."};

constexpr int voussoirs = 24;
constexpr double R = 2, depth = 0.6, density = 2500, g = 9.81, k = 1e9;

// The thrust line of an arch of ring thickness t = s R under its own weight (R = 1, unit weight per volume).
// The part between the crown and the radial section at θ weighs W = s θ, and its centre of mass lies C / W
// beside the crown, C = (ro³ − ri³)/3 (1 − cos θ). With the thrust H at height y in the crown section, the
// moment about the section's point at radius r vanishes for
//     H (y − r cos θ) = W r sin θ − C,  so  r(θ) = (H y + C) / (H cos θ + W sin θ).
// The arch can stand without tension if some (H, y) keeps ri ≤ r(θ) ≤ ro in every joint (the safe theorem:
// Heyman, "The stone skeleton", 1966). That is one linear condition on H y per joint and side, so for a given
// H the widest gap between them is found directly, and it is concave in H: golden section.
double room_for_thrust(double s, int joints_in_half, double H) {
  const double ri = 1 - s / 2, ro = 1 + s / 2;
  double least = 0, most = std::numeric_limits<double>::infinity();
  for (int j = 0; j <= joints_in_half; ++j) {
    const double theta = M_PI / 2 * j / joints_in_half;
    const double C = (ro * ro * ro - ri * ri * ri) / 3 * (1 - std::cos(theta));
    const double D = H * std::cos(theta) + s * theta * std::sin(theta);
    least = std::max(least, ri * D - C);
    most = std::min(most, ro * D - C);
  }
  return most - least;
}

bool can_stand(double s, int joints_in_half) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = 0, b = 1;
  for (int k = 0; k < 60; ++k) {
    const double left = b - golden * (b - a), right = a + golden * (b - a);
    if (room_for_thrust(s, joints_in_half, left) < room_for_thrust(s, joints_in_half, right))
      a = left;
    else
      b = right;
  }
  return room_for_thrust(s, joints_in_half, 0.5 * (a + b)) >= 0;
}

// Smallest t/R with joints at multiples of 90 deg / joints_in_half from the crown.
double limit_thickness(int joints_in_half) {
  double falls = 0.05, stands = 0.2;
  while (stands - falls > 1e-6) {
    const double middle = 0.5 * (falls + stands);
    (can_stand(middle, joints_in_half) ? stands : falls) = middle;
  }
  return stands;
}

// A joint carries at most T = half the arch's weight, on as little as an edge, where k gives by T/k or,
// before the joint opens, by twice that; it then turns by 2 T/(k t). The joints of one half together move no
// voussoir by more than Σ 2T/k (1 + lever/t), with levers of at most √2 R.
double settlement(double thickness) {
  const double thrust = 0.5 * M_PI * R * thickness * depth * density * g;
  return (voussoirs / 2 + 1) * 2 * thrust / k * (1 + std::sqrt(2.0) * R / thickness);
}

const char* const settlement_reason =
    "Elastic settlement: 13 joints of one half, each closing by at most 2T/k and turning by 2T/(k t) with T "
    "half "
    "the weight, levers of at most √2 R.";

// Σ force times overlap by the law over all joints, with the same T and 2T/k [J].
double elastic_energy(double thickness) {
  const double thrust = 0.5 * M_PI * R * thickness * depth * density * g;
  return (voussoirs + 1) * thrust * 2 * thrust / k;
}

struct Outcome {
  double moved, crown, largest_rise;  // [m], [m], [J]
};

Outcome run(double thickness, double time) {
  World world({}, support::one_material({.friction = 0.8, .stiffness = k}));
  support::add_floor(world);
  const auto arch = support::semicircular_arch(voussoirs, R, thickness, depth);
  for (const auto& block : arch) world.add_rock(block.body, block.pose);
  validation::EnergyLedger ledger(world);
  double moved = 0;
  while (world.time() < time && moved < 0.4 * R) {
    world.step();
    ledger.note();
    for (int i = 0; i < voussoirs; ++i)
      moved = std::max(moved, (world.rocks()[i].pose.translation() - arch[i].pose.translation()).norm());
  }
  return {moved, world.rocks()[voussoirs / 2].pose.translation().z(), ledger.largest_rise()};
}

}  // namespace

// Milankovitch (1907) gave t/R = 0.1075 for radial joints everywhere; the value quoted as Heyman's, 0.106,
// takes the weight at the centre line. With 1e-6 from the bisection and 1e-7 from 2000 joints, the fourth
// digit is exact.
TEST(MasonryArch, StatedLimitFollowsFromTheThrustLine) {
  record(masonry_arch, {.quantity = "limit t/R of the thrust line, joints everywhere",
                        .expected = 0.1075,
                        .source = "Milankovitch 1907, as quoted",
                        .measured = limit_thickness(2000),
                        .budget = 0.5e-4,
                        .budget_reason = "The published value has four decimals."});
}

TEST(MasonryArch, StandsWellAboveTheLimit) {
  const Outcome outcome = run(0.13 * R, 10);
  record(masonry_arch, {.quantity = "largest way of a voussoir in 10 s, t/R = 0.13",
                        .unit = "m",
                        .expected = 0,
                        .source = "safe theorem: it stands",
                        .measured = outcome.moved,
                        .budget = settlement(0.13 * R),
                        .budget_reason = settlement_reason});
  validation::record_energy(
      masonry_arch, "t/R = 0.13", outcome.largest_rise, elastic_energy(0.13 * R),
      "Only overlap gives energy back: at most force times overlap by the law in 25 joints.");
}

// Below the limit it becomes a mechanism and lands within seconds; the run ends when a voussoir has gone 0.4
// R.
TEST(MasonryArch, FallsClearlyBelowTheLimit) {
  const Outcome outcome = run(0.09 * R, 10);
  EXPECT_GE(outcome.moved, 0.4 * R);
  EXPECT_LT(outcome.crown, 0.7 * R);
  validation::record_energy(
      masonry_arch, "t/R = 0.09", outcome.largest_rise, elastic_energy(0.09 * R),
      "Only overlap gives energy back: at most force times overlap by the law in 25 joints.");
}

// Joints that settle by e shift the thrust line against the ring by no more than that on either side, as a
// ring thinner by 2 e would; the bisection adds half its last interval.
TEST(MasonryArch, FallsBelowTheLimitOfItsJoints) {
  double falls = 0.09, stands = 0.13;
  for (int k = 0; k < 6; ++k) {
    const double middle = 0.5 * (falls + stands);
    (run(middle * R, 5).moved <= settlement(middle * R) ? stands : falls) = middle;
  }
  record(masonry_arch,
         {.quantity = "t/R below which it falls within 5 s",
          .expected = limit_thickness(voussoirs / 2),
          .source = "thrust line, 24 joints",
          .measured = 0.5 * (falls + stands),
          .budget = 2 * settlement(0.11 * R) / R + 0.5 * (stands - falls),
          .budget_reason = "Settling joints shift the thrust line by their settlement on either side of the "
                           "ring; the bisection adds half its last interval."});
}
