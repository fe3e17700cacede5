// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/pile_shape.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <drawpoint/engine/record/file.hpp>
#include <filesystem>
#include <map>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

Scenario small_pile(double mass) {
  Scenario scenario = lh621_in_a_drift();
  scenario.pile.mass = mass;
  return scenario;
}

const SettledPile& twenty_tonnes() {
  static const SettledPile pile = pour_pile(small_pile(20e3));
  return pile;
}

double mass_of(const granular::PlacedRock& rock) {
  static const granular::RockLibrary library(4500);
  return library.body(rock.spec).mass;
}

}  // namespace

// Table 3: 20, 30, 30, 20 % of the mass in rocks of 0.3, 0.4, 0.6, 0.8 m. The emitter draws to a mass quota,
// which is never off by more than the heaviest rocks of all sizes together: 0.24 · 4500 · (0.3³ + 0.4³ + 0.6³
// + 0.8³) = 885 kg.
TEST(SettledPile, HasTheMassDistributionOfTheTable) {
  std::map<double, double> by_size;
  double total = 0;
  for (const auto& rock : twenty_tonnes().rocks) {
    by_size[rock.spec.size] += mass_of(rock);
    total += mass_of(rock);
  }
  EXPECT_GE(total, 20e3);
  EXPECT_LT(total, 20e3 + 560);
  const double bound = 885 / total;
  EXPECT_NEAR(by_size[0.3] / total, 0.2, bound);
  EXPECT_NEAR(by_size[0.4] / total, 0.3, bound);
  EXPECT_NEAR(by_size[0.6] / total, 0.3, bound);
  EXPECT_NEAR(by_size[0.8] / total, 0.2, bound);
}

// Every rock came to rest inside the drift: centre above the floor by at least a sixth of its length (the
// thinnest half of any of the six rocks is 0.22 of it), within the walls and before the back wall.
TEST(SettledPile, LiesAtRestInsideTheDrift) {
  const Drift drift = small_pile(20e3).drift;
  EXPECT_FALSE(twenty_tonnes().timed_out);
  for (const auto& rock : twenty_tonnes().rocks) {
    const Eigen::Vector3d p = rock.pose.translation();
    EXPECT_GT(p.z(), rock.spec.size / 6);
    EXPECT_LT(p.z(), 3.0);
    EXPECT_LT(std::abs(p.y()), drift.width / 2);
    EXPECT_LT(p.x(), drift.length);
    EXPECT_GT(p.x(), 10.0);
  }
}

// The pile of the default study lies as blasted ore lies, 35 to 42 degrees (published for hard rock). One
// seed, the study's own: seeds lie at 36 degrees in the mean. Single piles of this rock scatter by 3.9 (standard
// deviation of eleven), 24 piles of the default before by 4.6 (docs/measurements/loading.md); the larger sample
// is taken, and one pile may lie that much outside. No row is flatter than a pile that was dropped (25 degrees at
// most) or steeper than wet sand stands; the crest is higher than the bucket's mouth, 1.75 m, and no rock reaches the
// roof.
TEST(SettledPile, LiesAtTheAngleOfReposeOfBlastedRock) {
  const Scenario scenario = lh621_in_a_drift();
  const SettledPile pile = pour_pile(scenario);
  const PileShape shape = pile_shape(pile, scenario);
  EXPECT_FALSE(pile.timed_out);
  EXPECT_GE(shape.mass, scenario.pile.mass);
  constexpr double degree = M_PI / 180;
  EXPECT_GT(shape.surface.mean, (35 - 4.6) * degree);
  EXPECT_LT(shape.surface.mean, (42 + 4.6) * degree);
  EXPECT_GT(shape.surface.least, 25 * degree);
  EXPECT_LT(shape.surface.most, 50 * degree);
  EXPECT_GT(shape.surface.crest, 1.75);
  for (const auto& rock : pile.rocks) EXPECT_LT(rock.pose.translation().z(), scenario.drift.height);
}

// A wedge of columns with a slope of 2 in 5 and a toe between columns: the fit through its upper part is
// exact.
TEST(SurfaceAngle, IsExactOnAWedge) {
  ColumnGrid grid{.x_min = 0, .x_max = 10, .half_width = 2.5, .cell = 0.25};
  Eigen::MatrixXd heights(grid.nx(), grid.ny());
  for (int i = 0; i < grid.nx(); ++i)
    for (int j = 0; j < grid.ny(); ++j) heights(i, j) = std::clamp(0.4 * (grid.x(i) - 4.1), 0.0, 1.6);
  const ColumnModel model = column_model(heights, grid);
  ASSERT_FALSE(model.rows.empty());
  for (const Row& row : model.rows) EXPECT_NEAR(surface_angle(model, row), std::atan(0.4), 1e-12);
}

// The rocks' material is part of the pile's provenance key; that of the machine, which comes later, is not.
TEST(SettledPile, BelongsToItsMaterials) {
  const Scenario own = small_pile(20e3);
  Scenario other = own;
  other.materials.rock_steel.friction += 0.1;
  EXPECT_EQ(pile_provenance(other), pile_provenance(own));
  other.materials = lindmark2016_materials();
  EXPECT_NE(pile_provenance(other), pile_provenance(own));
  other.materials = with_resistance(own.materials, own.materials.rock_rock.rolling, 0.1);
  EXPECT_NE(pile_provenance(other), pile_provenance(own));
}

// And so is everything else that its bits depend on.
TEST(SettledPile, BelongsToItsSetting) {
  struct Case {
    const char* what;
    void (*change)(Scenario&);
  };
  const std::vector<Case> cases{
      {"direction of gravity",
       [](Scenario& s) {
         s.world.gravity = {9.81, 0, 0};
       }},
      {"sideways gravity", [](Scenario& s) { s.world.gravity.y() = 1e-6; }},
      {"tolerance while pouring", [](Scenario& s) { s.pile.tolerance *= 2; }},
      {"rest's hold", [](Scenario& s) { s.pile.rest.hold *= 2; }},
      {"rest's cap", [](Scenario& s) { s.pile.rest.cap *= 2; }},
      {"rest's speed", [](Scenario& s) { s.pile.rest.fastest *= 2; }},
      {"rest's energy", [](Scenario& s) { s.pile.rest.mean_energy *= 2; }},
      {"margin", [](Scenario& s) { s.world.contacts.margin *= 2; }},
      {"slack", [](Scenario& s) { s.world.contacts.slack *= 2; }},
      {"reuse distance", [](Scenario& s) { s.world.contacts.reuse_distance *= 2; }},
      {"reuse angle", [](Scenario& s) { s.world.contacts.reuse_angle *= 2; }},
      {"hysteresis", [](Scenario& s) { s.world.contacts.hysteresis *= 2; }},
      {"narrow", [](Scenario& s) { s.world.contacts.narrow = NarrowMethod::fcl_libccd; }},
      {"sizes", [](Scenario& s) { s.pile.sizes = granular::blasted_ore_with_fines; }},
      {"step", [](Scenario& s) { s.world.step *= 0.5; }},
      {"method", [](Scenario& s) { s.world.solver.method = Method::sequential; }},
      {"damping time", [](Scenario& s) { s.materials.rock_rock.damping_time = 0.1; }},
      {"normal law", [](Scenario& s) { s.materials.rock_terrain.law = NormalLaw::hertz; }}};
  const Scenario own = small_pile(20e3);
  for (const Case& c : cases) {
    Scenario other = own;
    c.change(other);
    EXPECT_NE(pile_provenance(other), pile_provenance(own)) << c.what;
  }
  Scenario faster = own;
  faster.world.threads = 8;              // changes no bit
  faster.world.solver.tolerance = 1e-3;  // nor does that of the cycles
  EXPECT_EQ(pile_provenance(faster), pile_provenance(own));
}

TEST(SettledPile, IsTheSameBitForBitWhenPouredAgain) {
  const SettledPile a = pour_pile(small_pile(10e3)), b = pour_pile(small_pile(10e3));
  ASSERT_EQ(a.rocks.size(), b.rocks.size());
  for (std::size_t k = 0; k < a.rocks.size(); ++k)
    EXPECT_TRUE(a.rocks[k].pose.matrix() == b.rocks[k].pose.matrix());
}

// Version 1 calls the provenance key "recipe".
TEST(SettledPile, AFileOfVersionOneIsRead) {
  const auto path = std::filesystem::path(testing::TempDir()) / "drawpoint_pile_1.h5";
  const Scenario scenario = small_pile(20e3);
  const auto write_old = [&](const std::string& provenance) {
    record::Writer file(path, {"drawpoint settled pile", 1});
    file.text("/", "recipe", provenance);
    file.number("/", "poured_s", 1.5);
    file.integer("/", "timed_out", 0);
    const std::vector<std::int32_t> shape{2};
    const std::vector<double> size{0.6}, pose{1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6};
    file.array("/shape", std::span<const std::int32_t>(shape));
    file.array("/size", std::span<const double>(size));
    file.array("/pose", std::span<const double>(pose), {1, 3, 4});
    file.commit();
  };
  write_old(pile_provenance(scenario));
  const SettledPile read = read_pile(path, scenario);
  ASSERT_EQ(read.rocks.size(), 1u);
  EXPECT_EQ(read.rocks[0].spec.size, 0.6);
  EXPECT_EQ(read.provenance, pile_provenance(scenario));
  write_pile(path, read, scenario);
  const record::Reader written(path, {"drawpoint settled pile", 2});
  EXPECT_EQ(written.text("/", "provenance"), pile_provenance(scenario));
  write_old("of another drift");
  EXPECT_THROW(read_pile(path, scenario), std::runtime_error);
  std::filesystem::remove(path);
}

TEST(SettledPile, IsReadBackExactlyAndOnlyForItsOwnProvenance) {
  const auto path = std::filesystem::path(testing::TempDir()) / "drawpoint_pile.h5";
  const Scenario scenario = small_pile(20e3);
  write_pile(path, twenty_tonnes(), scenario);
  const SettledPile read = read_pile(path, scenario);
  ASSERT_EQ(read.rocks.size(), twenty_tonnes().rocks.size());
  for (std::size_t k = 0; k < read.rocks.size(); ++k) {
    EXPECT_EQ(read.rocks[k].spec.shape, twenty_tonnes().rocks[k].spec.shape);
    EXPECT_TRUE(read.rocks[k].pose.matrix() == twenty_tonnes().rocks[k].pose.matrix());
  }
  EXPECT_THROW(read_pile(path, small_pile(21e3)), std::runtime_error);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  try {
    read_pile(path, scenario);
    FAIL() << "a truncated snapshot was read";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("truncated"), std::string::npos) << error.what();
  }
  std::filesystem::remove(path);
}
