// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Two folders held against each other: the statistics against published numbers, pairs and fronts by hand.

#include <drawpoint/tests/studies/support.hpp>

#include <drawpoint/studies/model/comparison/comparison.h>
#include <drawpoint/studies/model/comparison/front_comparison.h>
#include <drawpoint/studies/model/comparison/mean_differences.h>

#include <cmath>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

/// Hours of sleep that ten patients gained with each of two drugs (Student 1908, The probable error of a
/// mean).
const Eigen::VectorXd drug_1{{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0}};
const Eigen::VectorXd drug_2{{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4}};

// R prints for t.test(drug_2, drug_1, paired = TRUE): 0.7001142 to 2.4598858 with 9 degrees of freedom. Half
// a unit of the last digit; the quantile is off by 1e-9 at most.
TEST(MeanDifference, OfPairsIsThatOfAnotherProgram) {
  const MeanDifference d = paired_difference(drug_1, drug_2);
  EXPECT_NEAR(d.a, 0.75, 1e-14);
  EXPECT_NEAR(d.value(), 1.58, 1e-14);
  EXPECT_NEAR(d.lower, 0.7001142, 5.1e-8);
  EXPECT_NEAR(d.upper, 2.4598858, 5.1e-8);
  EXPECT_EQ(d.degrees_of_freedom, 9.0);
  EXPECT_TRUE(d.is_told_apart());
}

// Without paired = TRUE: -0.2054832 to 3.3654832 with 17.776 degrees of freedom (Welch).
TEST(MeanDifference, OfIndependentSamplesIsThatOfAnotherProgram) {
  const MeanDifference d = independent_difference(drug_1, drug_2);
  EXPECT_NEAR(d.lower, -0.2054832, 5.1e-8);
  EXPECT_NEAR(d.upper, 3.3654832, 5.1e-8);
  EXPECT_NEAR(d.degrees_of_freedom, 17.776, 5e-4);
  EXPECT_FALSE(d.is_told_apart());
}

// Two pairs have the least degrees of freedom there are: t = 12.706204736, s = √2/2 of the differences 1 and
// 2, so that the half width is t/2.
TEST(MeanDifference, OfTwoPairsAndOfNoVariance) {
  const MeanDifference two = paired_difference(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 2));
  EXPECT_NEAR(two.upper, 1.5 + 0.5 * 12.70620473617471, 1e-8);
  const MeanDifference same = paired_difference(drug_1, drug_1);
  EXPECT_EQ(same.lower, 0.0);
  EXPECT_EQ(same.upper, 0.0);
  const MeanDifference constant =
      independent_difference(Eigen::Vector2d::Constant(1.0), Eigen::Vector3d::Constant(3.0));
  EXPECT_FALSE(constant.has_interval()) << "values that do not scatter prove nothing";
  EXPECT_FALSE(constant.is_told_apart());
  EXPECT_FALSE(paired_difference(Eigen::Vector2d(3, 7), Eigen::Vector2d(4, 8)).has_interval());
}

studies::Run run_at(std::int64_t id, Kind kind, double x, double y, doe::Seed seed = 7) {
  studies::Run run;
  run.id = id;
  run.kind = kind;
  run.seed = seed;
  run.x = Eigen::VectorXd::Constant(1, x);
  run.status = Status::done;
  run.y = Eigen::VectorXd::Constant(1, y);
  return run;
}

studies::Run failed_at(std::int64_t id, Kind kind, double x) {
  studies::Run run = run_at(id, kind, x, 0.0);
  run.status = Status::failed;
  run.reason = "stuck";
  return run;
}

// Pairs at x = 1 (validation), 2 (of replicates the means 3 and 5) and 3: differences 1, 2, 0. A point
// that is a last bit off, one of another kind, one made elsewhere, and one not made yet are no pairs.
// Squares of variances of such values leave the range of numbers; the interval scales with the values.
TEST(MeanDifference, OfVerySmallAndVeryLargeValues) {
  const MeanDifference plain = independent_difference(drug_1, drug_2);
  for (const double scale : {1e-82, 1e80}) {
    const MeanDifference scaled = independent_difference(scale * drug_1, scale * drug_2);
    EXPECT_NEAR(scaled.degrees_of_freedom, plain.degrees_of_freedom, 1e-9);
    EXPECT_NEAR(scaled.lower / scale, plain.lower, 1e-12);
  }
}

TEST(CompareRuns, PairsEqualPointsOfEqualKind) {
  studies::Run planned = run_at(9, Kind::training, 7.0, 1.0);
  planned.status = Status::planned;
  const Comparison c =
      compare_runs({run_at(1, Kind::validation, 1.0, 4.0), run_at(2, Kind::training, 2.0, 2.0, 8),
                    run_at(3, Kind::training, 2.0, 4.0, 9), run_at(4, Kind::training, 3.0, 6.0),
                    run_at(5, Kind::training, 4.0, 1.0), run_at(6, Kind::training, 5.0, 1.0),
                    run_at(7, Kind::imported, 6.0, 1.0), run_at(8, Kind::training, 7.0, 1.0)},
                   {run_at(1, Kind::training, 3.0, 6.0, 99), run_at(2, Kind::training, 2.0, 5.0, 9),
                    run_at(3, Kind::training, 2.0, 5.0, 8), run_at(4, Kind::validation, 1.0, 5.0),
                    run_at(5, Kind::training, std::nextafter(4.0, 5.0), 9.0),
                    run_at(6, Kind::adaptive, 5.0, 9.0), run_at(7, Kind::imported, 6.0, 9.0), planned});
  EXPECT_EQ(c.pairs, 3);
  ASSERT_TRUE(c.paired);
  EXPECT_EQ(c.points_a, 6);
  EXPECT_EQ(c.points_b, 5);
  EXPECT_EQ(c.with_other_seeds, 1);  // replicates in another order have the same seeds
  ASSERT_EQ(c.responses.size(), 1u);
  EXPECT_NEAR(c.responses[0].mean.a, 13.0 / 3.0, 1e-14);
  EXPECT_NEAR(c.responses[0].mean.value(), 1.0, 1e-14);
  // s = 1, t(2) = 4.302652730: half width 4.302652730/√3.
  EXPECT_NEAR(c.responses[0].mean.upper - 1.0, 4.302652729696142 / std::sqrt(3.0), 1e-8);
  EXPECT_EQ(c.responses[0].larger, 2);
  EXPECT_EQ(c.responses[0].equal, 1);
  EXPECT_TRUE(c.left_out.empty());
}

TEST(CompareRuns, NamesPointsWhereASideFailed) {
  const Comparison c = compare_runs({run_at(1, Kind::training, 1.0, 1.0), failed_at(2, Kind::training, 2.0),
                                     run_at(3, Kind::training, 3.0, 1.0), failed_at(4, Kind::training, 4.0),
                                     failed_at(5, Kind::training, 5.0), run_at(6, Kind::training, 5.0, 2.0)},
                                    {run_at(1, Kind::training, 1.0, 2.0),
                                     run_at(2, Kind::training, 2.0, 100.0), failed_at(3, Kind::training, 3.0),
                                     failed_at(4, Kind::training, 4.0), run_at(5, Kind::training, 5.0, 3.0)});
  EXPECT_EQ(c.pairs, 2) << "a replicate that failed leaves the point its others";
  EXPECT_NEAR(c.responses[0].mean.value(), 1.0, 1e-14);
  ASSERT_EQ(c.left_out.size(), 3u);
  EXPECT_TRUE(c.left_out[0].failed_a && !c.left_out[0].failed_b);
  EXPECT_TRUE(!c.left_out[1].failed_a && c.left_out[1].failed_b);
  EXPECT_TRUE(c.left_out[2].failed_a && c.left_out[2].failed_b);
  EXPECT_EQ(c.left_out[1].runs_a, std::vector<std::int64_t>{3});
}

// One pair is none: the means over training and validation, 2 and 6, are those of all such points, without
// what was chosen by what runs gave.
TEST(CompareRuns, WithoutPairsComparesMeans) {
  const Comparison c =
      compare_runs({run_at(1, Kind::training, 1.0, 1.0), run_at(2, Kind::training, 2.0, 2.0),
                    run_at(3, Kind::validation, 3.0, 3.0), run_at(4, Kind::adaptive, 4.0, 100.0)},
                   {run_at(1, Kind::training, 1.0, 5.0), run_at(2, Kind::training, 2.5, 7.0)});
  EXPECT_EQ(c.pairs, 1);
  EXPECT_FALSE(c.paired);
  EXPECT_EQ(c.points_a, 3);
  EXPECT_EQ(c.points_b, 2);
  ASSERT_EQ(c.responses.size(), 1u);
  EXPECT_EQ(c.responses[0].mean.a, 2.0);
  EXPECT_EQ(c.responses[0].mean.b, 6.0);
  EXPECT_TRUE(compare_runs({run_at(1, Kind::training, 1.0, 1.0)}, {}).responses.empty());
}

pareto::Front front_with(const Eigen::MatrixXd& Y) {
  pareto::Front front;
  front.Y = Y;
  front.X = Eigen::MatrixXd::Zero(Y.rows(), 1);
  return front;
}

// The second objective is maximized. From the ideal (0, 0) to the reference (1.1, -1.1) the box has 1.21; the
// ends cover two strips of 0.1 by 1.1 that share a corner of 0.01, the middle a square of 0.6.
TEST(CompareFronts, SharesAreThoseOfTheBoxAroundBoth) {
  const doe::Problem problem{
      .variables = {{"x", "1", 0.0, 1.0}},
      .responses = {{"cost", "EUR", doe::Goal::minimize}, {"gain", "1", doe::Goal::maximize}}};
  const FrontComparison c = compare_fronts(problem, front_with(Eigen::Matrix2d{{0.0, -1.0}, {1.0, 0.0}}),
                                           front_with(Eigen::MatrixXd{{0.5, -0.5}}));
  EXPECT_EQ(c.best_a, Eigen::VectorXd(Eigen::Vector2d(0.0, 0.0)));
  EXPECT_EQ(c.best_b, Eigen::VectorXd(Eigen::Vector2d(0.5, -0.5)));
  ASSERT_TRUE(c.share_a && c.share_b);
  EXPECT_NEAR(c.reference[1], -1.1, 1e-15);
  EXPECT_NEAR(*c.share_a, 0.21 / 1.21, 1e-14);
  EXPECT_NEAR(*c.share_b, 0.36 / 1.21, 1e-14);
}

TEST(CompareFronts, OneObjectiveAndPointsAtOnePlaceHaveNoShare) {
  const doe::Problem one{.variables = {{"x", "1", 0.0, 1.0}},
                         .responses = {{"gain", "1", doe::Goal::maximize}}};
  const FrontComparison c =
      compare_fronts(one, front_with(Eigen::MatrixXd{{3.0}}), front_with(Eigen::MatrixXd{{4.0}}));
  EXPECT_FALSE(c.share_a);
  EXPECT_EQ(c.best_b[0], 4.0);
  const doe::Problem two = {.variables = one.variables,
                            .responses = {one.responses[0], {"cost", "EUR", doe::Goal::minimize}}};
  const pareto::Front point = front_with(Eigen::MatrixXd{{1.0, 2.0}});
  EXPECT_FALSE(compare_fronts(two, point, point).share_a);
}

}  // namespace
