// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/pareto/filter.hpp>
#include <drawpoint/pareto/knees.hpp>
#include <drawpoint/pareto/preference.hpp>
#include <drawpoint/pareto/trade_off.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <set>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

using doe::Goal;

/// Sums and quotients of a few numbers about 1.
constexpr double rounding = 1e-13;

Front front_of(const Eigen::MatrixXd& responses, const doe::Problem& problem) {
  Front front;
  front.responses = responses;
  front.Y = responses(Eigen::all, detail::roles(problem).objectives);
  front.X = Eigen::MatrixXd::Zero(responses.rows(), 1);
  return front;
}

Eigen::MatrixXd table(std::initializer_list<std::initializer_list<double>> rows) {
  Eigen::MatrixXd Y(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.begin()->size()));
  Eigen::Index i = 0;
  for (const auto& row : rows) {
    std::copy(row.begin(), row.end(), Y.row(i++).begin());
  }
  return Y;
}

/// Production is maximised, damage minimised, mass only recorded.
const doe::Problem loading{
    {{"x", "1", 0.0, 1.0}},
    {{"production", "kg/s", Goal::maximize}, {"damage", "s", Goal::minimize}, {"mass", "t", Goal::record}}};

Front loading_front() {
  return front_of(table({{100, 1, 3}, {250, 2, 4}, {300, 4, 6}, {320, 6, 5}, {325, 9, 2}}), loading);
}

TEST(Filter, TheBestProductionWithDamageAtMostFive) {
  const Choice c = best(loading, loading_front(), "production", {at_most("damage", 5.0)});
  EXPECT_EQ(c.status, ChoiceStatus::found);
  EXPECT_EQ(c.row, 2);
  EXPECT_EQ(c.value, 300.0);
  EXPECT_EQ(c.ranking, (std::vector<int>{2, 1, 0}));
  EXPECT_EQ(c.message, "");
}

TEST(Filter, LimitsAreMetWhenReachedAndConditionsAddUp) {
  const Front front = loading_front();
  EXPECT_EQ(meeting(loading, front, {at_most("damage", 4.0)}), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(meeting(loading, front, {at_least("production", 250.0), at_least("mass", 5.0)}),
            (std::vector<int>{2, 3}));
  EXPECT_EQ(meeting(loading, front, {}).size(), 5u);
  EXPECT_EQ(part_of(front, {2, 3}).responses, front.responses.middleRows(2, 2));
}

TEST(Filter, LimitsOfTheProblemAreConditions) {
  doe::Problem problem = loading;
  problem.responses[2] = {"mass", "t", Goal::at_least, 3.5};
  const auto conditions = conditions_of(problem);
  ASSERT_EQ(conditions.size(), 1u);
  EXPECT_EQ(meeting(problem, loading_front(), conditions), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(best(problem, loading_front(), "mass").row, 2);  // more is better for at_least
  EXPECT_TRUE(meets_limits(problem, Eigen::Vector3d(0, 0, 3.5)));
  EXPECT_FALSE(meets_limits(problem, Eigen::Vector3d(0, 0, 3.4)));
}

// Production misses 400 by 75 of its range 225 in row 4, by 80 in row 3; damage is met by rows 0 to 4.
TEST(Filter, WhenNoneMeetsTheNearestIsNamedAndWhatIsAttainable) {
  const Choice c =
      best(loading, loading_front(), "damage", {at_least("production", 400.0), at_most("damage", 9.0)});
  EXPECT_EQ(c.status, ChoiceStatus::none_meets);
  EXPECT_EQ(c.row, 4);
  EXPECT_NEAR(c.value, 75.0 / 225.0, rounding);
  EXPECT_TRUE(c.ranking.empty());
  EXPECT_EQ(c.message,
            "no point of the front meets the conditions: production is 325 kg/s at best; relax them");
  const Choice both =
      best(loading, loading_front(), "damage", {at_least("production", 310.0), at_most("damage", 5.0)});
  EXPECT_EQ(both.message,
            "no point of the front meets the conditions: each is met somewhere, but nowhere all; relax them");
}

TEST(Filter, AnEmptyFrontHasNoAnswer) {
  const Choice c = best(loading, Front{}, "production");
  EXPECT_EQ(c.status, ChoiceStatus::empty_front);
  EXPECT_EQ(c.row, -1);
}

TEST(Filter, BadInputIsNamed) {
  const auto text = [](const std::string& response, const std::vector<Condition>& conditions) {
    return support::thrown_text<std::invalid_argument>(
        [&] { best(loading, loading_front(), response, conditions); });
  };
  EXPECT_EQ(text("speed", {}),
            "doe::Problem: no response \"speed\"; the responses are \"production\", \"damage\", \"mass\"");
  EXPECT_EQ(
      text("mass", {}),
      "pareto::best: response \"mass\" is only recorded, so no value of it is better than another; give "
      "it a goal or ask with a condition");
  EXPECT_EQ(
      text("damage", {{"mass", Goal::maximize, 1.0}}),
      "pareto::best: condition on \"mass\" is maximize 1; allowed is at_most or at_least a finite limit");
  const doe::Problem other = support::unit_problem(1, 2);
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([&] { best(other, loading_front(), "f0"); }),
      "pareto::best: the front has 2 objectives and 3 responses, the problem has 2 and 2; give the front "
      "of this problem");
}

/// Two straight parts of slopes -4 and -1/4 that meet at (0.2, 0.2), given in other units and signs: the
/// first objective times 10, the second maximised.
const doe::Problem kinked_problem{{{"x", "1", 0.0, 1.0}},
                                  {{"cost", "SEK", Goal::minimize}, {"gain", "kg", Goal::maximize}}};

Front kinked_front() {
  return front_of(table({{10, 0}, {6, -0.1}, {2, -0.2}, {1, -0.6}, {0, -1}}), kinked_problem);
}

// From the kink each unit gained costs four on either side; from a point inside an arm a quarter, towards the
// kink. Its distance from the line between the ends is (1 - 0.4)/√2.
TEST(Knees, AKinkIsTheKneeByBothMeasures) {
  const Knees offer = knees(kinked_problem, kinked_front());
  EXPECT_EQ(offer.status, KneeStatus::found);
  EXPECT_EQ(offer.rows, std::vector<int>{2});
  EXPECT_NEAR(offer.strength[2], 4.0, 10 * rounding);
  EXPECT_NEAR(offer.strength[3], 0.25, rounding);
  EXPECT_NEAR(offer.strength[0], 0.25, rounding);
  const Knees bulge = knees(kinked_problem, kinked_front(), {.measure = KneeMeasure::distance});
  EXPECT_EQ(bulge.rows, std::vector<int>{2});
  EXPECT_NEAR(bulge.strength[2], 0.6 / std::sqrt(2.0), rounding);
  EXPECT_NEAR(bulge.strength[0], 0.0, rounding);
}

/// n points of f_2 = h(f_1), f_1 evenly in [0, 1].
template <class H>
Front sampled_curve(int n, const H& h) {
  Eigen::MatrixXd Y(n, 2);
  for (int i = 0; i < n; ++i) {
    const double x = static_cast<double>(i) / (n - 1);
    Y.row(i) << x, h(x);
  }
  return front_of(Y, support::unit_problem(1, 2));
}

// (1 - √x)²: the tangent parallel to the line between the ends is at x = 1/4. Price of leaving i for k > i on
// a convex curve is least for the nearest, 1/|slope|, and |slope| = (1 - √x)/√x is 1 at x = 1/4 too; on 201
// points that is row 50 within one.
TEST(Knees, ASmoothCurveHasItWhereTheSlopeIsThatOfTheEnds) {
  const doe::Problem problem = support::unit_problem(1, 2);
  const Front curve = sampled_curve(201, [](double x) { return std::pow(1.0 - std::sqrt(x), 2); });
  const Knees bulge = knees(problem, curve, {.measure = KneeMeasure::distance});
  EXPECT_EQ(bulge.rows, std::vector<int>{50});
  const Knees offer = knees(problem, curve);
  ASSERT_EQ(offer.rows.size(), 1u);
  EXPECT_NEAR(offer.rows[0], 50, 1);
}

TEST(Knees, StraightAndHollowFrontsHaveNone) {
  const doe::Problem problem = support::unit_problem(1, 2);
  for (const KneeMeasure measure : {KneeMeasure::distance, KneeMeasure::trade_off}) {
    const Knees straight = knees(problem, sampled_curve(11, [](double x) { return 1.0 - x; }), {measure});
    EXPECT_EQ(straight.status, KneeStatus::no_knee);
    EXPECT_NE(straight.message, "");
    const Front circle = sampled_curve(11, [](double x) { return std::sqrt(1.0 - x * x); });
    EXPECT_EQ(knees(problem, circle, {measure}).status, KneeStatus::no_knee);
  }
}

// Arms of slopes -5, -1/4, -7/2, -1/8 that meet at (0.1, 0.5), (0.5, 0.4), (0.6, 0.05). Among near points
// both bulges stand out: their cheapest moves cost 4, to the right, and 3.5, to the left. Seen from the whole
// front the first costs 0.5/0.45 (to the second) and the second 0.45/0.5 (to the first), so only the first
// remains.
TEST(Knees, NeighboursFindEveryLocalKnee) {
  const doe::Problem problem = support::unit_problem(1, 2);
  const Front front = sampled_curve(101, [](double x) {
    if (x < 0.3) return x < 0.1 ? 1.0 - 5.0 * x : 0.5 - 0.25 * (x - 0.1);
    return x < 0.6 ? std::min(0.525 - 0.25 * x, 0.4 - 3.5 * (x - 0.5)) : 0.125 * (1.0 - x);
  });
  const Knees local = knees(problem, front, {.neighbours = 6});
  EXPECT_EQ(local.rows, (std::vector<int>{10, 60}));
  EXPECT_NEAR(local.strength[60], 3.5, 100 * rounding);
  EXPECT_NEAR(local.strength[10], 4.0, 100 * rounding);
  EXPECT_EQ(knees(problem, front).rows, std::vector<int>{10});
}

TEST(Knees, TwoPointsAreTooFew) {
  const Knees none = knees(support::unit_problem(1, 2), sampled_curve(2, [](double x) { return 1.0 - x; }));
  EXPECT_EQ(none.status, KneeStatus::too_few_points);
  EXPECT_EQ(none.message, "the front has 2 points; a knee needs 3 or more");
}

// On the straight front f_1 + f_2 = 1 the aspiration (a, b) is missed least, in the worse of both, at
// f_1 - a = f_2 - b, f_1 = (1 + a - b)/2: by (1 - a - b)/2.
TEST(Preference, AnAspirationLeadsToThePointOnTheDiagonalThroughIt) {
  const doe::Problem problem = support::unit_problem(1, 2);
  const Front line = sampled_curve(101, [](double x) { return 1.0 - x; });
  const Choice missed = by_aspiration(problem, line, Eigen::Vector2d(0.3, 0.1));
  EXPECT_EQ(missed.row, 60);
  EXPECT_NEAR(missed.value, 0.3, rounding);
  const Choice met = by_aspiration(problem, line, Eigen::Vector2d(0.5, 0.9));
  EXPECT_EQ(met.row, 30);
  EXPECT_NEAR(met.value, -0.2, rounding);
  // A weight three times as large: 3 (f_1 - a) = f_2 - b at f_1 = (1 + 3a - b)/4.
  EXPECT_EQ(by_aspiration(problem, line, Eigen::Vector2d(0.1, 0.1), {.weights = Eigen::Vector2d(3, 1)}).row,
            30);
}

TEST(Preference, UnitsAndSignsAreThoseOfTheProblem) {
  const Choice c = by_aspiration(kinked_problem, kinked_front(), Eigen::Vector2d(2.0, -0.2));
  EXPECT_EQ(c.row, 2);
  EXPECT_NEAR(c.value, 0.0, rounding);
}

// On the circle the sum sees only the ends, which lie nearest to the origin along any line of equal sums; the
// Chebyshev form reaches the dent: equal weights give the point on the diagonal.
TEST(Preference, OnlyChebyshevReachesADent) {
  const doe::Problem problem = support::unit_problem(1, 2);
  Eigen::MatrixXd Y(91, 2);
  for (int i = 0; i <= 90; ++i) Y.row(i) << std::sin(i * M_PI / 180.0), std::cos(i * M_PI / 180.0);
  const Front circle = front_of(Y, problem);
  const Choice sum = by_weights(problem, circle, Eigen::Vector2d(0.55, 0.45), WeightForm::sum);
  EXPECT_EQ(sum.row, 0);
  const Choice chebyshev = by_weights(problem, circle, Eigen::Vector2d(1, 1));
  EXPECT_EQ(chebyshev.row, 45);
  EXPECT_NEAR(chebyshev.value, std::sqrt(0.5), rounding);
}

TEST(Preference, PseudoWeightsOfTheEndsAreAllForOne) {
  const Eigen::MatrixXd W = pseudo_weights(kinked_problem, kinked_front());
  EXPECT_TRUE(W.row(0).isApprox(Eigen::RowVector2d(0, 1), rounding));
  EXPECT_TRUE(W.row(2).isApprox(Eigen::RowVector2d(0.5, 0.5), rounding));
  EXPECT_TRUE(W.row(4).isApprox(Eigen::RowVector2d(1, 0), rounding));
}

TEST(Preference, BadInputIsNamed) {
  const auto text = [](const auto& call) { return support::thrown_text<std::invalid_argument>(call); };
  EXPECT_EQ(text([] { by_aspiration(kinked_problem, kinked_front(), Eigen::Vector3d::Zero()); }),
            "pareto::by_aspiration: aspiration has 3 entries; give one finite number per objective (2)");
  EXPECT_EQ(text([] { by_weights(kinked_problem, kinked_front(), Eigen::Vector2d(1, -1)); }),
            "pareto::by_weights: a weight is -1; allowed is 0 or more");
  EXPECT_EQ(text([] { by_weights(kinked_problem, kinked_front(), Eigen::Vector2d::Zero()); }),
            "pareto::by_weights: all weights are 0; give one at least above 0");
}

TEST(TradeOff, StepsAlongTheFrontHaveTheSlopesOfItsArms) {
  const auto steps = trade_offs_along(kinked_problem, kinked_front());
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_EQ(steps[0].from, 4);  // least cost first
  EXPECT_EQ(steps[3].to, 0);
  EXPECT_NEAR(steps[0].rate(1, 0), 0.4, rounding);  // kg a SEK
  EXPECT_NEAR(steps[0].price(), 0.25, rounding);
  EXPECT_NEAR(steps[3].rate(1, 0), 0.1 / 4.0, rounding);
  EXPECT_NEAR(steps[3].price(), 4.0, 10 * rounding);
}

TEST(TradeOff, NearestNeighboursComeFirst) {
  const auto steps = trade_offs(kinked_problem, kinked_front(), 2, 2);
  ASSERT_EQ(steps.size(), 2u);  // (0.1, 0.6) and (0.6, 0.1) are equally near: the earlier row first
  EXPECT_EQ(steps[0].to, 1);
  EXPECT_EQ(steps[1].to, 3);
  EXPECT_NEAR(steps[0].gain, 0.1, rounding);
  EXPECT_NEAR(steps[0].loss, 0.4, rounding);
  EXPECT_TRUE(steps[1].change.isApprox(Eigen::Vector2d(-1.0, -0.4), rounding));
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([] { trade_offs(kinked_problem, kinked_front(), 5); }),
      "pareto::trade_offs: row is 5; allowed is 0 to the number of points - 1");
}

}  // namespace
