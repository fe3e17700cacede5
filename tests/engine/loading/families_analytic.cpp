// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What the families of strategies do, move by move.
#include <gtest/gtest.h>

#include <drawpoint/engine/loading/strategy/families.hpp>
#include <stdexcept>

using namespace drawpoint::engine::loading;

TEST(Families, DifferInTheirMovesAndNotInHowHardTheyPush) {
  for (const Family family : {Family::slice, Family::drive_and_curl, Family::steps, Family::edge_dropped}) {
    const OperatorMoves moves = moves_of(family, 2, 1.5);
    EXPECT_EQ(moves.crowd, 1.5);
    EXPECT_EQ(moves.most_slip, skilled_operator().most_slip);
    EXPECT_NO_THROW(check(moves));
  }
  EXPECT_EQ(longest_time(moves_of(Family::slice, 5, 0)), 0);
  EXPECT_EQ(longest_time(moves_of(Family::drive_and_curl, 5, 0)), 0);
  const OperatorMoves steps = moves_of(Family::steps, 2, 0), drops = moves_of(Family::edge_dropped, 2, 0);
  ASSERT_EQ(steps.round.size(), 2u);
  EXPECT_GT(steps.round[0].boom, 0) << "a lift";
  EXPECT_GT(steps.round[1].tilt, 0) << "a curl";
  ASSERT_EQ(drops.round.size(), 4u);
  EXPECT_LT(drops.round[2].tilt, 0) << "the edge dropped";
  EXPECT_DOUBLE_EQ(longest_time(drops), 2 * longest_time(steps));
  EXPECT_THROW(moves_of(Family::steps, 0, 1), std::invalid_argument);
  EXPECT_THROW(moves_of(Family::slice, 1, -1), std::invalid_argument);
}

TEST(Families, OnlyDriveAndCurlHasNoLift) {
  const Strategy wanted{.alpha = 1.2, .beta = 0.7, .gamma = 0.3, .kappa = 0.6};
  for (const Family family : {Family::slice, Family::steps, Family::edge_dropped})
    EXPECT_EQ(strategy_of(family, wanted).beta, 0.7);
  const Strategy curled = strategy_of(Family::drive_and_curl, wanted);
  EXPECT_EQ(curled.beta, 0);
  EXPECT_EQ(curled.kappa, 0);
  EXPECT_EQ(curled.alpha, 1.2);
  EXPECT_EQ(curled.gamma, 0.3);
}
