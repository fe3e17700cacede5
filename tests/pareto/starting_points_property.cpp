// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Laws of a search that is given points to start from, for every search.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <drawpoint/pareto/detail/stable_matching.hpp>
#include <drawpoint/pareto/moead.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/nsga3.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/pareto/named_searches.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <set>
#include <string>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

using test::Named;
using test::named;

std::vector<Named> all_searches() {
  return {named<Nsga2>("nsga2", Nsga2Options{}),
          named<Nsga2>("nsga2_geometric", Nsga2Options{.elitism = Elitism::geometric}),
          named<Nsga3>("nsga3", Nsga3Options{}),
          named<SmsEmoa>("sms_emoa", SmsEmoaOptions{}),
          named<SmsEmoa>("sms_emoa_batch", SmsEmoaOptions{.children = 5}),
          named<Moead>("moead", MoeadOptions{}),
          named<Moead>("moead_pbi", MoeadOptions{.scalarisation = Scalarisation::pbi})};
}

/// Every kind of variable, on ranges whose ends are no powers of two; x alone trades cost for yield.
const doe::Problem mixed{{{"x", "m", -0.3, 0.7},
                          {"y", "mm", 1.7, 9.9},
                          doe::integer_variable("n", "1", -2, 5),
                          doe::categorical_variable("steel", {"mild", "hard", "cast"})},
                         {{"cost", "kg", doe::Goal::minimize},
                          {"yield", "kg/s", doe::Goal::maximize},
                          {"slope", "m", doe::Goal::at_most, 20.0}}};

/// Best: y = 5 mm, n = 3, hard steel.
doe::Outcome cost_and_yield(const Eigen::VectorXd& x, doe::Seed seed) {
  if (x[0] > 0.6 && x[1] > 9.0) return doe::Failure{"stuck"};
  const double waste = (x[1] - 5.0) * (x[1] - 5.0) + std::abs(x[2] - 3.0) + (x[3] == 1.0 ? 0.0 : 1.0);
  const double noise = 1e-9 * doe::RandomStream(seed).uniform();
  return {x[0] + waste + noise, std::sqrt(x[0] + 0.3) - waste, 10.0 * x[0] + x[1]};
}

/// k x 4: evenly along the best points of `mixed`.
Eigen::MatrixXd best_points(int k) {
  Eigen::MatrixXd X(k, 4);
  for (int i = 0; i < k; ++i) X.row(i) << -0.3 + (i + 0.1) / k, 5.0, 3.0, 1.0;
  return X;
}

SearchOptions from(const Eigen::MatrixXd& start, int threads = 1) {
  return {.population = 20,
          .start = start,
          .stopping = {.generations = 6, .stall_generations = 6},
          .seed = 7,
          .threads = threads};
}

std::set<std::vector<double>> points_of(const Eigen::MatrixXd& X) {
  std::set<std::vector<double>> points;
  for (const auto& x : X.rowwise()) points.emplace(x.begin(), x.end());
  return points;
}

void advance(Search& search) {
  std::vector<doe::Outcome> outcomes;
  const Eigen::MatrixXd X = search.ask();
  const std::vector<doe::Seed> seeds = search.seeds();
  for (std::size_t i = 0; i < seeds.size(); ++i)
    outcomes.push_back(cost_and_yield(X.row(static_cast<Eigen::Index>(i)).transpose(), seeds[i]));
  search.tell(outcomes);
}

class StartedSearches : public testing::TestWithParam<Named> {
 protected:
  std::unique_ptr<Search> made(const SearchOptions& options) const { return GetParam().make(mixed, options); }
};

// Decimals that x = lower + u (upper - lower) does not reach for any double u are among them.
TEST_P(StartedSearches, AskForThePointsAsTheyWereGivenAndFillUp) {
  Eigen::MatrixXd start = best_points(7);
  start.col(0) << -0.3, 1e-17, 0.1, 0.2, 1.0 / 3.0, 0.7 - 1e-16, 0.7;
  const Eigen::MatrixXd X = made(from(start))->ask();
  ASSERT_EQ(X.rows(), 20);
  EXPECT_EQ(X.topRows(7), start);
  for (Eigen::Index i = 7; i < 20; ++i)
    for (Eigen::Index j = 0; j < 4; ++j) {
      const doe::Variable& v = mixed.variables[static_cast<std::size_t>(j)];
      EXPECT_TRUE(X(i, j) >= v.lower && X(i, j) <= v.upper);
      if (j > 1) {
        EXPECT_EQ(X(i, j), std::round(X(i, j)));
      }
    }
  EXPECT_EQ(points_of(X).size(), 20U);
}

// The thirteen that fill up are a Latin hypercube: of y one in each thirteenth of its range.
TEST_P(StartedSearches, FillUpWithALatinHypercube) {
  const Eigen::VectorXd y = made(from(best_points(7)))->ask().bottomRows(13).col(1);
  std::set<int> strata;
  for (const double value : y) strata.insert(static_cast<int>(std::floor((value - 1.7) / 8.2 * 13.0)));
  EXPECT_EQ(strata.size(), 13U);
}

// What the front holds of the start has the value that was given, and the responses of that value.
TEST_P(StartedSearches, KeepTheBestOfTheStart) {
  const auto search = made(from(best_points(10)));
  advance(*search);
  const Front front = search->front();
  EXPECT_EQ(points_of(front.X.topRows(front.X.rows())), points_of(best_points(10)));
  for (Eigen::Index i = 0; i < front.X.rows(); ++i)
    EXPECT_NEAR(front.Y(i, 0), front.X(i, 0), 1e-9);  // waste 0, noise below 1e-9
}

// All are evaluated at once; those that the search ranks best become its population.
TEST_P(StartedSearches, EvaluateMoreThanAPopulationAndKeepTheBest) {
  Eigen::MatrixXd start(50, 4);
  start.topRows(30) = made(from(Eigen::MatrixXd()))->ask().topRows(15).replicate(2, 1);
  start.topRows(30).col(1).setConstant(9.5);  // waste above 20: all dominated by the others
  start.bottomRows(20) = best_points(20);
  const auto search = made(from(start));
  EXPECT_EQ(search->ask(), start);
  EXPECT_EQ(search->seeds().size(), 50U);
  advance(*search);
  EXPECT_EQ(search->front().evaluations, 50);
  EXPECT_EQ(search->front().generations, 0);
  EXPECT_EQ(points_of(search->front().X), points_of(best_points(20)));
  EXPECT_LE(search->ask().rows(), 20);
  const Front end = finish(*search, cost_and_yield);
  EXPECT_EQ(end.evaluations, 50 + 6 * 20);
  EXPECT_EQ(end.generations, 6);
  EXPECT_LE(end.X.rows(), 20);
}

TEST_P(StartedSearches, GiveTheSameBitsOnAnyNumberOfThreads) {
  for (const int count : {3, 30}) {
    const Front front = finish(*made(from(best_points(count))), cost_and_yield);
    for (const int threads : {2, 3, 8}) {
      const Front other = finish(*made(from(best_points(count), threads)), cost_and_yield);
      EXPECT_EQ(other.X, front.X);
      EXPECT_EQ(other.responses, front.responses);
      EXPECT_EQ(other.evaluations, front.evaluations);
      EXPECT_EQ(other.failed, front.failed);
    }
  }
}

TEST_P(StartedSearches, WithoutPointsStartAsEver) {
  SearchOptions plain = from(Eigen::MatrixXd());
  const Eigen::MatrixXd empty(0, 4);
  EXPECT_EQ(made(plain)->ask(), made(from(empty))->ask());
  EXPECT_EQ(finish(*made(plain), cost_and_yield).X, finish(*made(from(empty)), cost_and_yield).X);
}

TEST_P(StartedSearches, SavedAndResumedGoOnToTheSameBits) {
  const auto path =
      std::filesystem::temp_directory_path() / ("drawpoint-start-" + std::to_string(::getpid()) + ".txt");
  for (const int count : {7, 30}) {
    const auto search = made(from(best_points(count)));
    for (int told = 0; told < 2; ++told) {
      search->save(path);
      const auto resumed = made(from(best_points(count)));
      resumed->restore(path);
      EXPECT_EQ(finish(*resumed, cost_and_yield).X,
                finish(*made(from(best_points(count))), cost_and_yield).X);
      advance(*search);
    }
    const auto other = made(from(best_points(count + 1)));
    EXPECT_NE(support::thrown_text<std::runtime_error>([&] { other->restore(path); }).find("option start"),
              std::string::npos);
  }
  std::filesystem::remove(path);
}

TEST_P(StartedSearches, RefusePointsOutsideOfTheBox) {
  const auto text = [&](Eigen::Index column, double value) {
    Eigen::MatrixXd start = best_points(5);
    start(3, column) = value;
    const std::string whole = support::thrown_text<std::invalid_argument>([&] { made(from(start)); });
    EXPECT_EQ(whole.find("pareto::"), 0U);
    return whole.substr(whole.find(": ") + 2);
  };
  EXPECT_EQ(
      text(0, 0.8),
      "start: row 3, variable \"x\": 0.8 m is not within -0.3 m to 0.7 m; correct the point or the bounds");
  EXPECT_EQ(
      text(1, NAN),
      "start: row 3, variable \"y\": nan mm is not within 1.7 mm to 9.9 mm; correct the point or the bounds");
  EXPECT_EQ(text(2, 1.5),
            "start: row 3, variable \"n\": 1.5 is not a whole number from -2 to 5; correct the point or the "
            "bounds");
  EXPECT_EQ(text(3, 3.0),
            "start: row 3, variable \"steel\": 3 is not a whole number from 0 to 2; correct the point or the "
            "bounds");
}

TEST_P(StartedSearches, RefusePointsOfAnotherProblem) {
  const std::string text =
      support::thrown_text<std::invalid_argument>([&] { made(from(Eigen::MatrixXd::Zero(5, 3))); });
  EXPECT_NE(text.find("start: X has 3 columns, the problem has 4 variables"), std::string::npos);
}

// ZDT4 has 21^9 local fronts. 40 generations from random points end on one of them, with f_2 well above 1.
// From three points of the true front, x_2..x_10 in the middle, no search falls behind what these dominate:
// 1.05·(1.1 - f_2(0.05)) + 0.7·(f_2(0.05) - f_2(0.4)) + 0.15·(f_2(0.4) - f_2(0.95)), f_2 = 1 - sqrt(x_1).
// MOEA/D by PBI does: scaled by the worst member, f_2 of some 200, its sum takes any smaller f_1 for better.
TEST_P(StartedSearches, GoOnFromAFewPointsOfTheTrueFront) {
  if (GetParam().name == "moead_pbi") return;
  Eigen::MatrixXd start = Eigen::MatrixXd::Constant(3, 10, 0.5);
  start.col(0) << 0.05, 0.4, 0.95;
  const auto volume = [&](const Eigen::MatrixXd& given) {
    const auto search = GetParam().make(support::unit_problem(10, 2),
                                        {.population = 40, .start = given, .stopping = {.generations = 40}});
    return hypervolume(finish(*search, support::zdt4).Y, Eigen::Vector2d(1.1, 1.1));
  };
  EXPECT_LT(volume(Eigen::MatrixXd()), 0.1);
  const double a = 1.0 - std::sqrt(0.05), b = 1.0 - std::sqrt(0.4), c = 1.0 - std::sqrt(0.95);
  EXPECT_GT(volume(start), 1.05 * (1.1 - a) + 0.7 * (a - b) + 0.15 * (b - c));
}

INSTANTIATE_TEST_SUITE_P(All, StartedSearches, testing::ValuesIn(all_searches()),
                         [](const auto& info) { return info.param.name; });

// All directions would have point 0, which lies nearer to the second; the first is left with its second
// choice, and the third, who also lost point 0 and then point 2 to the first, with its last.
TEST(StableMatching, NobodyWouldRatherHaveEachOther) {
  Eigen::MatrixXd distance(3, 4);
  distance << 0.5, 0.9, 0.2, 0.1,  //
      0.1, 0.9, 0.3, 0.1,          //
      0.7, 0.9, 0.4, 0.1;
  const std::vector<std::vector<int>> choices{{0, 2, 1, 3}, {0, 1, 2, 3}, {0, 2, 1, 3}};
  EXPECT_EQ(detail::stable_matching(choices, distance), (std::vector<int>{2, 0, 1}));
}

}  // namespace
