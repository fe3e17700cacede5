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

const validation::Problem rolling_prism{
    "rolling_prism", validation::Group::single_body, "Rolling of a twelve-sided prism",
    "A prism (radius 0.5 m, width 0.6 m) rolls over its edges and loses energy to each face that "
    "strikes the floor and to rolling resistance, at 1e12 N/m in steps of 0.1 ms by the reference "
    "settings."};

constexpr double g = 9.81, R = 0.5, half_width = 0.3, density = 2000, h = 1e-4, omega = 3;
constexpr int n = 12;
const double beta = 2 * std::numbers::pi / n, s = std::sin(beta / 2);

struct Prism {
  engine::RockBody body;
  double mass, inertia, edge;  // edge: moment about an edge

  Prism() {
    const auto shape = engine::prism(R, half_width, n);
    const auto properties = engine::mass_properties(shape, density);
    body = {support::shared(shape), properties.mass, properties.inertia.diagonal(), 0};
    mass = properties.mass;
    inertia = properties.inertia(1, 1);
    edge = inertia + mass * R * R;
  }
  double radius() const { return std::cbrt(3 * mass / density / (4 * std::numbers::pi)); }
};

// The rate after turning from angle `from` to `to` about an edge (0: the centre above it), or −1 if it does
// not get there: I_e ω dω = (m g R sin φ − r N) dφ, N = m (g − R ω² cos φ − R α sin φ), r = μ_r R*.
double turned(const Prism& p, double rate, double from, double to, double r) {
  constexpr int steps = 2000;
  double energy = 0.5 * p.edge * rate * rate;
  for (int k = 0; k < steps; ++k) {
    const double phi = from + (to - from) * (k + 0.5) / steps, w2 = 2 * energy / p.edge;
    // N and α = (m g R sin φ − r N)/I_e together.
    const double ratio = p.mass * R * std::sin(phi) / p.edge;
    const double N =
        (p.mass * (g - R * w2 * std::cos(phi)) - ratio * p.mass * g * R * std::sin(phi)) / (1 - ratio * r);
    energy += (p.mass * g * R * std::sin(phi) - r * N) * (to - from) / steps;
    if (energy <= 0) return -1;
  }
  return std::sqrt(2 * energy / p.edge);
}

// A face strikes with its new edge, about which angular momentum is kept but for the resistance's r J, J = m
// R s (ω⁻ + ω⁺) the normal impulse; the old edge lifts: ω⁺ (I_e + r m R s) = ω⁻ (I + m R² cos β − r m R s).
double struck(const Prism& p, double rate, double r) {
  const double loss = r * p.mass * R * s;
  return rate * (p.inertia + p.mass * R * R * std::cos(beta) - loss) / (p.edge + loss);
}

struct Rates {
  std::vector<double> over_edge;  // as the centre passes above the 1st, 2nd, ... edge
  double bound = 0;               // of the stepper's error at the 5th
};

// A step sees the floor up to one step early: the face may strike before it has turned the last ω h and
// fallen m g R s ω h; the closing of what is left may cost as much again. A relative error of energy passes
// from face to face.
Rates expected(const Prism& p, double r) {
  Rates rates;
  double rate = omega, bound = 0;
  for (;;) {
    const double top = turned(p, rate, -beta / 2, 0, r);
    if (top < 0) return rates;
    rates.over_edge.push_back(top);
    if (rates.over_edge.size() == 5) rates.bound = bound / (p.edge * top);
    const double low = turned(p, top, 0, beta / 2, r);
    const double kept = struck(p, low, r) / low;
    bound = kept * kept * (bound + 2 * p.mass * g * R * s * low * h);
    rate = struck(p, low, r);
  }
}

std::vector<double> measured(const Prism& p, double mu_r, double* sides) {
  const engine::WorldOptions options = validation::reference_settings(h);
  World world(options, support::one_material({0.8, mu_r, 1e12, 0}));
  support::add_floor(world);
  const Vector3d edge(R * s, 0, -R * std::cos(beta / 2)), spin(0, omega, 0);
  world.add_rock(p.body, support::at(0, 0, R * std::cos(beta / 2)), spin.cross(-edge), spin);
  std::vector<double> rates;
  while (world.time() < 6) {
    world.step();
    *sides = world.rocks()[0].pose.translation().x() / (2 * R * s);
    if (*sides > rates.size() + 0.5) rates.push_back(world.rocks()[0].angular_velocity.y());
  }
  return rates;
}

}  // namespace

TEST(RollingPrism, LosesWhatEachFaceTakes) {
  const Prism prism;
  for (const double mu_r : {0.0, 0.01}) {
    const Rates exact = expected(prism, mu_r * prism.radius());
    double sides = 0;
    const std::vector<double> rates = measured(prism, mu_r, &sides);
    const std::string with = mu_r == 0 ? ", no rolling resistance" : ", rolling resistance 0.01";
    ASSERT_GE(rates.size(), 5u);
    record(
        rolling_prism,
        {.quantity = "rate over the fifth edge" + with,
         .unit = "rad/s",
         .expected = exact.over_edge[4],
         .source = "angular momentum about the new edge, energy in between",
         .measured = rates[4],
         .budget = exact.bound,
         .budget_reason =
             "Rate: a step sees the floor up to h early, so a face falls m g R sin(β/2) ω h short, at most "
             "twice; the losses add up over four faces."});
    record(rolling_prism, {.quantity = "edges passed" + with,
                           .expected = static_cast<double>(exact.over_edge.size()),
                           .source = "angular momentum about the new edge, energy in between",
                           .measured = static_cast<double>(rates.size()),
                           .budget = 0,
                           .budget_reason = "Edges: an integer."});
  }
}
