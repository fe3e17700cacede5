// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/pile_measures.hpp>
#include <map>

using namespace drawpoint;
using namespace drawpoint::support;

namespace {

std::vector<RockState> start_states(const RockPile& pile) {
  std::vector<RockState> states;
  for (const PileRock& rock : pile.rocks) states.push_back({rock.start});
  return states;
}

std::uint64_t start_hash(int rocks, std::uint64_t seed) {
  return state_hash(start_states(rock_pile(rocks, seed)));
}

}  // namespace

TEST(RockPile, StartsWithoutAnyOverlap) {
  const RockPile pile = rock_pile(800);
  const auto states = start_states(pile);
  ASSERT_EQ(states.size(), 800u);
  EXPECT_EQ(rock_overlaps(pile, states).pairs, 0);
  EXPECT_EQ(wall_overlaps(pile, states).pairs, 0);
  EXPECT_EQ(blade_overlaps(pile, states, pile.blade.start).pairs, 0);
}

TEST(RockPile, KeepsTheMassSharesOfTheSizes) {
  // The sampler's bound: a size is off by less than the heaviest rocks of all sizes together. With volumes of
  // up to 0.24 L³ these weigh 0.24 · 4500 · (0.3³ + 0.4³ + 0.6³ + 0.8³) = 885 kg; of 203 t that is 0.44 %.
  const RockPile pile = rock_pile(3000);
  std::map<double, double> mass;
  for (const PileRock& rock : pile.rocks)
    mass[std::round(pile.hulls[rock.hull].hull.length() * 10) / 10] += pile.hulls[rock.hull].mass;
  ASSERT_EQ(mass.size(), 4u);
  for (const auto& size : engine::granular::blasted_ore)
    EXPECT_NEAR(mass[size.length] / pile.mass(), size.mass_share, 885 / pile.mass()) << size.length;
  EXPECT_LT(885 / pile.mass(), 0.02);
}

TEST(RockPile, HullsAreCentredOnTheirMassWithPrincipalAxes) {
  for (const PileHull& hull : rock_pile(300).hulls) {
    const auto properties = engine::mass_properties(hull.hull, RockPile::density);
    const double length = hull.hull.length();
    EXPECT_NEAR(properties.mass, hull.mass, 1e-9 * hull.mass);
    EXPECT_LT(properties.centre.norm(), 1e-9 * length);
    const Eigen::Matrix3d off = properties.inertia - Eigen::Matrix3d(hull.inertia.asDiagonal());
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-9 * hull.mass * length * length);
  }
}

TEST(RockPile, SameSeedSameBits) {
  EXPECT_EQ(start_hash(200, 1), start_hash(200, 1));
  EXPECT_NE(start_hash(200, 1), start_hash(200, 2));
}

TEST(RockPile, RefusesImpossibleNumbers) {
  for (const int rocks : {0, -3, 100'001}) {
    try {
      rock_pile(rocks);
      FAIL() << rocks;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("is " + std::to_string(rocks) + "; allowed: 1 to 100000"),
                std::string::npos)
          << error.what();
    }
  }
}
