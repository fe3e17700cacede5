// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/energy_ledger.hpp>

using namespace drawpoint;
using engine::World;
using engine::WorldOptions;
using validation::record;

namespace {

const validation::Problem rock_stack{
    "rock_stack", validation::Group::assembly, "Stack of ten blocks",
    "Ten cubes of 0.3 m and 67.5 kg stand one on the other for 10 s, with friction 0.8 and 1e9 or 1e7 "
    "N/m, by the default settings."};

constexpr int n = 10;
constexpr double side = 0.3, g = 9.81, run_time = 10;

struct Stack {
  explicit Stack(double stiffness)
      : k(stiffness),
        world({}, support::one_material({.friction = 0.8, .stiffness = stiffness})),
        ledger(world) {
    support::add_floor(world);
    for (int i = 0; i < n; ++i)
      world.add_rock(support::box_body({side / 2, side / 2, side / 2}), support::at(0, 0, side * (i + 0.5)));
    ledger = validation::EnergyLedger(world);
    while (world.time() < run_time - 1e-9) {
      world.step();
      ledger.note();
    }
  }
  double weight() const { return world.rocks()[0].body.mass * g; }
  // Interface under n − i cubes; the law's overlap there is (n − i) m g / k.
  double overlap(int i) const {
    const double below = i == 0 ? 0 : world.rocks()[i - 1].pose.translation().z() + side / 2;
    return below + side / 2 - world.rocks()[i].pose.translation().z();
  }
  double law(int i) const { return (n - i) * weight() / k; }

  double k;
  World world;
  validation::EnergyLedger ledger;
};

// What the solver may leave. It stops when an iteration changes the impulses by less than `tolerance` of the
// load of all interfaces, Σ = n (n + 1) / 2 · m g h in a substep of h. The iteration contracts errors by ρ =
// cos²(π/(2n + 1)) (Gauss-Seidel on a chain with one fixed end), so an impulse is off by at most tolerance Σ
// / (1 − ρ), and a cube between two such has a residual velocity of 2/m times that. At rest the law turns a
// residual velocity u into an overlap error of u (h + 4τ)/4, with τ = 2 steps.
double solver_overlap() {
  const WorldOptions options;
  const double h = options.step / options.solver.substeps, tau = 2 * options.step;
  const double contraction = std::pow(std::cos(M_PI / (2 * n + 1)), 2);
  const double velocity = 2 * options.solver.tolerance / (1 - contraction) * n * (n + 1) / 2 * g * h;
  return velocity * (h + 4 * tau) / 4;
}

const char* const solver_reason =
    "The law is exact at rest; iterations that stop at a relative change of 1e-5, with the contraction of a "
    "chain of ten, leave "
    "a residual velocity u and so an overlap error of u (h + 4τ)/4.";

}  // namespace

// At 1e7 N/m the law's own overlaps, 66 µm to 0.66 mm, stand far above the solver's error.
TEST(RockStack, OverlapsAsTheLinearLawAsks) {
  const Stack stack(1e7);
  for (int i : {0, n / 2, n - 1})
    record(rock_stack, {.quantity = "overlap under " + std::to_string(n - i) + " cubes, 1e7 N/m",
                        .unit = "m",
                        .expected = stack.law(i),
                        .source = "weight above / k",
                        .measured = stack.overlap(i),
                        .budget = solver_overlap(),
                        .budget_reason = solver_reason});
  double elastic = 0;
  for (int i = 0; i < n; ++i) elastic += stack.k * stack.law(i) * stack.law(i);
  validation::record_energy(
      rock_stack, "1e7 N/m", stack.ledger.largest_rise(), elastic,
      "Only overlap gives energy back: at most the sum of force times overlap by the law.");
}

// With 1e9 N/m the overlaps are some microns and only bounded; the top block stands lower by all of them.
// Drift: the engine's stated accuracy for a standing pile, 0.1 mm/s, over the 10 s.
TEST(RockStack, Stands) {
  const Stack stack(1e9);
  double worst = 0, sideways = 0, lowered = 0, elastic = 0;
  for (int i = 0; i < n; ++i) {
    worst = std::max(worst, std::abs(stack.overlap(i) - stack.law(i)));
    lowered += stack.law(i);
    elastic += stack.k * stack.law(i) * (stack.law(i) + solver_overlap());
    sideways = std::max(sideways, stack.world.rocks()[i].pose.translation().head<2>().norm());
  }
  record(rock_stack, {.quantity = "worst overlap error of ten interfaces, 1e9 N/m",
                      .unit = "m",
                      .expected = 0,
                      .source = "weight above / k",
                      .measured = worst,
                      .budget = solver_overlap(),
                      .budget_reason = solver_reason});
  record(rock_stack, {.quantity = "height of the top cube's centre",
                      .unit = "m",
                      .expected = (n - 0.5) * side - lowered,
                      .source = "weight above / k",
                      .measured = stack.world.rocks()[n - 1].pose.translation().z(),
                      .budget = n * solver_overlap(),
                      .budget_reason = "Ten such overlap errors add up at the top."});
  record(rock_stack, {.quantity = "sideways drift in 10 s",
                      .unit = "m",
                      .expected = 0,
                      .source = "statics",
                      .measured = sideways,
                      .budget = 1e-4 * run_time,
                      .budget_reason = "The accuracy stated for a standing pile: drift below 0.1 mm/s."});
  validation::record_energy(
      rock_stack, "1e9 N/m", stack.ledger.largest_rise(), elastic,
      "Only overlap gives energy back: at most the sum of the law's forces times overlaps, "
      "the solver's error in them included.");
}
