// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The planner against a table that was computed independently (printed to three decimals), its limits and
// closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/loading/strategy/planner.hpp>
#include <numbers>
#include <stdexcept>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double table_slope = 38 * degree, table_volume = 10.7, table_width = 3.2;
constexpr double printed = 5.1e-4;

struct TableEntry {
  double alpha, height, corrected, as_printed;
};
constexpr TableEntry table[] = {{0.2, 0, 1.420, 1.420},   {0.2, 0.5, 0.854, 0.793}, {0.2, 1, 0.563, 0.370},
                                {0.2, 2, 0.318, -0.179},  {0.2, 3, 0.218, -0.575},  {1.0, 0, 3.175, 3.175},
                                {1.0, 0.5, 2.510, 2.480}, {1.0, 1, 2.007, 1.897},   {1.0, 2, 1.364, 0.999},
                                {1.0, 3, 1.003, 0.340},   {2.0, 0, 4.491, 4.491},   {2.0, 0.5, 3.800, 3.779},
                                {2.0, 1, 3.229, 3.148},   {2.0, 2, 2.394, 2.103},   {2.0, 3, 1.851, 1.285}};

// Equation 50 as Lindmark (2016) prints it, h²/θ under the root: only to show that it is another number.
double depth_as_printed(double h, double theta, double area) {
  return -h / theta + std::sqrt(h * h / theta + 2 * area / theta);
}

// A pile whose strips are `toe[j]` m away and rise as a plane at `slope`, over a drift of ny strips.
ColumnModel plane_pile(double half_width, double slope, double (*toe)(double y), double top = 5.0) {
  const ColumnGrid grid{.x_min = 0, .x_max = 20, .half_width = half_width, .cell = 0.25};
  Eigen::MatrixXd heights(grid.nx(), grid.ny());
  for (int j = 0; j < grid.ny(); ++j)
    for (int i = 0; i < grid.nx(); ++i)
      heights(i, j) = std::clamp((grid.x(i) - toe(grid.y(j))) * std::tan(slope), 0.0, top);
  return column_model(heights, grid);
}

double straight(double) { return 10; }
double leaning(double y) { return 10 - 0.5 * y; }

TEST(Planner, DepthTable) {
  for (const TableEntry& entry : table) {
    const double area = entry.alpha * table_volume / table_width;
    EXPECT_NEAR(planned_depth(entry.height, table_slope, area), entry.corrected, printed)
        << "alpha " << entry.alpha << ", h " << entry.height;
    EXPECT_NEAR(depth_as_printed(entry.height, table_slope, area), entry.as_printed, printed);
  }
}

TEST(Planner, DepthGivesTheWantedArea) {
  for (double theta : {1e-8, 0.01, 0.3, 0.7, 1.4})
    for (double h : {0.0, 1e-6, 0.5, 3.0, 50.0})
      for (double area : {0.01, 2.5, 6.7}) {
        const double d = planned_depth(h, theta, area);
        // No cancellation: a few units in the last place at any h.
        EXPECT_NEAR(d * h + 0.5 * theta * d * d, area, 1e-14 * area) << theta << ' ' << h << ' ' << area;
      }
}

TEST(Planner, DepthLimits) {
  EXPECT_EQ(planned_depth(1.5, 0.6, 0), 0);
  EXPECT_EQ(planned_depth(0, 0, 0), 0);
  EXPECT_DOUBLE_EQ(planned_depth(1.5, 0, 3.0), 2.0);
  EXPECT_NEAR(planned_depth(1.5, 1e-12, 3.0), 2.0, 1e-11);  // d' = -d³/(2 A) dθ/... < 2e-12
  EXPECT_DOUBLE_EQ(planned_depth(0, 0.5, 4.0), 4.0);        // √(2A/θ)
}

TEST(Planner, DepthRisesWithAreaAndFallsWithHeightAndSlope) {
  for (double h : {0.0, 0.7, 2.0})
    for (double theta : {0.3, 0.7}) {
      EXPECT_LT(planned_depth(h, theta, 2.0), planned_depth(h, theta, 2.1));
      EXPECT_GT(planned_depth(h, theta, 2.0), planned_depth(h + 0.1, theta, 2.0));
      EXPECT_GT(planned_depth(h, theta, 2.0), planned_depth(h, theta + 0.1, 2.0));
    }
}

TEST(Planner, PlanOfAPlanePile) {
  const ColumnModel model = plane_pile(3.5, 35 * degree, straight);
  const Strategy strategy{.alpha = 0.8, .beta = 0.5, .gamma = 0.5, .kappa = 0.6};
  const PlannerOptions options;
  const Plan plan = plan_trajectory(strategy, model, options);
  ASSERT_TRUE(plan.feasible);
  const Row& row = model.rows[plan.row];
  EXPECT_EQ(plan.slope, row.slope);
  EXPECT_EQ(plan.toe, row.front);
  EXPECT_EQ(plan.y, row.y);
  EXPECT_DOUBLE_EQ(plan.tilt, 0.6 * row.slope);
  EXPECT_DOUBLE_EQ(plan.crest, 5.0);
  const double kinematic =
      1.80 + 2.952 * std::sin(options.boom_max) + 1.868 * std::sin(plan.tilt + options.arm.psi_b);
  EXPECT_NEAR(plan.height_limit, kinematic, 1e-14);
  EXPECT_DOUBLE_EQ(plan.height, 0.5 * plan.height_limit);
  EXPECT_DOUBLE_EQ(plan.area, 0.8 * 8.0 / 3.2);
  EXPECT_DOUBLE_EQ(plan.depth, planned_depth(plan.height, plan.slope, plan.area));
  EXPECT_FALSE(plan.limited);
}

TEST(Planner, HeightIsBoundByTheCrest) {
  const Strategy strategy{.alpha = 1, .beta = 1, .gamma = 0, .kappa = 0};
  EXPECT_DOUBLE_EQ(plan_trajectory(strategy, plane_pile(3.5, 35 * degree, straight, 1.7)).height, 1.7);
}

// Under a roof: at h_max the outline and the tip, turned through the curl in ten thousand steps, just touch it. Between
// two steps a point within 3 m of the pivot rises by less than 3 m (π/2/1e4)²/8 = 1e-8 m over the higher one.
TEST(Planner, HeightLetsTheBucketCurlUnderTheRoof) {
  const ColumnModel model = plane_pile(3.5, 35 * degree, straight);
  const std::vector<Eigen::Vector2d> bucket{{0.8, 1.25}, {1.74, 0.63}, {0.1, -0.4}};
  for (const CurlMode curl : {CurlMode::hinge_G, CurlMode::tip_fixed})
    for (const double kappa : {0.0, 0.3, 0.7, 1.0})
      for (const bool loaded : {false, true}) {
        PlannerOptions options;
        options.roof = 3.0;
        options.curl = curl;
        if (loaded) options.outline = bucket;
        const Plan plan =
            plan_trajectory({.alpha = 1, .beta = 1, .gamma = 0, .kappa = kappa}, model, options);
        const ArmGeometry& arm = options.arm;
        const Eigen::Vector2d tip(arm.GK * std::cos(arm.psi_b), arm.GK * std::sin(arm.psi_b));
        std::vector<Eigen::Vector2d> points = options.outline;
        points.push_back(tip);
        double highest = 0;
        for (int k = 0; k <= 10000; ++k) {
          const double phi = plan.tilt + (options.phi_max - plan.tilt) * k / 10000;
          const double z_G = plan.height - arm.GK * std::sin(plan.tilt + arm.psi_b);
          const Eigen::Rotation2Dd turned(phi);
          for (const Eigen::Vector2d& p : points)
            highest = std::max(highest, curl == CurlMode::hinge_G ? z_G + (turned * p).y()
                                                                  : plan.height + (turned * (p - tip)).y());
        }
        EXPECT_LE(highest, options.roof + 1e-12) << kappa << loaded;
        EXPECT_GT(highest, options.roof - 2e-8) << kappa << loaded;
      }
}

// With the toe at 10 - y/2, the pile protrudes most at the largest y.
TEST(Planner, GammaGoesFromTheWallToTheProtrudingPlace) {
  const ColumnModel model = plane_pile(3.5, 35 * degree, leaning);
  ASSERT_GE(model.rows.size(), 5u);
  const auto place = [&](double gamma) {
    return plan_trajectory({.alpha = 1, .beta = 0.5, .gamma = gamma, .kappa = 0}, model).y;
  };
  EXPECT_EQ(place(0), model.rows.front().y);
  EXPECT_EQ(place(1), model.rows.back().y);
  EXPECT_EQ(row_for(0.5, model), static_cast<int>(std::lround(0.5 * (model.rows.size() - 1.0))));
  // As straight as the place is fine: half a pitch.
  const double first = model.rows.front().y, breadth = model.rows.back().y - first;
  for (int k = 0; k <= 100; ++k)
    EXPECT_NEAR(place(0.01 * k), first + 0.01 * k * breadth, 0.5 * model.options.row_pitch + 1e-12) << k;
}

TEST(Planner, CornersFollowTheStages) {
  const ColumnModel model = plane_pile(3.5, 35 * degree, straight);
  PlannerOptions options;
  const Plan plan = plan_trajectory({.alpha = 1, .beta = 0.4, .gamma = 0, .kappa = 0.5}, model, options);
  const auto& [A, B, C, D, E] = plan.corners;
  EXPECT_DOUBLE_EQ(A.x, plan.toe - 2.0);
  EXPECT_DOUBLE_EQ(B.x, plan.toe + plan.depth);
  EXPECT_NEAR(std::atan2(C.z - B.z, C.x - B.x), plan.slope, 1e-15);
  EXPECT_DOUBLE_EQ(C.phi, plan.tilt);
  EXPECT_DOUBLE_EQ(D.phi, plan.phi_max);
  // About hinge G: K keeps its distance from it.
  const auto hinge = [&](const TipPose& tip) {
    const double b = tip.phi + options.arm.psi_b;
    return Eigen::Vector2d(tip.x - options.arm.GK * std::cos(b), tip.z - options.arm.GK * std::sin(b));
  };
  EXPECT_NEAR((hinge(C) - hinge(D)).norm(), 0, 1e-14);
  const std::vector<TipPose> path = planned_path(plan, options.arm, 10);
  ASSERT_EQ(path.size(), 14u);  // A, B, C, nine within the arc, D, E
  for (std::size_t k = 3; k < 12; ++k) EXPECT_NEAR((hinge(path[k]) - hinge(C)).norm(), 0, 1e-14);
  EXPECT_DOUBLE_EQ(E.x, A.x);
  EXPECT_DOUBLE_EQ(E.z, D.z);
  options.curl = CurlMode::tip_fixed;
  const Plan fixed = plan_trajectory({.alpha = 1, .beta = 0.4, .gamma = 0, .kappa = 0.5}, model, options);
  EXPECT_EQ(fixed.corners[3].x, fixed.corners[2].x);
  EXPECT_EQ(fixed.corners[3].z, fixed.corners[2].z);
}

TEST(Planner, BetaZeroLeavesStageTwoOut) {
  const ColumnModel model = plane_pile(3.5, 35 * degree, straight);
  const Plan plan = plan_trajectory({.alpha = 1, .beta = 0, .gamma = 0, .kappa = 1}, model);
  EXPECT_EQ(plan.height, 0);
  EXPECT_EQ(plan.corners[1].x, plan.corners[2].x);
  EXPECT_DOUBLE_EQ(plan.depth, std::sqrt(2 * plan.area / plan.slope));
}

TEST(Planner, StaysBeforeTheWall) {
  const ColumnModel model = plane_pile(3.5, 35 * degree, straight);
  PlannerOptions options;
  const Strategy strategy{.alpha = 2, .beta = 0.5, .gamma = 0, .kappa = 0};
  const Plan free = plan_trajectory(strategy, model, options);
  options.x_limit = free.corners[2].x - 0.5;
  const Plan shorter = plan_trajectory(strategy, model, options);
  EXPECT_TRUE(shorter.limited);
  EXPECT_NEAR(shorter.depth, free.depth - 0.5, 1e-12);
  EXPECT_EQ(shorter.height, free.height);
  options.x_limit = free.toe + 0.3;
  const Plan lower = plan_trajectory(strategy, model, options);
  EXPECT_EQ(lower.depth, 0);
  EXPECT_NEAR(lower.corners[2].x, options.x_limit, 1e-12);
}

TEST(Planner, AnEmptyDriftIsNoPlan) {
  const ColumnGrid grid;
  const ColumnModel model = column_model(Eigen::MatrixXd::Zero(grid.nx(), grid.ny()), grid);
  const Plan plan = plan_trajectory({}, model);
  EXPECT_FALSE(plan.feasible);
  EXPECT_NE(plan.message.find("pile"), std::string::npos);
}

TEST(Planner, BadStrategiesAreNamed) {
  const auto text = [](const Strategy& strategy) -> std::string {
    try {
      check(strategy);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(text({}), "");
  EXPECT_EQ(
      text({.alpha = -0.1}),
      "loading::Strategy: alpha [1] is -0.100000; give a finite value of at least 0 (studied: 0.2 to 2)");
  EXPECT_EQ(text({.beta = 1.5}), "loading::Strategy: beta [1] is 1.500000; give 0 to 1");
  EXPECT_NE(text({.gamma = std::nan("")}).find("gamma"), std::string::npos);
  EXPECT_NE(text({.kappa = -1}).find("kappa"), std::string::npos);
}

}  // namespace
