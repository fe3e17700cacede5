// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/tests/support/mass_ratio_table.hpp>
#include <drawpoint/tests/support/pile_world.hpp>
#include <drawpoint/tests/support/rock_pairs.hpp>

using namespace drawpoint;
using namespace drawpoint::support;

namespace {

constexpr double round_off = 1e-12;  // lengths of order 1, some hundred operations of 1e-16

// A scene of cubes with an edge of 1 m and a mass of 4500 kg in the pile's box.
RockPile cubes(const std::vector<Vector3d>& centres) {
  RockPile pile = rock_pile(1);
  const auto hull = engine::box({0.5, 0.5, 0.5});
  pile.hulls = {{hull, 4500, Vector3d::Constant(750)}};
  pile.rocks.clear();
  for (const Vector3d& centre : centres)
    pile.rocks.push_back({0, Eigen::Isometry3d(Eigen::Translation3d(centre))});
  return pile;
}

std::vector<RockState> starts(const RockPile& pile) {
  std::vector<RockState> states;
  for (const PileRock& rock : pile.rocks) states.push_back({rock.start});
  return states;
}

}  // namespace

TEST(PenetrationDepth, OfTwoBoxesAlongAFaceAndAcrossTwoEdges) {
  const auto cube = engine::box({0.5, 0.5, 0.5});
  const PlacedHull a(cube, pose_at({0, 0, 0}));
  EXPECT_NEAR(penetration_depth(a, {cube, pose_at({0.2, 0.1, 0.97})}), 0.03, round_off);
  EXPECT_EQ(penetration_depth(a, {cube, pose_at({0, 0, 1.001})}), 0);
  // Turned by 45° about y and about x, both show an edge; crossed at right angles they are √½ + √½ high.
  const PlacedHull lower(
      cube, pose_at({0, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 4, Vector3d::UnitY()))));
  const PlacedHull upper(cube, pose_at({0, 0, std::sqrt(2) - 0.02},
                                       Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 4, Vector3d::UnitX()))));
  EXPECT_NEAR(penetration_depth(lower, upper), 0.02, round_off);
}

TEST(PenetrationDepth, EqualsTheUnprunedTestOnRocks) {
  std::mt19937 rng(5);
  int touching = 0;
  for (int k = 0; k < 300; ++k) {
    const RockPair pair = random_rock_pair(rng);
    const Eigen::Isometry3d here = Eigen::Isometry3d::Identity();
    const double exact = std::max(0.0, -best_separation(pair.a, pair.b));
    EXPECT_NEAR(penetration_depth({pair.a, here}, {pair.b, here}), exact, round_off);
    touching += exact > 0;
  }
  EXPECT_GT(touching, 50);  // the pairs' extents overlap by up to 60 mm in five cases of six
  EXPECT_LT(touching, 300);
}

TEST(PileMeasures, OverlapIsOverTheSmallerRockAndOverTouchingPairs) {
  RockPile pile = cubes({{0, 0, 0.5}, {0, 0, 1.4}, {2, 0, 0.5}, {2, 2, 0.5}});
  pile.hulls.push_back({engine::box({0.25, 0.25, 0.25}), 562.5, Vector3d::Constant(23)});
  pile.rocks.push_back({1, Eigen::Isometry3d(Eigen::Translation3d(2, 0, 1.2))});
  const OverlapStatistics s = rock_overlaps(pile, starts(pile));
  // 0.1 m of a cube with the diagonal √3 m, 0.05 m of one with √3/2 m.
  EXPECT_EQ(s.pairs, 2);
  EXPECT_NEAR(s.max, 0.1 / std::sqrt(3), round_off);
  EXPECT_NEAR(s.mean, 0.1 / std::sqrt(3), round_off);
}

TEST(PileMeasures, PercentileIsTheNearestRank) {
  std::vector<double> values;
  for (int k = 200; k >= 1; --k) values.push_back(k);
  const OverlapStatistics s = overlap_statistics(values);
  EXPECT_EQ(s.p99, 198);
  EXPECT_EQ(s.max, 200);
  EXPECT_EQ(s.mean, 100.5);
  EXPECT_EQ(overlap_statistics({3}).p99, 3);
  EXPECT_EQ(overlap_statistics({}).pairs, 0);
}

TEST(PileMeasures, WallsAndBlade) {
  const RockPile pile = cubes({{0, 0, 0.48}, {3.03, 0, 1.5}, {-1.47, 1.9, 1.5}});
  const OverlapStatistics walls = wall_overlaps(pile, starts(pile));
  EXPECT_EQ(walls.pairs, 2);
  EXPECT_NEAR(walls.max, 0.03 / std::sqrt(3), round_off);
  // The blade ends at x = -1.95 and y = 1.5: the third cube reaches 0.02 m into it along x, 0.1 m along y.
  const OverlapStatistics blade = blade_overlaps(pile, starts(pile), pile.blade.start);
  EXPECT_EQ(blade.pairs, 1);
  EXPECT_NEAR(blade.max, 0.02 / std::sqrt(3), round_off);
}

TEST(PileMeasures, DriftEnergyAndHash) {
  const RockPile pile = cubes({{0, 0, 0.5}, {2, 0, 0.5}});
  const auto before = starts(pile);
  auto after = before;
  after[1].pose.translation().y() += 0.004;
  EXPECT_NEAR(drift(before, after, 2).mean, 0.001, round_off);
  EXPECT_EQ(drift({before[0], before[0], before[1]}, {after[0], after[0], after[1]}, 2).median, 0);
  EXPECT_NEAR(drift(before, after, 2).worst, 0.002, round_off);
  std::vector<RockState> still(200, before[0]), two_moved = still;
  for (const int k : {7, 150}) two_moved[static_cast<std::size_t>(k)].pose.translation().y() += 0.001 * k;
  EXPECT_EQ(drift(still, two_moved, 1).p99, 0);  // 198 of 200 stand
  two_moved[99].pose.translation().y() += 0.001;
  EXPECT_NEAR(drift(still, two_moved, 1).p99, 0.001, round_off);
  EXPECT_EQ(kinetic_energy_per_rock(pile, after), 0);
  after[0].velocity = {0, 2, 0};
  after[0].angular_velocity = {0, 0, 3};
  EXPECT_NEAR(kinetic_energy_per_rock(pile, after), (0.5 * 4500 * 4 + 0.5 * 750 * 9) / 2, 1e-8);
  EXPECT_NE(state_hash(before), state_hash(after));
  EXPECT_THROW(drift(before, {}, 2), std::invalid_argument);
  EXPECT_THROW(drift(before, after, 0), std::invalid_argument);
}

TEST(MassRatioTable, HasTheMassesAndTheHeightOfItsDescription) {
  const MassRatioTable table = mass_ratio_table(1000);
  std::array<Eigen::Isometry3d, 5> poses;
  for (int k = 0; k < 5; ++k) poses[k] = pose_at(table.cubes[k].start);
  EXPECT_NEAR(table_height(poses), 0.32, round_off);
  EXPECT_LT(table_overlap(table, poses), round_off);
  EXPECT_NEAR(table.cubes[4].mass, 4500 * 8, 1e-8);  // equal density at 1000:1
  poses[4].translation().z() -= 0.002;
  EXPECT_NEAR(table_overlap(table, poses), 0.01, round_off);
  poses[0].translation().z() -= 0.004;
  EXPECT_NEAR(table_overlap(table, poses), 0.02, round_off);  // now it is the floor
  EXPECT_THROW(mass_ratio_table(0), std::invalid_argument);
}

// Without friction the blade is the only thing that pushes a cube along x, so the impulse that it reports is
// the cube's momentum: to round-off with the sequential method. The batched one keeps velocities in single
// precision: an iteration rounds the cube's by 2^-24, and the impact takes some 16 · 50 of them at random,
// √800 · 6e-8 = 1.7e-6; three times that. The blade itself keeps its way whatever it pushes.
TEST(PileWorld, BladeReportsTheMomentumThatItGives) {
  using engine::Method;
  for (const auto& [method, tolerance] :
       {std::pair(Method::sequential, 1e-9), std::pair(Method::batched, 5e-6)}) {
    RockPile pile = cubes({{-1.4, 0, 0.5}});
    pile.material.friction = pile.material.rolling = pile.material.spinning = 0;
    engine::WorldOptions options;
    options.solver.method = method;
    PileWorld world(pile, options);
    world.dig();
    const double h = options.step;
    double impulse = 0;
    int steps = 0;
    for (; steps * h < 0.5; ++steps) {
      world.world().step();
      impulse -= h * world.blade().contact_wrench().force.x();
    }
    const RockState cube = world.states()[0];
    EXPECT_NEAR(impulse, 4500 * cube.velocity.x(), tolerance * 4500 * 1.5) << to_string(method);
    EXPECT_GT(cube.velocity.x(), 1.5 - 1e-6);
    EXPECT_NEAR(world.blade().part_pose(0).translation().x(), -2 + 1.5 * steps * h, round_off);
  }
}
