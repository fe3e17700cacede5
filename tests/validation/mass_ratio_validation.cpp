// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/energy_ledger.hpp>

using namespace drawpoint;
using engine::World;
using validation::record;

namespace {

const validation::Problem mass_ratio{
    "mass_ratio", validation::Group::assembly, "Mass ratio 1000:1",
    "A cube of 67.5 t lies on one of 67.5 kg or under it, and one of 20 t on four of 20 kg, at 1e9 "
    "N/m for 5 s by the default settings."};

constexpr double k = 1e9, g = 9.81, time = 5;

World world_with_floor() {
  World world({}, support::one_material({.friction = 0.8, .stiffness = k}));
  support::add_floor(world);
  return world;
}

double weight(const World& world) {
  double sum = 0;
  for (const auto& rock : world.rocks()) sum += rock.body.mass * g;
  return sum;
}

// The vertical impulses that the floor gave in the last step.
double floor_impulse(const World& world) {
  double sum = 0;
  for (const auto& pair : world.problem().pairs)
    if (pair.a == 0 || pair.b == 0)
      for (int i = pair.first; i < pair.first + pair.count; ++i)
        sum += std::abs(world.problem().points[i].impulse.z());
  return sum;
}

struct Result {
  double overlap, floor_load,
      largest_rise;  // overlap: largest of the whole run; load: mean of the last second
};

Result rest(World& world) {
  validation::EnergyLedger ledger(world);
  Result result{0, 0, 0};
  while (world.time() < time - 1e-9) {
    result.overlap = std::max(result.overlap, world.step().max_overlap);
    ledger.note();
    if (world.time() > time - 1) result.floor_load += floor_impulse(world);
  }
  result.largest_rise = ledger.largest_rise();
  return result;
}

// `law`: the largest overlap that the linear law asks for; `levels`: interfaces on top of each other.
void record_rest(World& world, const std::string& which, int top, double height, double small, double law,
                 int levels) {
  const Result result = rest(world);
  const double accuracy = 0.005 * small;
  const std::string stated = "The accuracy stated at this mass ratio: overlap below 0.5 % of the small cube";
  record(mass_ratio, {.quantity = "largest overlap, " + which,
                      .unit = "m",
                      .expected = law,
                      .source = "weight above / k",
                      .measured = result.overlap,
                      .budget = accuracy - law,
                      .budget_reason = stated + ", the law's own part (weight over k) included."});
  record(mass_ratio, {.quantity = "height of the upper centre, " + which,
                      .unit = "m",
                      .expected = height - levels * law,
                      .source = "weight above / k",
                      .measured = world.rocks()[top].pose.translation().z(),
                      .budget = levels * (accuracy - law),
                      .budget_reason = stated + ", at each level."});
  // Load − weight = change of momentum: 1e-3 of the weight over a second is a change of speed of 1 cm/s, far
  // more than anything that rests.
  record(mass_ratio,
         {.quantity = "floor load / weight in the last second, " + which,
          .expected = 1,
          .source = "statics",
          .measured = result.floor_load / weight(world),
          .budget = 1e-3,
          .budget_reason = "Load less weight is the change of momentum; anything at rest changes its speed "
                           "by less than 1 cm/s in that second, 1e-3 of what gravity would."});
  validation::record_energy(
      mass_ratio, which, result.largest_rise, levels * weight(world) * law,
      "Only overlap gives energy back: at most the weight times the law's overlap at each level.");
}

}  // namespace

TEST(MassRatio, HeavyOnLight) {
  World world = world_with_floor();
  world.add_rock(support::box_body({0.15, 0.15, 0.15}, 2500), support::at(0, 0, 0.15));
  world.add_rock(support::box_body({0.15, 0.15, 0.15}, 2.5e6), support::at(0, 0, 0.45));
  record_rest(world, "heavy on light", 1, 0.45, 0.3, weight(world) / k, 2);
}

TEST(MassRatio, LightOnHeavy) {
  World world = world_with_floor();
  world.add_rock(support::box_body({0.15, 0.15, 0.15}, 2.5e6), support::at(0, 0, 0.15));
  world.add_rock(support::box_body({0.15, 0.15, 0.15}, 2500), support::at(0, 0, 0.45));
  record_rest(world, "light on heavy", 1, 0.45, 0.3, weight(world) / k, 1);
}

TEST(MassRatio, TableOnFourLightLegs) {
  World world = world_with_floor();
  for (double x : {-0.8, 0.8})
    for (double y : {-0.8, 0.8}) world.add_rock(support::box_body({0.1, 0.1, 0.1}), support::at(x, y, 0.1));
  world.add_rock(support::box_body({1, 1, 1}), support::at(0, 0, 1.2));
  record_rest(world, "table", 4, 1.2, 0.2, weight(world) / 4 / k, 2);
}
