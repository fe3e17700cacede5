// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Indicators and choices in other units. A unit is a power of two, 1.3e8 or 7.5e-9, so that no digit changes:
/// what is a length in the objectives' space scales with one unit for all, what is a share or a row stays in any
/// units, and values of one objective scale with its own, all bit for bit.

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/pareto/attainment.hpp>
#include <drawpoint/pareto/indicators.hpp>
#include <drawpoint/pareto/knees.hpp>
#include <drawpoint/pareto/preference.hpp>
#include <drawpoint/pareto/vorobev.hpp>

using namespace drawpoint;
using namespace drawpoint::pareto;
using Eigen::MatrixXd;

namespace {

const double large = std::exp2(27), small = std::exp2(-27);
const std::vector<Eigen::RowVector2d> units{
    {large, large}, {small, small}, {large, small}, {1, large}, {small, 1}};

const doe::Problem problem{{{"x", "1", 0, 1}},
                           {{"f", "N", doe::Goal::minimize}, {"g", "m", doe::Goal::maximize}}};

/// Points of both signs around a bent front.
MatrixXd cloud(Eigen::Index rows, doe::Seed seed) {
  doe::RandomStream random(seed);
  MatrixXd Y(rows, 2);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double angle = M_PI_2 * random.uniform(), size = 1 + 0.2 * random.uniform();
    Y.row(i) << 0.5 - size * std::cos(angle), size * std::sin(angle) - 0.5;
  }
  return Y;
}

MatrixXd in_units(MatrixXd Y, const Eigen::RowVector2d& unit) {
  for (Eigen::Index j = 0; j < 2; ++j) Y.col(j) *= unit[j];
  return Y;
}

Draws draws_in(const Eigen::RowVector2d& unit) {
  Draws draws;
  for (doe::Seed seed = 1; seed <= 12; ++seed) draws.push_back(in_units(cloud(20, seed), unit));
  return draws;
}

const Eigen::RowVector2d one{1, 1};

}  // namespace

TEST(AnyUnit, DistancesOfFrontsScaleWithOneUnitOfAll) {
  const MatrixXd Y = cloud(30, 21), Z = cloud(30, 22);
  for (const double unit : {large, small}) {
    const MatrixXd y = unit * Y, z = unit * Z;
    EXPECT_EQ(igd(problem, y, z), unit * igd(problem, Y, Z));
    EXPECT_EQ(igd_plus(problem, y, z), unit * igd_plus(problem, Y, Z));
    EXPECT_EQ(additive_epsilon(problem, y, z), unit * additive_epsilon(problem, Y, Z));
  }
}

TEST(AnyUnit, VorobevsVolumesAreProductsOfTheUnits) {
  const Vorobev plain = vorobev(problem, draws_in(one));
  ASSERT_GT(plain.expected_volume, 0);
  for (const Eigen::RowVector2d& unit : units) {
    const Vorobev other = vorobev(problem, draws_in(unit));
    EXPECT_EQ(other.threshold, plain.threshold) << unit;
    // places in the box are scaled, not drawn anew: one rounding each
    EXPECT_NEAR(other.expected_volume / unit.prod(), plain.expected_volume, 1e-14 * plain.expected_volume)
        << unit;
    EXPECT_NEAR(other.deviation / unit.prod(), plain.deviation, 1e-14 * plain.expected_volume) << unit;
  }
}

TEST(AnyUnit, AttainmentIsAProbabilityAndItsFrontHasTheObjectivesUnits) {
  const MatrixXd at = cloud(15, 31);
  const FrontBand plain = front_band(problem, draws_in(one), at);
  const Eigen::VectorXd alpha = attainment_probability(problem, draws_in(one), at);
  for (const Eigen::RowVector2d& unit : units) {
    EXPECT_EQ(attainment_probability(problem, draws_in(unit), in_units(at, unit)), alpha) << unit;
    const FrontBand band = front_band(problem, draws_in(unit), in_units(at, unit));
    EXPECT_EQ(band.median, in_units(plain.median, unit)) << unit;
    EXPECT_EQ(band.optimistic, in_units(plain.optimistic, unit)) << unit;
    EXPECT_EQ(band.pessimistic, in_units(plain.pessimistic, unit)) << unit;
  }
}

TEST(AnyUnit, KneesAndPreferencesChooseTheSameRows) {
  const MatrixXd Y = cloud(40, 41);
  const auto front_in = [&](const Eigen::RowVector2d& unit) {
    Front front;
    front.Y = in_units(Y, unit);
    front.responses = front.Y;
    front.X = MatrixXd::Zero(Y.rows(), 1);
    return front;
  };
  for (const KneeMeasure measure : {KneeMeasure::distance, KneeMeasure::trade_off}) {
    const Knees plain = knees(problem, front_in(one), {.measure = measure});
    for (const Eigen::RowVector2d& unit : units)
      EXPECT_EQ(knees(problem, front_in(unit), {.measure = measure}).rows, plain.rows) << unit;
  }
  const Choice plain = by_weights(problem, front_in(one), Eigen::Vector2d(0.3, 0.7));
  const MatrixXd weights = pseudo_weights(problem, front_in(one));
  for (const Eigen::RowVector2d& unit : units) {
    EXPECT_EQ(by_weights(problem, front_in(unit), Eigen::Vector2d(0.3, 0.7)).ranking, plain.ranking) << unit;
    EXPECT_EQ(pseudo_weights(problem, front_in(unit)), weights) << unit;
  }
}
