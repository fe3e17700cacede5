// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The column model of piles made of boxes, whose columns are known exactly, and of height fields with closed
// forms.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/strategy/column_model.hpp>
#include <numbers>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

using Eigen::Vector3d;
using engine::ConvexPolyhedron;

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

const ColumnGrid small{.x_min = 0, .x_max = 10, .half_width = 2, .cell = 0.25};
// One strip is 0.25 m, the bucket four strips wide; a strip's quota is 1.6 * 0.25 / 1.0 = 0.4 m³.
const ColumnOptions narrow{.h_tol = 0.1,
                           .n_run = 3,
                           .bucket_width = 1.0,
                           .bucket_volume = 1.6,
                           .side_clearance = 0,
                           .row_pitch = 0.25};

TEST(ColumnModel, IndicesAndCentres) {
  EXPECT_EQ(small.nx(), 40);
  EXPECT_EQ(small.ny(), 16);
  EXPECT_DOUBLE_EQ(small.x(0), 0.125);
  EXPECT_DOUBLE_EQ(small.y(0), -1.875);
  EXPECT_DOUBLE_EQ(small.y(15), 1.875);
}

TEST(ColumnModel, HeightsOfABox) {
  const ConvexPolyhedron box = engine::box({0.5, 0.5, 0.5});
  const PosedRock rock{&box, at(5, 0, 0.5), 100};
  const ColumnModel model = column_model(std::span(&rock, 1), small, narrow);
  for (int i = 0; i < small.nx(); ++i)
    for (int j = 0; j < small.ny(); ++j) {
      const bool over = std::abs(small.x(i) - 5) < 0.5 && std::abs(small.y(j)) < 0.5;
      // The far faces lie on column borders: their vertices belong to the next column as well.
      const bool vertex = (i == 22 || j == 10) && !over;
      if (vertex) continue;
      EXPECT_NEAR(model.heights(i, j), over ? 1.0 : 0.0, 1e-15) << i << ' ' << j;
    }
}

// A box turned by 30 deg about y: over a centre x, its top is the upper one of two planes.
TEST(ColumnModel, HeightsOfATurnedBox) {
  const double turn = std::numbers::pi / 6, c = std::cos(turn), s = std::sin(turn);
  const ConvexPolyhedron box = engine::box({0.8, 0.6, 0.3});
  PosedRock rock{&box, at(5.03, 0.01, 2), 100};
  rock.pose.rotate(Eigen::AngleAxisd(turn, Vector3d::UnitY()));
  const ColumnModel model = column_model(std::span(&rock, 1), small, narrow);
  const double corner = 0.8 * c + 0.3 * s;  // forward end of the upper face, relative to the centre
  const double peak = -0.8 * c + 0.3 * s;   // its back end is the peak
  int checked = 0;
  for (int i = 0; i < small.nx(); ++i) {
    const double u = small.x(i) - 5.03;
    if (u < peak + 0.13 || u > corner - 0.13)
      continue;  // columns with vertices are higher than their centres
    EXPECT_NEAR(model.heights(i, 8), 2 + 0.3 / c - u * s / c, 1e-13);
    ++checked;
  }
  EXPECT_GE(checked, 4);
}

// Columns that only a vertex reaches get the vertex.
TEST(ColumnModel, VerticesCountWhereNoCentreIsCovered) {
  const ConvexPolyhedron pebble = engine::box({0.05, 0.05, 0.05});
  const PosedRock rock{&pebble, at(5.06, 0.06, 0.05), 1};
  const ColumnModel model = column_model(std::span(&rock, 1), small, narrow);
  EXPECT_NEAR(model.heights(20, 8), 0.1, 1e-15);
  EXPECT_EQ((model.heights.array() > 0).count(), 1);
}

// A block of height 1 from x = 6 on: front 6, quota 0.4 m³ = 6.4 columns of 0.0625 m³, so 7 columns, centre 6
// + 7/2 columns.
TEST(ColumnModel, FrontCentreAndSlopeOfABlock) {
  Eigen::MatrixXd heights = Eigen::MatrixXd::Zero(small.nx(), small.ny());
  heights.bottomRows(16).setOnes();
  const ColumnModel model = column_model(heights, small, narrow);
  for (const Strip& strip : model.strips) {
    EXPECT_TRUE(strip.has_pile && strip.meets_quota);
    EXPECT_EQ(strip.front_column, 24);
    EXPECT_DOUBLE_EQ(strip.front, 6.0);
    EXPECT_NEAR(strip.volume_centre, 6.875, 1e-13);
    EXPECT_NEAR(strip.slope, std::atan(1.0 / 0.875), 1e-13);
  }
  ASSERT_EQ(model.rows.size(), 13u);
  EXPECT_DOUBLE_EQ(model.rows.front().y, -1.5);
  EXPECT_DOUBLE_EQ(model.rows.back().y, 1.5);
  EXPECT_DOUBLE_EQ(model.rows[4].crest, 1.0);
}

// Two strips: the mean of the row's strips, each with its own front.
TEST(ColumnModel, RowsAreMeansOverTheBucketsStrips) {
  Eigen::MatrixXd heights = Eigen::MatrixXd::Zero(small.nx(), small.ny());
  heights.bottomRows(16).setOnes();
  heights.block(20, 8, 4, 8).setOnes();  // the left half protrudes by 1 m
  const ColumnModel model = column_model(heights, small, narrow);
  const Row& middle = model.rows[6];  // strips 6 to 9
  EXPECT_DOUBLE_EQ(middle.y, 0);
  EXPECT_DOUBLE_EQ(middle.front, 5.5);
  EXPECT_NEAR(middle.volume_centre, 6.375, 1e-13);
  const std::vector<double> z = contour(model, middle);
  EXPECT_DOUBLE_EQ(z[19], 0);
  EXPECT_DOUBLE_EQ(z[20], 0.5);
  EXPECT_DOUBLE_EQ(z[24], 1);
}

// Between the strips' pitch a row covers shares of them: before a step of the pile's front by 1 m at y = 0 the
// bucket, 1 m wide, has 0.5 + y of its breadth on the protruding side.
TEST(ColumnModel, RowsFollowTheBucketContinuously) {
  Eigen::MatrixXd heights = Eigen::MatrixXd::Zero(small.nx(), small.ny());
  heights.bottomRows(16).setOnes();
  heights.block(20, 8, 4, 8).setOnes();
  ColumnOptions options = narrow;
  options.row_pitch = 0.01;
  const ColumnModel model = column_model(heights, small, options);
  ASSERT_EQ(model.rows.size(), 301u);
  for (const Row& row : model.rows) {
    const double share = std::clamp(0.5 + row.y, 0.0, 1.0);
    EXPECT_NEAR(row.front, 6 - share, 1e-12) << row.y;
    EXPECT_NEAR(contour(model, row)[20], share, 1e-12) << row.y;
  }
}

TEST(ColumnModel, AStripShortOfItsQuotaUsesAllItHas) {
  Eigen::MatrixXd heights = Eigen::MatrixXd::Zero(small.nx(), small.ny());
  heights.bottomRows(4).setOnes();  // 0.25 m³ a strip, quota 0.4
  const ColumnModel model = column_model(heights, small, narrow);
  EXPECT_FALSE(model.strips[0].meets_quota);
  EXPECT_NEAR(model.strips[0].volume_centre, 9.5, 1e-13);
}

// A plane of slope θ from the toe: the chord of the columns tends to θ as they get finer, with an error of
// the order of (w + h_tol / tan θ) / (VC − f). Here VC − f ≈ 3.2 m, w = 0.05, h_tol = 0.02: less than 0.08 of
// tan θ.
TEST(ColumnModel, ChordOfAPlane) {
  const ColumnGrid fine{.x_min = 0, .x_max = 20, .half_width = 2, .cell = 0.05};
  const double slope = 38 * std::numbers::pi / 180;
  Eigen::MatrixXd heights(fine.nx(), fine.ny());
  for (int i = 0; i < fine.nx(); ++i)
    heights.row(i).setConstant(std::max(0.0, (fine.x(i) - 8) * std::tan(slope)));
  const ColumnModel model =
      column_model(heights, fine, {.h_tol = 0.02, .n_run = 3, .bucket_width = 1.0, .bucket_volume = 9.0});
  const Strip& strip = model.strips[10];
  EXPECT_NEAR(std::tan(strip.slope), std::tan(slope), 0.08 * std::tan(slope));
  // Mass of a triangle of area A = 9 m²: length L = √(2A / tan θ), centroid at 2L/3 from the toe; a column's
  // width of error.
  EXPECT_NEAR(strip.volume_centre, 8 + 2.0 / 3 * std::sqrt(18 / std::tan(slope)), 0.05);
}

TEST(ColumnModel, RocksOnTheFloorAreNotThePile) {
  const ConvexPolyhedron block = engine::box({1.0, 2.0, 0.5}), stray = engine::box({0.4, 0.2, 0.2});
  const std::vector<PosedRock> rocks{{&block, at(9, 0, 0.5), 18000},
                                     {&stray, at(4, 0, 0.2), 500},
                                     {&stray, at(6, -1, 0.2), 300},
                                     {&stray, at(8.5, 1, 1.2), 700}};
  const ColumnModel model = column_model(rocks, small, narrow);
  for (const Strip& strip : model.strips) EXPECT_DOUBLE_EQ(strip.front, 8.0);
  EXPECT_GT(model.heights(16, 8), 0.39);
  EXPECT_EQ(model.body(16, 8), 0);
  double mass = 0;
  for (const PosedRock& rock : rocks)
    if (lies_in_front(model, rock.pose.translation())) mass += rock.mass;
  EXPECT_DOUBLE_EQ(mass, 800);
}

// The front needs a run: a single high column that hangs together with the pile is passed over.
TEST(ColumnModel, AFrontIsARunOfColumns) {
  Eigen::MatrixXd heights = Eigen::MatrixXd::Zero(small.nx(), small.ny());
  heights.bottomRows(16).setOnes();
  heights.block(22, 5, 2, 1).setOnes();
  heights(19, 5) = 1;
  heights.block(19, 4, 5, 1).setOnes();  // connects (19, 5)
  heights(21, 5) = 0;
  const ColumnModel model = column_model(heights, small, narrow);
  EXPECT_EQ(model.strips[5].front_column, 22);
  EXPECT_EQ(model.strips[4].front_column, 19);
}

TEST(ColumnModel, RowsStayClearOfTheSideWalls) {
  Eigen::MatrixXd heights = Eigen::MatrixXd::Ones(small.nx(), small.ny());
  ColumnOptions options = narrow;
  options.side_clearance = 0.3;
  const ColumnModel model = column_model(heights, small, options);
  ASSERT_FALSE(model.rows.empty());
  for (const Row& row : model.rows) EXPECT_LE(std::abs(row.y) + 0.5 + 0.3, 2.0 + 1e-9);
  EXPECT_EQ(model.rows.size(), 10u);  // |y| ≤ 1.2 on a pitch of 0.25: -1.125 to 1.125
  options.bucket_width = 4.2;
  EXPECT_TRUE(column_model(heights, small, options).rows.empty());
}

TEST(ColumnModel, BadInputIsNamed) {
  EXPECT_THROW(column_model(Eigen::MatrixXd::Zero(3, 3), small, narrow), std::invalid_argument);
  const PosedRock nothing;
  EXPECT_THROW(column_model(std::span(&nothing, 1), small, narrow), std::invalid_argument);
  ColumnGrid bad = small;
  bad.cell = -0.25;
  try {
    column_model(std::span<const PosedRock>(), bad, narrow);
    FAIL() << "a negative cell was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "loading::column_model: grid.cell [m] is -0.250000; give a finite value above 0");
  }
}

}  // namespace
