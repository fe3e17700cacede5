// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What simulation says of a predicted front: which points are asked, and how the answer is counted.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/model/fronts/confirmations.h>
#include <drawpoint/studies/model/fronts/decision_points.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

/// production (maximized, at least 0) and spill (at most 0.25).
doe::Problem bounded() {
  doe::Problem problem = test::two_by_two();
  problem.responses[0].lower = 0.0;
  return problem;
}

studies::Run done(std::int64_t id, Kind kind, double production, double spill) {
  studies::Run run;
  run.id = id;
  run.kind = kind;
  run.status = Status::done;
  run.x = Eigen::Vector2d(1.0, 0.0);
  run.y = Eigen::Vector2d(production, spill);
  run.predicted = run.lower = run.upper = Eigen::Vector2d::Constant(std::nan(""));
  return run;
}

/// With the interval that holds 95 % of a normal variable.
studies::Run predicted(studies::Run run, const Eigen::Vector2d& mean, const Eigen::Vector2d& deviation) {
  run.predicted = mean;
  run.lower = mean - 1.959963984540054 * deviation;
  run.upper = mean + 1.959963984540054 * deviation;
  return run;
}

// P(at most k of n) of a binomial with 0.95: n = 1: 0.05, 1; n = 2: 0.0025, 0.0975, 1.
TEST(Confirmation, ChanceIsBinomial) {
  EXPECT_NEAR(chance_of_at_most(0, 1), 0.05, 1e-15);
  EXPECT_NEAR(chance_of_at_most(0, 2), 0.0025, 1e-15);
  EXPECT_NEAR(chance_of_at_most(1, 2), 0.0975, 1e-15);
  // One miss at most of 18: 0.95^18 + 18 · 0.05 · 0.95^17; so P(at most 16) is the rest.
  EXPECT_NEAR(chance_of_at_most(16, 18), 1.0 - std::pow(0.95, 18) - 0.9 * std::pow(0.95, 17), 1e-14);
  for (const int n : {0, 1, 7, 1000}) EXPECT_EQ(chance_of_at_most(n, n), 1.0);
}

// A miss of one value happens in 0.05 of all cases, one or more of two in 0.0975, of three in 0.143; two or
// more of 18 in 0.226, three or more in 0.058. A tenth is the line.
TEST(Confirmation, AgreesUntilMissesAreMoreThanChance) {
  const auto verdict = [](int held, int values) {
    CheckedRuns checked;
    checked.add({.outcome = Eigen::VectorXd(0), .values = values, .held = held});
    return checked.agree();
  };
  EXPECT_TRUE(verdict(1, 1));
  EXPECT_FALSE(verdict(0, 1));
  EXPECT_FALSE(verdict(1, 2));
  EXPECT_TRUE(verdict(2, 3));
  EXPECT_TRUE(verdict(16, 18));
  EXPECT_FALSE(verdict(15, 18));
  EXPECT_FALSE(verdict(0, 0));  // nothing agrees with nothing
}

TEST(Confirmation, CountsValuesWithinTheirIntervals) {
  const Eigen::Vector2d mean(100.0, 0.2), deviation(10.0, 0.01);
  const std::vector<studies::Run> runs = {
      done(1, Kind::training, 119.0, 0.3),  // breaks the limit: dominates nobody
      done(2, Kind::training, 110.0, 0.1),
      predicted(done(3, Kind::confirmation, 119.5, 0.2), mean, deviation),     // 1.95 deviations
      predicted(done(4, Kind::confirmation, 119.7, 0.1803), mean, deviation),  // 1.97 and 1.97
      predicted(done(5, Kind::confirmation, 105.0, 0.2), mean, deviation),     // runs 2, 3 and 4 were better
      done(6, Kind::confirmation, 0.0, 0.0)};                                  // nothing was predicted
  const CheckedRuns all = check_predictions(runs, bounded(), Kind::confirmation, {{3, 0}, {5, 0}});
  ASSERT_EQ(all.runs.size(), 3u);
  EXPECT_EQ(all.values, 6);
  EXPECT_EQ(all.within, 4);
  EXPECT_EQ(all.dominated, 1);
  EXPECT_FALSE(all.runs[0].dominated);
  EXPECT_TRUE(all.runs[2].dominated);
  EXPECT_EQ(all.runs[1].within, std::vector<bool>({false, false}));
  EXPECT_NEAR(all.runs[0].upper[0] - 100.0, 19.59963984540054, 1e-12);
  EXPECT_EQ(all.runs[1].round, 1);
  EXPECT_EQ(all.last_round().runs.size(), 1u);
  EXPECT_EQ(all.last_round().within, 2);
  EXPECT_TRUE(check_predictions(runs, bounded(), Kind::adaptive).runs.empty());
}

// Four points in one round, the first named by the user: what is better in the same round does not count, nor
// what breaks the limit of 0.25, and no promise was made of the named one.
TEST(Confirmation, DominationIsByRunsBeforeTheRound) {
  const Eigen::Vector2d mean(100.0, 0.2), deviation(10.0, 0.01);
  const auto confirmed = [&](std::int64_t id, double production, double spill) {
    return predicted(done(id, Kind::confirmation, production, spill), mean, deviation);
  };
  const CheckedRuns all = check_predictions(
      {done(1, Kind::training, 105.0, 0.2), confirmed(2, 90.0, 0.2), confirmed(3, 110.0, 0.2),
       confirmed(4, 107.0, 0.2), confirmed(5, 100.0, 0.2), confirmed(6, 104.0, 0.3)},
      bounded(), Kind::confirmation, {{2, 1}});
  EXPECT_TRUE(all.runs[0].named);
  EXPECT_EQ(all.dominated, 1);
  EXPECT_TRUE(all.runs[3].dominated);
  EXPECT_EQ(all.breaking, 1);
  EXPECT_TRUE(all.runs[4].breaks_limit);
  EXPECT_EQ(text(all),
            "5 points, 9 of 10 values within the stated 95 % interval, 1 breaks a limit, 1 dominated by "
            "earlier runs");
}

// Replicates share the error of the models, so that the first alone counts.
TEST(Confirmation, APointIsJudgedOnce) {
  auto first = predicted(done(1, Kind::confirmation, 1.0, 0.1), {1.0, 0.1}, {1.0, 1.0}), second = first;
  second.id = 2;
  second.replicate = 1;
  const CheckedRuns all = check_predictions({first, second}, bounded(), Kind::confirmation, {{1, 0}});
  EXPECT_EQ(all.runs.size(), 1u);
  EXPECT_EQ(all.values, 2);
}

// A surrogate that expects less than nothing means nothing, and is right when nothing comes.
TEST(Confirmation, IntervalsEndAtTheRange) {
  const auto run = predicted(done(1, Kind::confirmation, 0.0, 0.1), {-50.0, 0.1}, {10.0, 1.0});
  const CheckedRuns all = check_predictions({run}, bounded(), Kind::confirmation);
  EXPECT_EQ(all.runs[0].predicted[0], 0.0);
  EXPECT_EQ(all.runs[0].lower[0], 0.0);
  EXPECT_EQ(all.runs[0].upper[0], 0.0);
  EXPECT_EQ(all.within, 2);
}

TEST(Confirmation, FailedRunsAreCountedApart) {
  auto run = predicted(done(1, Kind::confirmation, 1.0, 0.1), {1.0, 0.1}, {1.0, 1.0});
  run.status = Status::failed;
  run.reason = "stuck";
  const CheckedRuns all = check_predictions({run}, bounded(), Kind::confirmation);
  EXPECT_EQ(all.failed, 1);
  EXPECT_EQ(all.values, 0);
  EXPECT_EQ(all.runs[0].outcome.reason(), "stuck");
  EXPECT_EQ(text(all), "1 point, 0 of 0 values within the stated 95 % interval, 1 failed");
}

TEST(Confirmation, RecordedResponsesAreNotHeldAgainstTheFront) {
  doe::Problem problem = bounded();
  problem.responses[1].goal = doe::Goal::record;
  const auto run = predicted(done(1, Kind::confirmation, 1.0, 9.0), {1.0, 0.1}, {1.0, 0.1});
  EXPECT_EQ(check_predictions({run}, problem, Kind::confirmation).values, 1);
}

/// A quarter of a circle around (1, 1), both objectives minimised: ends (0, 1) and (1, 0), and its middle is
/// the balanced choice. alpha runs along it over its whole range.
pareto::Front quarter_circle(const doe::Problem& problem, int n) {
  pareto::Front front;
  front.X.resize(n, 2);
  front.Y.resize(n, 2);
  for (int i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / (n - 1), angle = 0.5 * M_PI * t;
    front.X.row(i) = Eigen::RowVector2d(problem.variables[0].lower + 1.8 * t, 0.0);
    front.Y.row(i) = Eigen::RowVector2d(1.0 - std::sin(angle), 1.0 - std::cos(angle));
  }
  front.responses = front.Y;
  return front;
}

class PointsToConfirm : public testing::Test {
 protected:
  PointsToConfirm() {
    problem_.responses = {{"a", "1", doe::Goal::minimize}, {"b", "1", doe::Goal::minimize}};
  }
  std::vector<int> chosen(const Eigen::MatrixXd& confirmed, int most) const {
    return points_to_confirm(front_, problem_, confirmed, most);
  }

  doe::Problem problem_ = test::two_by_two();
  const pareto::Front front_ = quarter_circle(test::two_by_two(), 101);
  const Eigen::MatrixXd nothing_ = Eigen::MatrixXd(0, 2);
};

TEST_F(PointsToConfirm, AreTheEndsTheMiddleAndThenWhatIsFarFromThese) {
  const auto rows = chosen(nothing_, 3);
  EXPECT_EQ(std::set<int>(rows.begin(), rows.end()), std::set<int>({0, 50, 100}));
  EXPECT_EQ(chosen(nothing_, 1).size(), 1u);
  const auto five = chosen(nothing_, 5);
  ASSERT_EQ(five.size(), 5u);
  // Between the three there is no knee: the quarters of the arc are farthest from all of them.
  EXPECT_EQ(std::set<int>(five.begin(), five.end()), std::set<int>({0, 25, 50, 75, 100}));
}

// Row 1 is a hundredth of the range from row 0: the same strategy.
TEST_F(PointsToConfirm, AreNotWhereSimulationHasBeen) {
  const auto rows = chosen(front_.X({1, 50}, Eigen::all), 2);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), 0) + std::count(rows.begin(), rows.end(), 50), 0);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), 100), 1);
  EXPECT_TRUE(chosen(front_.X, 4).empty());
}

TEST_F(PointsToConfirm, AreNoneWithoutAFront) {
  EXPECT_TRUE(points_to_confirm({}, problem_, nothing_, 4).empty());
}

}  // namespace
