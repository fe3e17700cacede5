// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Laws of the planned runs: the same arguments give the same plan, a grown design stays as Latin as it can,
/// no two runs share a seed.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/run/plan.h>
#include <drawpoint/studies/run/settings.h>

#include <set>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

using test::complaint;

int stratum(double value, const doe::Variable& axis, int strata) {
  return std::min(strata - 1, static_cast<int>((value - axis.lower) / (axis.upper - axis.lower) * strata));
}

Eigen::MatrixXd stacked(const Eigen::MatrixXd& above, const Eigen::MatrixXd& below) {
  Eigen::MatrixXd all(above.rows() + below.rows(), above.cols());
  all << above, below;
  return all;
}

TEST(Plan, CornersComeWithEnoughRuns) {
  EXPECT_FALSE(has_corners(test::two_by_two(), 9));
  EXPECT_TRUE(has_corners(test::two_by_two(), 10));
}

/// With n points in all, each new point is alone in its stratum of width 1/n on every axis, whatever the
/// sizes.
TEST(Plan, NewPointsShareNoStratumWithAnyPoint) {
  for (const bool corners : {false, true}) {
    for (const auto& [before, after] :
         {std::pair(5, 6), std::pair(8, 16), std::pair(10, 37), std::pair(40, 41)}) {
      const Identity identity = test::identity(corners);
      const Eigen::MatrixXd old_points = first_design(identity, before);
      const Eigen::MatrixXd new_points = further_design(identity, old_points, after);
      ASSERT_EQ(new_points.rows(), after - before);
      const int skipped = corners ? 4 : 0;
      const Eigen::MatrixXd all = stacked(old_points.bottomRows(before - skipped), new_points);
      for (int k = 0; k < 2; ++k) {
        const auto& axis = identity.problem.variables[static_cast<std::size_t>(k)];
        std::multiset<int> strata;
        for (int i = 0; i < all.rows(); ++i) strata.insert(stratum(all(i, k), axis, after - skipped));
        for (int i = 0; i < new_points.rows(); ++i) {
          EXPECT_EQ(strata.count(stratum(new_points(i, k), axis, after - skipped)), 1u)
              << before << " to " << after << ", axis " << k << ", new point " << i << ", corners "
              << corners;
          EXPECT_GE(new_points(i, k), axis.lower);
          EXPECT_LE(new_points(i, k), axis.upper);
        }
      }
    }
  }
}

TEST(Plan, DoublingGivesAFullLatinHypercubeWherePossible) {
  // n points in strata of width 1/n fill exactly n of the 2n strata of width 1/(2n): the other n are free.
  const Identity identity = test::identity();
  const Eigen::MatrixXd old_points = first_design(identity, 20);
  const Eigen::MatrixXd all = stacked(old_points, further_design(identity, old_points, 40));
  for (int k = 0; k < 2; ++k) {
    std::set<int> strata;
    for (int i = 0; i < 40; ++i)
      strata.insert(stratum(all(i, k), identity.problem.variables[static_cast<std::size_t>(k)], 40));
    EXPECT_EQ(strata.size(), 40u);
  }
}

TEST(Plan, IsAFunctionOfItsArguments) {
  const auto once = runs_to_add(test::identity(), {}, 12, 5);
  const auto twice = runs_to_add(test::identity(), {}, 12, 5);
  ASSERT_EQ(once.size(), 17u);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].x, twice[i].x);
    EXPECT_EQ(once[i].seed, twice[i].seed);
    EXPECT_EQ(once[i].id, static_cast<std::int64_t>(i + 1));
  }
  Identity other = test::identity();
  other.seed = 2;
  EXPECT_NE(runs_to_add(other, {}, 12, 5)[0].x, once[0].x);
}

TEST(Plan, GrowsWithoutTouchingWhatIsThere) {
  const Identity identity = test::identity(false, 2);
  std::vector<studies::Run> runs = runs_to_add(identity, {}, 6, 3);
  EXPECT_EQ(runs.size(), 6u * 2u + 3u);
  EXPECT_TRUE(runs_to_add(identity, runs, 6, 3).empty());
  const auto added = runs_to_add(identity, runs, 10, 4);
  ASSERT_EQ(added.size(), 4u * 2u + 1u);
  EXPECT_EQ(added.front().id, 16);
  EXPECT_EQ(added.front().point, 7);
  EXPECT_EQ(added.back().point, 4);
  runs.insert(runs.end(), added.begin(), added.end());
  std::set<doe::Seed> seeds;
  for (const auto& run : runs) seeds.insert(run.seed);
  EXPECT_EQ(seeds.size(), runs.size());
  EXPECT_EQ(count_points(runs, Kind::training), 10);
  EXPECT_EQ(count_points(runs, Kind::validation), 4);
}

TEST(Plan, DoesNotShrink) {
  const auto runs = runs_to_add(test::identity(), {}, 6, 3);
  EXPECT_THROW(runs_to_add(test::identity(), runs, 5, 3), UsageError);
  EXPECT_EQ(complaint([&] { runs_to_add(test::identity(), runs, 6, 2); }),
            "--validation 2: the output folder already holds 3 validation points, and a study grows but does "
            "not shrink; "
            "use --validation 3 or more, or choose another folder with --out");
}

}  // namespace
