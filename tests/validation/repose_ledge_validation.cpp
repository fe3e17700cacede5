// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/world/kinematic_body.hpp>
#include <drawpoint/tests/support/scenes.hpp>
#include <drawpoint/tests/validation/energy_ledger.hpp>
#include <drawpoint/tests/validation/heaps.hpp>

using namespace drawpoint;
using namespace drawpoint::engine;
using validation::Area;
using validation::Estimate;
using validation::name_of;
using validation::record;

namespace {

const validation::Problem repose_ledge{
    "repose_ledge", validation::Group::granular, "Angle of repose, ledge",
    "The end of a smooth bin, 2.4 m long and 0.9 m wide, with 410 rocks of 0.3 m is taken away; the "
    "bank that stays is small, and steeper than a high one (three or six seeds, default settings)."};

constexpr double size = 0.3, length = 2.4, width = 0.9;

// The bin: a ledge that ends at x = 0, its back wall and its smooth sides.
World bin(const Material& rough) {
  MaterialTable table(2);  // rocks and ledge; the smooth surfaces
  table.set(0, 0, rough);
  for (int kind : {0, 1}) table.set(kind, 1, {.friction = 0});
  World world({}, table);
  world.add_static(support::shared(box({length / 2, width, 0.5})), support::at(-length / 2, 0, -0.5), 0);
  const auto add_wall = [&](const Eigen::Vector3d& inward, double distance) {
    world.add_static(support::shared(HalfSpace{inward, -distance}), Eigen::Isometry3d::Identity(), 1);
  };
  add_wall({1, 0, 0}, length);
  add_wall({0, 1, 0}, width / 2);
  add_wall({0, -1, 0}, width / 2);
  return world;
}

struct Bank {
  double angle, largest_rise, recoverable;  // [deg], [J], [J]
};

Bank drained(const Material& rough, std::uint64_t seed) {
  World world = bin(rough);
  KinematicBody gate(support::at(0.25, 0, 3));
  world.attach(&gate);
  world.add_part_shape(0, support::shared(box({0.25, width / 2 - 0.005, 4})), Eigen::Isometry3d::Identity(),
                       1);
  validation::EnergyLedger ledger(world);
  const auto note = [&] {
    ledger.note(gate.work());
    for (int k = 0; k < static_cast<int>(world.rocks().size()); ++k)
      if (world.rocks()[k].present && world.rocks()[k].pose.translation().z() < -1) world.remove_rock(k);
  };
  validation::pour(world,
                   {.rocks = 410,
                    .size = size,
                    .centre = {-length / 2, 0},
                    .nx = 8,
                    .ny = 3,
                    .interval = 0.25,
                    .seed = seed},
                   note);
  validation::settle(world, 1.0, note);
  gate.set_velocity({4, 0, 0});
  validation::settle(world, 4.0, note);
  const double crest = validation::mean_height(world, Area{-length, -2 * length / 3, -width / 2, width / 2});
  return {validation::angle_of_bank(world, Area{-length, size, -width / 2, width / 2}, size, crest),
          ledger.largest_rise(), ledger.recoverable()};
}

const std::vector<std::uint64_t> three{1, 2, 3}, six{1, 2, 3, 4, 5, 6};

Estimate drained_angle(const Material& rough, const std::vector<std::uint64_t>& seeds) {
  std::vector<double> angles;
  for (std::uint64_t seed : seeds) {
    const Bank bank = drained(rough, seed);
    angles.push_back(bank.angle);
    EXPECT_LE(bank.largest_rise, bank.recoverable) << name_of(rough) << ", seed " << seed;
    if (seed == 1)
      validation::record_energy(repose_ledge, name_of(rough), bank.largest_rise, bank.recoverable);
  }
  return validation::estimate(angles);
}

void record_steepness(const Material& rough, const Estimate& bank) {
  record(repose_ledge,
         {.quantity = "angle of the bank, " + name_of(rough),
          .unit = "deg",
          .expected = 32,
          .source = "at least the lower end of the band of poured heaps",
          .measured = bank.mean,
          .error = std::max(0.0, 32 - bank.mean),
          .budget = 0,
          .budget_reason = "A drained bank is steeper than a poured heap; the error is what it lacks.",
          .headline = true});
}

// `student`: of as many degrees of freedom as the two means have together, 1 % one-sided.
void record_rise(const std::string& material, const Estimate& smooth, const Estimate& rough, double student,
                 const std::string& reason) {
  const double rise = rough.mean - smooth.mean;
  const double chance = student * std::hypot(smooth.standard_error, rough.standard_error);
  record(repose_ledge, {.quantity = "rise of the angle from μ = 0.1 to 0.9, " + material,
                        .unit = "deg",
                        .expected = chance,
                        .source = "at least what chance gives in 1 %",
                        .measured = rise,
                        .error = std::max(0.0, chance - rise),
                        .budget = 0,
                        .budget_reason = reason});
}

}  // namespace

// A drained bank stands steeper than a poured heap of the same rocks (41 deg against 26 deg was measured for
// iron-ore pellets: Lommen 2019), as its rocks are not shaken by others that arrive. So the lower end of the
// poured heaps' published band, 32 deg, is a lower bound here; no upper one is published for banks four rocks
// high. Banks scatter by some 5 deg from seed to seed; with six a rise of 2.76 standard errors, some 6 to 8
// deg, is what chance gives in one case of a hundred. From a friction of 0.3 the rise is no more than that
// (6.5 and 5.1 deg were seen), so that 24 seeds would be needed to show it surely; hence the smooth bank has
// 0.1.
TEST(ReposeLedge, RisesWithFrictionAndStandsAsSteepAsPoured) {
  const Material rough{.friction = 0.9, .rolling = 0.5};
  const Estimate low = drained_angle({.friction = 0.1, .rolling = 0.5}, six),
                 high = drained_angle(rough, six);
  record_steepness(rough, high);
  record_rise(
      "μ_r = 0.5", low, high, 2.76,
      "A rise must exceed 2.76 standard errors of the difference (Student, 10 degrees of freedom, 1 % "
      "one-sided); the error is what it lacks.");
}

// Rocks have shape: the same holds without rolling resistance, and with as little as blasted ore may have.
TEST(ReposeLedge, StandsByShapeAlone) {
  const Material none{.friction = 0.9}, little{.friction = 0.9, .rolling = 0.1};
  const Estimate low = drained_angle({.friction = 0.1}, three), high = drained_angle(none, three);
  record_steepness(none, high);
  record_rise("μ_r = 0", low, high, 3.75,
              "A rise must exceed 3.75 standard errors of the difference (Student, 4 degrees of freedom, 1 % "
              "one-sided).");
  record_steepness(little, drained_angle(little, three));
}
