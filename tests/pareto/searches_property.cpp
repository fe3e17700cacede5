// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/pareto/moead.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/nsga3.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <functional>
#include <numeric>
#include <ostream>
#include <string>

/// Laws that every search keeps, stated once.

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

struct Control {
  int generations = 40;
  doe::Seed seed = 1;
};

using BlackBox = std::function<doe::Outcome(const Eigen::VectorXd&)>;
using Search = std::function<Front(const BlackBox&, const doe::Problem&, const Control&)>;

struct Named {
  std::string name;
  Search search;
};

void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }

template <class Options>
Options with(const Control& c, Options options = {}) {
  options.search.population = 40;
  options.search.stopping.generations = c.generations;
  options.search.seed = c.seed;
  return options;
}

std::vector<Named> all_searches() {
  return {
      {"nsga2", [](auto& f, auto& p, auto& c) { return nsga2(f, p, with<Nsga2Options>(c)); }},
      {"nsga2_geometric",
       [](auto& f, auto& p, auto& c) {
         return nsga2(f, p, with<Nsga2Options>(c, {.elitism = Elitism::geometric}));
       }},
      {"nsga2_fraction",
       [](auto& f, auto& p, auto& c) {
         return nsga2(f, p, with<Nsga2Options>(c, {.elitism = Elitism::pareto_fraction}));
       }},
      {"nsga3", [](auto& f, auto& p, auto& c) { return nsga3(f, p, with<Nsga3Options>(c)); }},
      {"sms_emoa", [](auto& f, auto& p, auto& c) { return sms_emoa(f, p, with<SmsEmoaOptions>(c)); }},
      {"sms_emoa_batch",
       [](auto& f, auto& p, auto& c) { return sms_emoa(f, p, with<SmsEmoaOptions>(c, {.children = 8})); }},
      {"moead", [](auto& f, auto& p, auto& c) { return moead(f, p, with<MoeadOptions>(c)); }},
      {"moead_pbi",
       [](auto& f, auto& p, auto& c) {
         return moead(f, p, with<MoeadOptions>(c, {.scalarisation = Scalarisation::pbi}));
       }},
  };
}

class Searches : public testing::TestWithParam<Named> {};

/// Cost and yield of x in [0, 10] x [-1, 1]; trade-off along x_0, with x_1 = 0 best; yield is maximised.
doe::Outcome cost_and_yield(const Eigen::VectorXd& x) {
  return {x[0] + x[1] * x[1], std::sqrt(x[0]) - x[1] * x[1], x[0] - 2.0 * x[1]};
}

doe::Problem cost_problem(doe::Response third = {"third", "1", doe::Goal::record}) {
  return {{{"x0", "m", 0.0, 10.0}, {"x1", "m", -1.0, 1.0}},
          {{"cost", "kg", doe::Goal::minimize}, {"yield", "kg/s", doe::Goal::maximize}, third}};
}

TEST_P(Searches, GiveConsistentNonDominatedPointsOfTheBox) {
  const Front front = GetParam().search(cost_and_yield, cost_problem(), {});
  EXPECT_EQ(front.status, SearchStatus::completed);
  EXPECT_EQ(front.evaluations, 40 * 41);
  EXPECT_EQ(front.generations, 40);
  ASSERT_GT(front.X.rows(), 20);
  ASSERT_LE(front.X.rows(), 40);
  for (Eigen::Index i = 0; i < front.X.rows(); ++i) {
    const Eigen::VectorXd x = front.X.row(i);
    EXPECT_EQ(front.responses.row(i).transpose(), cost_and_yield(x).values());
    EXPECT_TRUE(x[0] >= 0.0 && x[0] <= 10.0 && x[1] >= -1.0 && x[1] <= 1.0);
  }
  const std::vector<int> best = non_dominated(front.Y * Eigen::Vector2d(1.0, -1.0).asDiagonal());
  EXPECT_EQ(static_cast<Eigen::Index>(best.size()), front.X.rows());
}

TEST_P(Searches, SameSeedSameFrontOtherSeedAnother) {
  const auto front = [](doe::Seed seed) {
    return GetParam().search(cost_and_yield, cost_problem(), {.generations = 10, .seed = seed}).X;
  };
  EXPECT_EQ(front(1), front(1));
  EXPECT_NE(front(1), front(2));
}

// at_most 4 on x_0 - 2 x_1 cuts the front where x_1 has to rise.
TEST_P(Searches, KeepALimitAndReachIt) {
  const Front front =
      GetParam().search(cost_and_yield, cost_problem({"slope", "m", doe::Goal::at_most, 4.0}), {});
  ASSERT_GT(front.X.rows(), 10);
  EXPECT_LE(front.responses.col(2).maxCoeff(), 4.0);
  EXPECT_GT(front.responses.col(2).maxCoeff(), 3.5);
}

TEST_P(Searches, LeaveAFailingHalfOfTheBox) {
  const auto f = [](const Eigen::VectorXd& x) -> doe::Outcome {
    if (x[0] < 5.0) return doe::Failure{"stuck"};
    return cost_and_yield(x);
  };
  const Front front = GetParam().search(f, cost_problem(), {});
  EXPECT_EQ(front.status, SearchStatus::completed);
  EXPECT_GT(front.failed, 0);
  EXPECT_LT(front.failed, front.evaluations / 2);
  EXPECT_GE(front.X.col(0).minCoeff(), 5.0);
}

// Pieces n in 1..9 and a switch s in {0, 1}, both of kind integer: cost n + 4 (1 - s), time 12/n: the front
// is s = 1 and each n, nine points. All of them are found; MOEA/D by PBI owes only those that are best for
// one of its directions.
TEST_P(Searches, FindEveryPointOfASmallIntegerFront) {
  const doe::Problem problem{
      {doe::integer_variable("n", "1", 1, 9), {"x", "m", -1.0, 1.0}, doe::integer_variable("s", "1", 0, 1)},
      {{"cost", "kg", doe::Goal::minimize}, {"time", "s", doe::Goal::minimize}}};
  const auto f = [](const Eigen::VectorXd& x) -> doe::Outcome {
    EXPECT_EQ(x[0], std::round(x[0]));
    EXPECT_TRUE(x[2] == 0.0 || x[2] == 1.0);
    return {x[0] + 4.0 * (1.0 - x[2]) + 1e-3 * x[1] * x[1], 12.0 / x[0]};
  };
  const Front front = GetParam().search(f, problem, {.generations = 60});
  std::vector<int> found(10, 0);
  for (const auto& x : front.X.rowwise()) {
    EXPECT_EQ(x[2], 1.0);
    found[static_cast<std::size_t>(x[0])] = 1;
  }
  const int count = std::accumulate(found.begin(), found.end(), 0);
  if (GetParam().name == "moead_pbi") {
    EXPECT_GE(count, 3);  // the two ends and something between
  } else {
    EXPECT_EQ(count, 9);
  }
}

TEST_P(Searches, SayWhenNothingCameOut) {
  const Front none = GetParam().search([](const Eigen::VectorXd&) { return doe::Failure{"no licence"}; },
                                       cost_problem(), {.generations = 2});
  EXPECT_EQ(none.status, SearchStatus::all_failed);
  EXPECT_EQ(none.X.rows(), 0);
  const Front infeasible = GetParam().search(
      cost_and_yield, cost_problem({"third", "m", doe::Goal::at_least, 1e3}), {.generations = 2});
  EXPECT_EQ(infeasible.status, SearchStatus::no_feasible_point);
}

INSTANTIATE_TEST_SUITE_P(All, Searches, testing::ValuesIn(all_searches()),
                         [](const auto& info) { return info.param.name; });

TEST(Searches, BadOptionsAreNamed) {
  const auto text = [](const auto& search) {
    return support::thrown_text<std::invalid_argument>([&] { search(); });
  };
  const doe::Problem problem = cost_problem();
  EXPECT_EQ(text([&] { sms_emoa(cost_and_yield, problem, {.children = 0}); }),
            "pareto::sms_emoa: children is 0; allowed is 1 to population");
  EXPECT_EQ(text([&] { sms_emoa(cost_and_yield, support::unit_problem(2, 9)); }),
            "pareto::sms_emoa: number of objectives is 9; allowed is up to 8; use pareto::nsga3");
  EXPECT_EQ(text([&] { nsga3(cost_and_yield, problem, {.directions = Eigen::MatrixXd::Ones(4, 3)}); }),
            "pareto::nsga3: directions has 3 columns; the problem has 2 objectives");
  EXPECT_EQ(
      text([&] { nsga3(cost_and_yield, problem, {.directions = Eigen::MatrixXd::Zero(4, 2)}); }),
      "pareto::nsga3: directions holds a row that points nowhere; allowed are numbers from 0 up, with at "
      "least one above 0 in each row");
  EXPECT_EQ(text([&] { moead(cost_and_yield, problem, {.neighbours = 1}); }),
            "pareto::moead: neighbours is 1; allowed is 2 or more");
  EXPECT_EQ(text([&] { moead(cost_and_yield, problem, {.penalty = 0.0}); }),
            "pareto::moead: penalty is 0; allowed is above 0");
}

}  // namespace

// Units of objectives are no reason for another choice. Powers of two change no digit, so the same points must
// come out to the bit; a range whose inverse is infinite must not end the search.
TEST_P(Searches, DoNotFollowUnits) {
  const auto bowls = [](const Eigen::RowVector3d& unit) {
    return [unit](const Eigen::VectorXd& x) -> doe::Outcome {
      const double rest = (x[2] - 0.5) * (x[2] - 0.5), a = x[0] * M_PI_2, b = x[1] * M_PI_2;
      return {unit[0] * (1 + rest) * std::cos(a) * std::cos(b),
              unit[1] * (1 + rest) * std::cos(a) * std::sin(b), unit[2] * (1 + rest) * std::sin(a)};
    };
  };
  doe::Problem problem{.variables = {{"a", "1", 0, 1}, {"b", "1", 0, 1}, {"c", "1", 0, 1}}, .responses = {}};
  for (const char* name : {"f", "g", "h"}) problem.responses.push_back({name, "1", doe::Goal::minimize});
  const Front front = GetParam().search(bowls({1, 1, 1}), problem, {});
  for (const Eigen::RowVector3d& power : {Eigen::RowVector3d(0, 13, 27), Eigen::RowVector3d(-80, 0, -27)})
    EXPECT_EQ(GetParam().search(bowls(power.unaryExpr([](double p) { return std::exp2(p); })), problem, {}).X,
              front.X)
        << "units of 2^" << power;
  EXPECT_NO_THROW(GetParam().search(bowls({1, 1, 1e-310}), problem, {}));
}
