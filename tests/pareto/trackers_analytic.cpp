// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Faults that users of other libraries reported in public, as cases whose answer is known exactly. Each
/// test names the tracker and the number of the report.

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/pareto/crowding.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/indicators.hpp>
#include <drawpoint/pareto/knees.hpp>
#include <drawpoint/pareto/moead.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/nsga3.hpp>
#include <drawpoint/pareto/preference.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::MatrixXd points_of(std::initializer_list<std::pair<double, double>> list) {
  Eigen::MatrixXd Y(static_cast<Eigen::Index>(list.size()), 2);
  Eigen::Index i = 0;
  for (const auto& [a, b] : list) Y.row(i++) << a, b;
  return Y;
}

/// A front of these objectives, all minimised, that are all responses of its problem.
Front front_of(const Eigen::MatrixXd& Y) {
  Front front;
  front.X = Eigen::MatrixXd::Zero(Y.rows(), 1);
  front.Y = front.responses = Y;
  for (int j = 0; j < static_cast<int>(Y.cols()); ++j) front.objectives.push_back(support::numbered("f", j));
  return front;
}

/// Whole numbers below the reference: how many unit cells lie between one of the points and the reference.
int counted_cells(const Eigen::MatrixXd& Y, const Eigen::Vector3d& reference) {
  int cells = 0;
  for (double a = 0; a < reference[0]; ++a)
    for (double b = 0; b < reference[1]; ++b)
      for (double c = 0; c < reference[2]; ++c)
        cells += ((Y.rowwise() - Eigen::RowVector3d(a, b, c)).array() <= 0.0).rowwise().all().any();
  return cells;
}

/// Every search with the same number of points, after the same number of generations.
template <class F>
std::vector<std::pair<std::string, Front>> fronts_of_searches(const F& f, const doe::Problem& problem,
                                                              int generations) {
  const SearchOptions search{.population = 20, .stopping = {.generations = generations}};
  return {{"nsga2", nsga2(f, problem, {.search = search})},
          {"nsga3", nsga3(f, problem, {.search = search})},
          {"sms_emoa", sms_emoa(f, problem, {.search = search})},
          {"moead", moead(f, problem, {.search = search})},
          {"moead_pbi", moead(f, problem, {.search = search, .scalarisation = Scalarisation::pbi})}};
}

}  // namespace

// optuna/optuna #3743: crowding distances were wrong where an objective was infinite, as inf/inf. A distance
// is a sum of shares, so it lies in [0, inf]. Where only the range overflows, it is known: the middle of
// −1e308, 0 and 1e308 has the whole range between its neighbours in both objectives, 1 + 1.
TEST(Trackers, CrowdingOfBoundlessObjectivesIsANumber) {
  EXPECT_EQ(crowding_distance(points_of({{-1e308, 2}, {0, 1}, {1e308, 0}})),
            Eigen::Vector3d(infinity, 2.0, infinity));
  for (const auto& Y : {points_of({{0, infinity}, {1, 4}, {3, 2}, {7, 1}, {8, 0}}),
                        points_of({{-infinity, 8}, {1, 4}, {3, 2}, {7, 1}, {8, 0}}),
                        points_of({{-infinity, infinity}, {1, 4}, {3, 2}, {7, 1}, {infinity, -infinity}})}) {
    const Eigen::VectorXd distance = crowding_distance(Y);
    EXPECT_EQ(distance[0], infinity) << "an extreme";
    EXPECT_EQ(distance[4], infinity) << "an extreme";
    for (const double d : distance) EXPECT_GE(d, 0.0) << "NaN is not";
  }
}

// MOEAFramework/MOEAFramework #182: of two sets the worse had the larger hypervolume, for each was scaled by
// itself. Against one reference the set that dominates has more. The sets differ in the slab of second
// objectives 150 to 151 alone, where all of 8·8 cells are covered instead of 7·7 by (27, 145, 27) and 6 more
// by (28, 150, 26): 9 cells. Whole numbers: both volumes are counts of cells.
TEST(Trackers, ABetterPointEnlargesTheVolumeOfOneReference) {
  Eigen::MatrixXd worse(8, 3), better(7, 3);
  worse << 26, 151, 26, 27, 145, 27, 28, 144, 28, 28, 150, 26, 29, 143, 29, 30, 142, 30, 31, 141, 31, 33, 140,
      33;
  better << 26, 150, 26, 27, 145, 27, 28, 144, 28, 29, 143, 29, 30, 142, 30, 31, 141, 31, 33, 140, 33;
  const Eigen::RowVector3d origin(20, 135, 20);
  const Eigen::Vector3d reference(34, 152, 34);
  const double of_worse = hypervolume(worse, reference), of_better = hypervolume(better, reference);
  EXPECT_EQ(of_worse, counted_cells(worse.rowwise() - origin, reference - origin.transpose()));
  EXPECT_EQ(of_better, counted_cells(better.rowwise() - origin, reference - origin.transpose()));
  EXPECT_EQ(of_better - of_worse, 9.0);
}

// multi-objective/moocore #72: distances in more than 31 columns overran a buffer, and crashed or came out
// wrong. From the origin to (1, ..., 1) in 48 objectives it is √48, all of it worse, and a shift of 1 covers
// the origin. That point and the origin but for one entry of 2 do not dominate each other, and the origin
// dominates both.
TEST(Trackers, FortyEightObjectivesAreMeasured) {
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(1, 48), origin = Eigen::MatrixXd::Zero(1, 48);
  EXPECT_DOUBLE_EQ(igd(ones, origin), std::sqrt(48.0));
  EXPECT_DOUBLE_EQ(igd_plus(ones, origin), std::sqrt(48.0));
  EXPECT_EQ(igd_plus(origin, ones), 0.0);
  EXPECT_EQ(additive_epsilon(ones, origin), 1.0);
  EXPECT_EQ(additive_epsilon(origin, ones), -1.0);
  Eigen::MatrixXd Y(3, 48);
  Y << ones, origin, origin;
  Y(2, 47) = 2.0;
  EXPECT_EQ(non_dominated_sort(Y), (std::vector<std::vector<int>>{{1}, {0, 2}}));
}

// DEAP/deap #534 (as #661 and Project-Platypus/Platypus #112): NSGA-III divided by zero where one point is
// the extreme of several objectives. Here two objectives fall together and the third never varies, so that
// the best point met dominates all others and the front has its values alone. The objectives are a bowl in
// [-1, 1]²: a tenth from its middle, which 40 generations of 20 points are to reach, lies π/400 of the square,
// of which 800 random points would meet six.
TEST(Trackers, ObjectivesThatFallTogetherHaveOneBestPoint) {
  doe::Problem problem = support::unit_problem(2, 3);
  for (doe::Variable& v : problem.variables) v.lower = -1.0;
  const auto f = [](const Eigen::VectorXd& x) -> doe::Outcome {
    return {x.squaredNorm(), 3.0 * x.squaredNorm(), 7.0};
  };
  for (const auto& [name, front] : fronts_of_searches(f, problem, 40)) {
    ASSERT_EQ(front.status, SearchStatus::completed) << name << ": " << front.message;
    ASSERT_GE(front.Y.rows(), 1) << name;
    EXPECT_EQ(front.failed, 0) << name;
    for (const auto& y : front.Y.rowwise()) {
      EXPECT_EQ(y, front.Y.row(0)) << name << ": all others are dominated";
      EXPECT_EQ(y[1], 3.0 * y[0]) << name;
      EXPECT_EQ(y[2], 7.0) << name;
      EXPECT_LT(y[0], 0.01) << name;
    }
  }
}

// jMetal/jMetal #118 (as MOEAFramework/MOEAFramework #18): IGD took √(Σ d²)/k for the mean of d. Distances of
// 3 and 4 tell them apart: their mean is 3.5, the other 2.5. (0, 3) is worse than either point by 3 alone,
// which is what IGD+ counts.
TEST(Trackers, IgdIsTheMeanOfTheDistancesNotTheRootOfTheirSquares) {
  EXPECT_EQ(igd(points_of({{0, 3}, {104, 0}}), points_of({{0, 0}, {100, 0}})), 3.5);
  EXPECT_EQ(igd_plus(points_of({{0, 3}, {104, 0}}), points_of({{0, 0}, {100, 0}})), 3.0);
}

// anyoptimization/pymoo #153: a user asked which IGD is computed, and was led to the example of Ishibuchi,
// Masuda, Tanigaki and Nojima 2015. Each point of A dominates one of B; by hand, point of Z by point, IGD is
// √40, √5, √2, √5, √40 for A and √8, √5, √8, √5, √8 for B, so that it prefers B, and IGD+ is 2, 1, √2, 1, 2
// and 2, √5, √8, √5, 2.
TEST(Trackers, IgdPlusPrefersTheSetThatDominates) {
  const Eigen::MatrixXd A = points_of({{2, 4}, {3, 3}, {4, 2}}), B = points_of({{2, 8}, {4, 4}, {8, 2}}),
                        Z = points_of({{0, 10}, {1, 6}, {2, 2}, {6, 1}, {10, 0}});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(dominates(A.row(i), B.row(i)));
  const double root2 = std::sqrt(2.0), root5 = std::sqrt(5.0), root8 = std::sqrt(8.0),
               root40 = std::sqrt(40.0);
  EXPECT_DOUBLE_EQ(igd(A, Z), (2 * root40 + 2 * root5 + root2) / 5);
  EXPECT_DOUBLE_EQ(igd(B, Z), (3 * root8 + 2 * root5) / 5);
  EXPECT_DOUBLE_EQ(igd_plus(A, Z), (6 + root2) / 5);
  EXPECT_DOUBLE_EQ(igd_plus(B, Z), (4 + 2 * root5 + root8) / 5);
  EXPECT_GT(igd(A, Z), igd(B, Z));
  EXPECT_LT(igd_plus(A, Z), igd_plus(B, Z));
}

// mlr-org/mlr3fselect #171 (as anyoptimization/pymoo #637): a front of one value in an objective was scaled
// by a range of 0, and its knee was not a number. An objective that all points share says nothing: the knees
// are those of the others, and so is the point that equal weights choose. The shares of pseudo weights are 1
// − F over their sum, with F = 0 for that objective: (0, 1, 1)/2 at the worst of the first and the best of
// the second.
TEST(Trackers, AnObjectiveThatAllPointsShareMovesNoChoice) {
  const Eigen::MatrixXd two = points_of({{0, 8}, {1, 2}, {4, 1}, {8, 0}});
  Eigen::MatrixXd three(4, 3);
  three << two, Eigen::VectorXd::Constant(4, 5.0);
  const doe::Problem of_two = support::unit_problem(1, 2), of_three = support::unit_problem(1, 3);
  for (const KneeMeasure measure : {KneeMeasure::distance, KneeMeasure::trade_off}) {
    const Knees knee = knees(of_three, front_of(three), {.measure = measure});
    EXPECT_EQ(knee.rows, knees(of_two, front_of(two), {.measure = measure}).rows);
    EXPECT_EQ(knee.rows, std::vector<int>{1});
  }
  for (const WeightForm form : {WeightForm::chebyshev, WeightForm::sum})
    EXPECT_EQ(by_weights(of_three, front_of(three), Eigen::Vector3d::Ones(), form).row, 1);
  const Eigen::MatrixXd W = pseudo_weights(of_three, front_of(three));
  EXPECT_EQ(W.row(0), Eigen::RowVector3d(0.5, 0.0, 0.5));
  EXPECT_EQ(W.row(3), Eigen::RowVector3d(0.0, 0.5, 0.5));
}

// mlr-org/mlr3fselect #171 once more: a front without any range. Three copies of one point are one point, of
// which there is no line through two ends to bulge from and no move to refuse, so that none of them is a
// knee.
TEST(Trackers, CopiesOfOnePointHaveNoKnee) {
  const doe::Problem problem = support::unit_problem(1, 2);
  for (const KneeMeasure measure : {KneeMeasure::distance, KneeMeasure::trade_off}) {
    const Knees knee = knees(problem, front_of(Eigen::MatrixXd::Constant(3, 2, 1.5)), {.measure = measure});
    EXPECT_NE(knee.status, KneeStatus::found);
    EXPECT_TRUE(knee.rows.empty());
    EXPECT_FALSE(knee.message.empty());
  }
}

// scipy/scipy #21114: a distance overflowed although it is a number of its own, because powers of its parts
// did not fit. IGD is a length: times a power of two, which rounds nothing, it is the same length in that
// unit, also where its square is beyond 1e308 or below 1e-308. From (3, 4) to the origin it is 5, and to (0,
// 4) it is 3.
TEST(Trackers, IgdHasTheUnitOfTheObjectives) {
  const Eigen::MatrixXd Y = points_of({{3, 4}}), Z = points_of({{0, 0}, {0, 4}});
  for (const int power : {-700, -300, 0, 300, 700}) {
    const double unit = std::ldexp(1.0, power);
    EXPECT_EQ(igd(unit * Y, unit * Z), 4.0 * unit) << "2^" << power;
    EXPECT_EQ(igd_plus(unit * Y, unit * Z), 4.0 * unit) << "2^" << power;
    EXPECT_EQ(additive_epsilon(unit * Y, unit * Z), 4.0 * unit) << "2^" << power;
  }
}
