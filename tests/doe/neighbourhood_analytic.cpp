// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/detail/neighbourhood.hpp>
#include <drawpoint/doe/detail/nonlinearity.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <numbers>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

// Sums of at most 12 norms of numbers near 1, each right to a few units of the last digit.
constexpr double rounding = 1e-14;

Eigen::MatrixXd cross_polytope(Eigen::Index d, double radius) {
  Eigen::MatrixXd P(2 * d, d);
  P << radius * Eigen::MatrixXd::Identity(d, d), -radius * Eigen::MatrixXd::Identity(d, d);
  return P;
}

Eigen::MatrixXd random_points(int n, Eigen::Index d, Seed seed) {
  RandomStream random(seed);
  return Eigen::MatrixXd::NullaryExpr(n, d, [&] { return random.uniform(); });
}

Eigen::MatrixXd positions(const Neighbourhoods& sets, int site) {
  const auto& members = sets.of(site);
  Eigen::MatrixXd P(static_cast<Eigen::Index>(members.size()), sets.position(site).size());
  for (std::size_t i = 0; i < members.size(); ++i)
    P.row(static_cast<Eigen::Index>(i)) = (sets.position(members[i]) - sets.position(site)).transpose();
  return P;
}

TEST(CrossPolytopeRatio, IsOneForTheCrossPolytopeOfAnyRadius) {
  for (Eigen::Index d = 1; d <= 6; ++d)
    for (const double radius : {1e-3, 0.2, 1.0}) {
      const Eigen::MatrixXd P = cross_polytope(d, radius);
      EXPECT_NEAR(cohesion(P), radius, rounding * radius);
      EXPECT_NEAR(adhesion(P), (d == 1 ? 2.0 : std::numbers::sqrt2) * radius, 2 * rounding * radius);
      EXPECT_NEAR(cross_polytope_ratio(P), 1.0, 2 * rounding);
      EXPECT_NEAR(neighbourhood_score(P) * radius, 1.0, 3 * rounding);
    }
}

// Two pairs, each pair e apart: every nearest distance is e, so A = e, and C = (1 + √(1 + e²))/2.
TEST(CrossPolytopeRatio, OfAClusteredSetIsAdhesionOverCohesion) {
  for (const double e : {1e-6, 1e-3, 0.1}) {
    Eigen::MatrixXd P(4, 2);
    P << 1, 0, 1, e, -1, 0, -1, e;
    const double c = 0.5 * (1 + std::sqrt(1 + e * e));
    EXPECT_NEAR(adhesion(P), e, rounding);
    EXPECT_NEAR(cross_polytope_ratio(P), e / (std::numbers::sqrt2 * c), rounding);
  }
}

TEST(CrossPolytopeRatio, IsZeroWhenAllNeighboursCoincide) {
  EXPECT_EQ(cross_polytope_ratio(Eigen::MatrixXd::Ones(4, 2)), 0.0);
  EXPECT_EQ(cross_polytope_ratio(Eigen::MatrixXd::Zero(4, 2)), 0.0);
  EXPECT_EQ(neighbourhood_score(Eigen::MatrixXd::Zero(2, 1)), 0.0);
}

// R = 1 − |p₁ + p₂| / (|p₁| + |p₂| + |p₁ − p₂|) by hand: (1, 2): 1 − 3/4; (1, −3): 1 − 2/8; (1, 1): 1 − 2/2.
TEST(CrossPolytopeRatio, InOneDimensionHasItsOwnForm) {
  const auto ratio = [](double p1, double p2) { return cross_polytope_ratio(Eigen::Vector2d(p1, p2)); };
  EXPECT_DOUBLE_EQ(ratio(1, -1), 1.0);
  EXPECT_DOUBLE_EQ(ratio(1, 2), 0.25);
  EXPECT_DOUBLE_EQ(ratio(1, -3), 0.75);
  EXPECT_DOUBLE_EQ(ratio(1, 1), 0.0);
}

TEST(CrossPolytopeRatio, OfRandomSetsStaysWithinItsBounds) {
  for (Eigen::Index d = 1; d <= 5; ++d)
    for (Seed seed = 0; seed < 2000; ++seed) {
      const Eigen::MatrixXd P = random_points(static_cast<int>(2 * d), d, 10 * seed + d).array() - 0.5;
      const double R = cross_polytope_ratio(P);
      ASSERT_GE(R, 0.0);
      ASSERT_LE(R, 1.0 + rounding) << "d " << d << ", seed " << 10 * seed + d;
    }
}

TEST(Neighbourhoods, KeepTheScoreOfTheirMembers) {
  for (Eigen::Index d = 1; d <= 4; ++d) {
    const Eigen::MatrixXd U = random_points(80, d, 7);
    Neighbourhoods sets(d);
    for (const auto& row : U.rowwise()) sets.add(row.transpose());
    for (int i = 0; i < sets.size(); ++i) {
      ASSERT_EQ(sets.of(i).size(), static_cast<std::size_t>(2 * d));
      const double expected = neighbourhood_score(positions(sets, i));
      EXPECT_NEAR(sets.score(i), expected, 10 * rounding * expected) << "d " << d << ", site " << i;
    }
  }
}

TEST(Neighbourhoods, ScoresNeverFallAsSitesCome) {
  const Eigen::MatrixXd U = random_points(120, 3, 11);
  Neighbourhoods sets(3);
  std::vector<double> before;
  for (const auto& row : U.rowwise()) {
    sets.add(row.transpose());
    for (std::size_t i = 0; i < before.size(); ++i) ASSERT_GE(sets.score(static_cast<int>(i)), before[i]);
    before.clear();
    for (int i = 0; i < sets.size(); ++i) before.push_back(sets.score(i));
  }
}

// S <= 1/C <= 1/h in a grid of spacing h, and the four neighbours along the axes reach it: they must be
// found.
TEST(Neighbourhoods, FindTheCrossInAGrid) {
  Neighbourhoods sets(2);
  const double h = 0.25;
  for (int i = 0; i < 25; ++i)
    if (i != 12) sets.add(Eigen::Vector2d(h * (i / 5), h * (i % 5)));
  sets.add(Eigen::Vector2d(2 * h, 2 * h));
  EXPECT_NEAR(sets.score(24), 1 / h, 10 * rounding / h);
  for (int i = 0; i < 24; ++i) EXPECT_LE(sets.score(i), (1 + 10 * rounding) / h);
}

// A newcomer at the mirror image completes the cross-polytope of a site that lacked one arm.
TEST(Neighbourhoods, ANewcomerReplacesTheMemberThatHelpsLeast) {
  Neighbourhoods sets(2);
  const std::vector<Eigen::Vector2d> sites{{0.5, 0.5}, {0.6, 0.5}, {0.4, 0.5}, {0.5, 0.6}, {0.55, 0.65}};
  for (const auto& site : sites) sets.add(site);
  const double before = sets.score(0);
  sets.add(Eigen::Vector2d(0.5, 0.4));
  EXPECT_GT(sets.score(0), before);
  EXPECT_NEAR(sets.score(0), 10.0, 1e-12);  // 1/C with C = 0.1; positions carry 1e-16, relative to 0.1
  const std::vector<int>& members = sets.of(0);
  EXPECT_EQ(std::count(members.begin(), members.end(), 4), 0);
}

TEST(Neighbourhoods, BadInputIsNamed) {
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([] { Neighbourhoods(0); }),
            "doe::Neighbourhoods: d is 0; allowed is 1 or more; give the number of variables");
}

// Least squares with 2d equations of size 1: the residual of an exact plane is rounding.
TEST(Nonlinearity, IsZeroForAPlaneAndItsGradientIsTheSlope) {
  for (Eigen::Index d = 1; d <= 6; ++d) {
    const Eigen::MatrixXd P = random_points(static_cast<int>(2 * d), d, 3).array() - 0.5;
    const Eigen::VectorXd slope = random_points(static_cast<int>(d), 1, 5);
    EXPECT_LT(nonlinearity(P, P * slope)[0], 1e-13);
    EXPECT_LT((local_gradient(P, P * slope) - slope).norm(), 1e-11);  // condition of P below 1e3
  }
}

// y = |x| around the site 0 with neighbours −1 and 1 has g = 0 and E = 2; y = x² with −h and h has E = 2h².
TEST(Nonlinearity, OfSimpleCurvesIsKnown) {
  const Eigen::MatrixXd P = Eigen::Vector2d(-1, 1);
  EXPECT_DOUBLE_EQ(nonlinearity(P, Eigen::Vector2d(1, 1))[0], 2.0);
  const double h = 0.125;
  EXPECT_DOUBLE_EQ(nonlinearity(h * P, Eigen::Vector2d(h * h, h * h))[0], 2 * h * h);
}

TEST(Nonlinearity, WithFewNeighboursIsZero) {
  const Eigen::MatrixXd P = random_points(3, 3, 9);
  EXPECT_LT(nonlinearity(P, Eigen::Vector3d(1, -2, 3))[0], 1e-12);
  EXPECT_EQ(nonlinearity(Eigen::MatrixXd(0, 3), Eigen::MatrixXd(0, 2)), Eigen::Vector2d::Zero());
}

}  // namespace
