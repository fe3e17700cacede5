// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Fronts of formulas whose Pareto sets are known, finished. Fronts of models: tests/studies/front_analytic.cpp.

#include <gtest/gtest.h>

#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/polished_front.hpp>
#include <drawpoint/tests/doe/problems.hpp>

#include <algorithm>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

/// |x - a|² and |x - b|², minimised: the Pareto set is the segment from a to b.
const Eigen::Vector3d a(0.2, 0.3, 0.5), b(0.8, 0.6, 0.4);

doe::Outcome distances(const Eigen::VectorXd& x) { return {(x - a).squaredNorm(), (x - b).squaredNorm()}; }

doe::ValueAndJacobian smooth_distances(const Eigen::VectorXd& x) {
  doe::ValueAndJacobian y{distances(x).values(), Eigen::MatrixXd(2, 3)};
  y.jacobian.row(0) = 2.0 * (x - a).transpose();
  y.jacobian.row(1) = 2.0 * (x - b).transpose();
  return y;
}

double distance_to_segment(const Eigen::Vector3d& x) {
  const double along = (x - a).dot(b - a) / (b - a).squaredNorm();
  return (x - a - std::clamp(along, 0.0, 1.0) * (b - a)).norm();
}

PolishedFront finished(const doe::Problem& problem) {
  const Front searched =
      nsga2(distances, problem, {.search = {.population = 40, .stopping = {.generations = 40}}});
  return polished_front(smooth_distances, problem, searched);
}

// A residual of at most r bounds the distance by 2 r: the derivation stands at Front.CertifiedPointsLieOnTheKnownSet.
// The problem is convex: every point arrives.
TEST(PolishedFront, LiesOnTheKnownSet) {
  const PolishedFront found = finished(support::unit_problem(3, 2));
  ASSERT_GE(found.front.X.rows(), 30);
  EXPECT_EQ(found.polishing.certified(), found.front.X.rows());
  EXPECT_GT(found.polishing.gain, 0.0);
  EXPECT_EQ(found.status, PolishedFrontStatus::completed);
  EXPECT_EQ(found.message, "");
  for (Eigen::Index i = 0; i < found.front.X.rows(); ++i)
    EXPECT_LE(distance_to_segment(found.front.X.row(i).transpose()), 2.0 * certified_residual);
  EXPECT_TRUE(std::is_sorted(found.front.Y.col(0).begin(), found.front.Y.col(0).end()));
}

TEST(PolishedFront, WhatCannotBePolishedStaysAsItIsAndSaysWhy) {
  doe::Problem problem = support::unit_problem(3, 2);
  problem.variables[1] = doe::integer_variable("teeth", "1", 0, 4);
  const PolishedFront found = finished(problem);
  EXPECT_EQ(found.status, PolishedFrontStatus::not_polished);
  EXPECT_EQ(found.message, "variable \"teeth\" is integer, and polishing follows gradients");
  EXPECT_EQ(found.polishing.residual.size(), 0);
  const PolishedFront none = polished_front(smooth_distances, problem, Front{});
  EXPECT_EQ(none.front.X.rows(), 0);
  EXPECT_EQ(to_string(none.status), "empty_front");
  EXPECT_EQ(none.message, "the front has no points");
}

}  // namespace
