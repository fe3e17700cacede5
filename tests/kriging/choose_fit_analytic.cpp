// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What runs stand for, and the gain of a way by it, against numbers by hand.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <drawpoint/kriging/choose_fit.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <limits>
#include <stdexcept>

using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

FitStanding standing(const VectorXd& gains, const VectorXd& share) {
  return detail::standing_of("other", VectorXd::Zero(gains.size()), gains, share);
}

TransformedModel fit_all(const MatrixXd& X, const VectorXd& y) { return fit(X, y); }

/// As a way does that averages repeated runs first.
TransformedModel fit_means(const MatrixXd& X, const VectorXd& y) {
  const Replicates means = replicates(X, y);
  return fit(means.X, means.y);
}

}  // namespace

// Runs at -1, 0.5 twice, and 1 own 0.75, 1 and 0.25 of 2. The shares come from 200 points, so that their
// deviations are 0.034, 0.035 and 0.023; five of these.
TEST(BoxShares, AreThoseOfWhatLiesNearest) {
  const MatrixXd X = Eigen::Vector4d(-1, 0.5, 0.5, 1);
  const VectorXd share = detail::shares_of_box(X, {});
  EXPECT_NEAR(share.sum(), 1, 1e-14);  // 200 additions of 1/200 or 1/400
  EXPECT_NEAR(share[0], 0.375, 0.17);
  EXPECT_EQ(share[1], share[2]);
  EXPECT_NEAR(share[1] + share[2], 0.5, 0.175);
  EXPECT_NEAR(share[3], 0.125, 0.115);
}

// Of three levels, which are as far from each other, two have a run: each has its own third and half of the one
// without. 100 points; five deviations of 0.05.
TEST(BoxShares, OfLevelsGoToTheirOwnRuns) {
  const MatrixXd X = Eigen::Vector2d(0, 2);
  const VectorXd share = detail::shares_of_box(X, {3});
  EXPECT_NEAR(share.sum(), 1, 1e-14);
  EXPECT_NEAR(share[0], 0.5, 0.25);
}

// Shares alike: mean 3, standard error √(14/(2·3)). Shares 1/2, 1/4, 1/4: mean 2.5; S = 3/8, Σ share³ = 5/32,
// Σ (share (gain − 2.5))² = 43/32, times S/(S − 5/16 + 9/64) = 24/13.
TEST(GainOfAWay, IsByRunsAndByShares) {
  const FitStanding s = standing(Vector3d(1, 2, 6), Vector3d(0.5, 0.25, 0.25));
  EXPECT_DOUBLE_EQ(s.gain, 3);
  EXPECT_DOUBLE_EQ(s.standard_error, std::sqrt(14.0 / 6));
  EXPECT_DOUBLE_EQ(s.box_gain, 2.5);
  EXPECT_DOUBLE_EQ(s.box_standard_error, std::sqrt(43.0 / 32 * 24 / 13));
}

// The first holds the run impossible that stands for nothing. Elsewhere the other gains 1 and 2.
TEST(GainOfAWay, DoesNotAskARunThatStandsForNothing) {
  const FitStanding s = standing(Vector3d(1, 2, infinite), Vector3d(0.5, 0.5, 0));
  EXPECT_DOUBLE_EQ(s.box_gain, 1.5);
  EXPECT_DOUBLE_EQ(s.box_standard_error, 0.5);
  EXPECT_TRUE(detail::beats_first(s));
}

TEST(GainOfAWay, HasToBeMoreThanChanceBothWays) {
  const Vector3d alike = detail::equal_shares(3), one_run(0.9, 0.05, 0.05);
  EXPECT_TRUE(detail::beats_first(standing(Vector3d(1, 2, 3), alike)));
  EXPECT_FALSE(
      detail::beats_first(standing(Vector3d(1, -1, -1), one_run)));  // by the run of most share alone
  EXPECT_FALSE(detail::beats_first(standing(Vector3d(-1, 2, 2.5), one_run)));  // by the others alone
  EXPECT_FALSE(detail::beats_first(standing(VectorXd::Ones(1), detail::equal_shares(1))));
}

// A straight line with a wave that dies out: usual_kinds() stands for its ways without any glue.
TEST(ChooseFit, TakesOptionsForWays) {
  MatrixXd X(14, 1);
  VectorXd y(14);
  for (int i = 0; i < 14; ++i) X(i, 0) = i / 13.0, y[i] = 5 * X(i, 0) + std::exp(-6 * X(i, 0));
  const FitChoice choice = choose_fit(X, y, usual_kinds());
  ASSERT_EQ(choice.table.size(), 4u);
  EXPECT_EQ(choice.table[0].name, "gaussian, constant");
  EXPECT_EQ(choice.table[3].name, "matern52, linear");
  const FitOptions best = usual_kinds()[choice.best];
  EXPECT_EQ(choice.model.mean(X), fit(X, y, best).mean(X));
  const VectorXd noise = VectorXd::Constant(14, 1e-4);
  const FitChoice told = choose_fit(X, y, usual_kinds(), {}, {Noise::known, noise});
  EXPECT_GT(told.model.model().noise_variance(), 0.0);
}

// Twelve points run twice. Ways of 12 means are paired with each other, not with ways of 24 runs.
TEST(ChooseFit, PairsTheRunsOfTheModels) {
  MatrixXd X(24, 1);
  VectorXd y(24);
  for (Eigen::Index i = 0; i < 24; ++i) {
    X(i, 0) = static_cast<double>(i / 2);
    y[i] = std::sin(X(i, 0)) + (i % 2 == 0 ? 0.1 : -0.1);
  }
  const FitChoice choice = choose_fit(X, y, {}, {{"means", fit_means}, {"again", fit_means}});
  EXPECT_EQ(choice.model.runs(), 12);
  EXPECT_EQ(choice.table[1].gain, 0);
  EXPECT_EQ(choice.table[1].box_gain, 0);
  try {
    choose_fit(X, y, {}, {{"all", fit_all}, {"means", fit_means}});
    FAIL() << "ways of 24 and of 12 runs were compared";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(
        e.what(),
        "kriging::choose_fit: the model of way \"means\" has 12 runs but that of \"all\" has 24; allowed "
        "are models of the same runs; average replicates in all ways or none");
  }
}
