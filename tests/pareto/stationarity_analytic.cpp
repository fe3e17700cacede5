// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/pareto/stationarity.hpp>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

// A least-squares solution of at most five unknowns and numbers about 1: some ten roundings of 1e-16.
constexpr double rounding = 1e-14;

const Eigen::MatrixXd none(0, 2);

Eigen::MatrixXd rows(std::initializer_list<Eigen::RowVector2d> list) {
  Eigen::MatrixXd G(static_cast<Eigen::Index>(list.size()), 2);
  Eigen::Index i = 0;
  for (const auto& row : list) G.row(i++) = row;
  return G;
}

// The shortest vector of the hull of (1,0) and (0,1) is (1/2, 1/2); of (1,0) and (-2,0) it is 0, two thirds
// of the first and one of the second; of one gradient it is that gradient.
TEST(Stationarity, IsTheShortestCombinationOfTheGradients) {
  const Stationarity corner = stationarity(rows({{1, 0}, {0, 1}}), none);
  EXPECT_NEAR(corner.residual, std::sqrt(0.5), rounding);
  EXPECT_NEAR(corner.weights[0], 0.5, rounding);
  const Stationarity opposed = stationarity(rows({{1, 0}, {-2, 0}}), none);
  EXPECT_NEAR(opposed.residual, 0.0, rounding);
  EXPECT_NEAR(opposed.weights[0], 2.0 / 3.0, rounding);
  EXPECT_NEAR(stationarity(rows({{3, -4}}), none).residual, 1.0, rounding);
}

// At the lower corner nothing can fall further: gradient (1,1) is held by both bounds, (1,-1) by the first
// only, which leaves the second component, 1 of the length √2. A constraint of gradient (0,2) takes that over
// with the multiplier 1/2.
TEST(Stationarity, ActiveConstraintsHoldWhatPointsAtThem) {
  const Eigen::MatrixXd corner = rows({{-1, 0}, {0, -1}});
  EXPECT_NEAR(stationarity(rows({{1, 1}}), corner).residual, 0.0, rounding);
  EXPECT_NEAR(stationarity(rows({{1, -1}}), corner).residual, std::sqrt(0.5), rounding);
  const Stationarity held = stationarity(rows({{1, -1}}), rows({{-1, 0}, {0, 2}}));
  EXPECT_NEAR(held.residual, 0.0, rounding);
  EXPECT_NEAR(held.multipliers[0], 1.0, rounding);
  EXPECT_NEAR(held.multipliers[1], 0.5, rounding);
}

// No combination of a grid of weights is shorter than the one found, and the one found is a combination. On a
// grid of 1/200 the best is at most ‖G‖·√2/200 longer.
TEST(Stationarity, NoWeightsDoBetter) {
  doe::RandomStream random(20261121);
  for (int repeat = 0; repeat < 50; ++repeat) {
    Eigen::MatrixXd G(3, 4);
    for (double& g : G.reshaped()) g = random.normal();
    const Stationarity found = stationarity(G, Eigen::MatrixXd(0, 4));
    const double scale = G.rowwise().norm().maxCoeff();
    double best = INFINITY;
    for (int a = 0; a <= 200; ++a)
      for (int b = 0; a + b <= 200; ++b)
        best = std::min(best, (Eigen::RowVector3d(a, b, 200 - a - b) / 200.0 * G).norm() / scale);
    EXPECT_LE(found.residual, best + rounding);
    EXPECT_GE(found.residual, best - G.norm() * std::sqrt(2.0) / 200.0 / scale);
    EXPECT_NEAR((found.weights.transpose() * G).norm() / scale, found.residual, rounding);
    EXPECT_NEAR(found.weights.sum(), 1.0, rounding);
    EXPECT_GE(found.weights.minCoeff(), 0.0);
  }
}

}  // namespace
