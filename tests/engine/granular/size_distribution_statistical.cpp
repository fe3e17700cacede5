// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/granular/rock_shapes.hpp>
#include <drawpoint/engine/granular/size_distribution.hpp>
#include <stdexcept>
#include <string>

using drawpoint::engine::granular::blasted_ore;
using drawpoint::engine::granular::number_shares;
using drawpoint::engine::granular::rock_shapes;
using drawpoint::engine::granular::RockDraw;
using drawpoint::engine::granular::rocks_per_mass;
using drawpoint::engine::granular::RockSampler;
using drawpoint::engine::granular::size_names;
using drawpoint::engine::granular::sizes_named;

TEST(SizeDistribution, NumberSharesFollowFromMassShares) {
  const auto shares = number_shares(blasted_ore);
  EXPECT_NEAR(shares[0], 0.534, 5e-4);  // printed to a tenth of a per cent
  EXPECT_NEAR(shares[1], 0.338, 5e-4);
  EXPECT_NEAR(shares[2], 0.100, 5e-4);
  EXPECT_NEAR(shares[3], 0.028, 5e-4);
}

TEST(RockSampler, KeepsToTheMassQuotaAtEveryMoment) {
  double heaviest = 0;
  for (const auto& rock : rock_shapes()) heaviest = std::max(heaviest, 4500 * rock.volume());
  for (const auto name : size_names) {
    const auto sizes = sizes_named(std::string(name));
    double bound = 0;  // the sum of the heaviest rocks of all sizes
    for (const auto& size : sizes) bound += heaviest * std::pow(size.length, 3);
    RockSampler sampler(3, 4500, sizes);
    for (int k = 0; k < 20000; ++k) {
      sampler.next();
      double total = 0;
      for (double mass : sampler.state().mass) total += mass;
      for (std::size_t i = 0; i < 4; ++i)
        ASSERT_LE(std::abs(sampler.state().mass[i] - sizes[i].mass_share * total), bound)
            << name << ", draw " << k;
    }
  }
}

// What the header says of each, against the sum by hand: Σ w/L³ is 13.88, 41.3, 112.1 and 59.6 per m³.
TEST(SizeDistribution, FinerRockIsMoreRocks) {
  const double mine = rocks_per_mass(blasted_ore);
  EXPECT_NEAR(mine, 0.2 / 0.027 + 0.3 / 0.064 + 0.3 / 0.216 + 0.2 / 0.512, 1e-12);
  EXPECT_NEAR(rocks_per_mass(sizes_named("mine_with_fines")) / mine, 3.0, 0.05);
  EXPECT_NEAR(rocks_per_mass(sizes_named("mine_with_small_fines")) / mine, 8.1, 0.05);
  EXPECT_NEAR(rocks_per_mass(sizes_named("well_broken")) / mine, 4.3, 0.05);
}

TEST(SizeDistribution, AnUnknownNameIsRefusedWithTheNamesThereAre) {
  try {
    sizes_named("sand");
    FAIL() << "sand was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "granular::sizes_named: \"sand\"; choose mine, mine_with_fines, "
                 "mine_with_small_fines or well_broken");
  }
}

// n = 20 000 rocks. A size of share p ends within (quota error)/(mean mass) + (scatter of the shapes'
// volumes) of p n: the quota is met to about 4 rocks; the mean volume of k rocks scatters by 9 %/√k, so their
// number by 9 % √k < 10 at one standard deviation. 0.3 % of n is 60 rocks, six of them: a false alarm in
// 1e-8.
TEST(RockSampler, NumberSharesAppear) {
  RockSampler sampler(7, 2700);
  const auto shares = number_shares(blasted_ore);
  std::array<int, 4> count{};
  const int n = 20000;
  for (int k = 0; k < n; ++k) ++count[static_cast<std::size_t>(sampler.next().size)];
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(count[i] / double(n), shares[i], 0.003);
}

// Shapes are drawn alike: χ² with 5 degrees of freedom stays below 25.7 but for one run in 10 000.
TEST(RockSampler, ShapesAreEquallyLikely) {
  RockSampler sampler(8, 2700);
  std::array<int, 6> count{};
  for (int k = 0; k < 12000; ++k) ++count[static_cast<std::size_t>(sampler.next().shape)];
  double chi_square = 0;
  for (int c : count) chi_square += (c - 2000.0) * (c - 2000.0) / 2000.0;
  EXPECT_LT(chi_square, 25.7);
}

TEST(RockSampler, MassIsThatOfTheShape) {
  RockSampler sampler(9, 3000);
  for (int k = 0; k < 100; ++k) {
    const RockDraw rock = sampler.next();
    const auto shape = rock_shapes()[static_cast<std::size_t>(rock.shape)].scaled(rock.length);
    EXPECT_NEAR(rock.mass, 3000 * shape.volume(), 1e-12 * rock.mass);
  }
}

TEST(RockSampler, SeedAndStateDecideEverything) {
  RockSampler first(10, 4500), second(10, 4500), other(11, 4500);
  int different = 0;
  for (int k = 0; k < 200; ++k) {
    const RockDraw a = first.next(), b = second.next(), c = other.next();
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.shape, b.shape);
    different += a.shape != c.shape || a.size != c.size;
  }
  EXPECT_GT(different, 100);
  RockSampler restored(10, 4500);
  restored.restore(first.state());
  for (int k = 0; k < 200; ++k) {
    const RockDraw a = first.next(), b = restored.next();
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.mass, b.mass);
  }
}

TEST(RockSampler, RefusesBadInput) {
  EXPECT_THROW(RockSampler(1, -5), std::invalid_argument);
  auto sizes = blasted_ore;
  sizes[0].mass_share = 0.5;
  try {
    RockSampler(1, 4500, sizes);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "granular::RockSampler: the mass shares sum to 1.300000; make them sum to 1");
  }
}
