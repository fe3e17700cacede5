// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <drawpoint/tests/pareto/test_functions.hpp>
#include <stop_token>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

/// Cost and yield of x in [0, 10] x [-1, 1]; trade-off along x_0, with x_1 = 0 best; yield is maximised.
doe::Outcome cost_and_yield(const Eigen::VectorXd& x) {
  return {x[0] + x[1] * x[1], std::sqrt(x[0]) - x[1] * x[1], x[0] - 2.0 * x[1]};
}

doe::Problem cost_problem(doe::Response third = {"third", "1", doe::Goal::record}) {
  return {{{"x0", "m", 0.0, 10.0}, {"x1", "m", -1.0, 1.0}},
          {{"cost", "kg", doe::Goal::minimize}, {"yield", "kg/s", doe::Goal::maximize}, third}};
}

const Nsga2Options quick{.search = {.population = 40, .stopping = {.generations = 40}}};

void expect_equal(const Front& a, const Front& b) {
  EXPECT_EQ(a.X, b.X);
  EXPECT_EQ(a.Y, b.Y);
  EXPECT_EQ(a.responses, b.responses);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.failed, b.failed);
}

TEST(Nsga2, TheFrontIsInNaturalUnitsAndSignAndConsistent) {
  const doe::Problem problem = cost_problem();
  const Front front = nsga2(cost_and_yield, problem, quick);
  EXPECT_EQ(front.status, SearchStatus::completed);
  EXPECT_EQ(front.message, "");
  EXPECT_EQ(front.evaluations, 40 * 41);
  EXPECT_EQ(front.objectives, (std::vector<std::string>{"cost", "yield"}));
  ASSERT_EQ(front.X.rows(), 40);
  for (Eigen::Index i = 0; i < front.X.rows(); ++i) {
    const Eigen::VectorXd x = front.X.row(i);
    EXPECT_EQ(front.responses.row(i).transpose(), cost_and_yield(x).values());
    EXPECT_EQ(front.Y.row(i), front.responses.row(i).head(2));
    EXPECT_TRUE(x[0] >= 0.0 && x[0] <= 10.0 && x[1] >= -1.0 && x[1] <= 1.0);
  }
  EXPECT_EQ(non_dominated(front.Y * Eigen::Vector2d(1.0, -1.0).asDiagonal()).size(), 40U);
  for (Eigen::Index i = 1; i < 40; ++i) EXPECT_GT(front.Y(i, 0), front.Y(i - 1, 0));
}

TEST(Nsga2, SameSeedSameFrontOtherSeedAnother) {
  const doe::Problem problem = cost_problem();
  const Front front = nsga2(cost_and_yield, problem, quick);
  expect_equal(front, nsga2(cost_and_yield, problem, quick));
  Nsga2Options other = quick;
  other.search.seed = 2;
  EXPECT_NE(front.X, nsga2(cost_and_yield, problem, other).X);
}

TEST(Nsga2, ABatchFunctionGetsWholePopulationsAndGivesTheSameFront) {
  const doe::Problem problem = cost_problem();
  std::vector<Eigen::Index> sizes;
  const auto batch = [&sizes](const Eigen::MatrixXd& X, std::span<const doe::Seed> seeds) {
    sizes.push_back(X.rows());
    EXPECT_EQ(static_cast<Eigen::Index>(seeds.size()), X.rows());
    std::vector<doe::Outcome> outcomes;
    for (const auto& x : X.rowwise()) outcomes.push_back(cost_and_yield(x.transpose()));
    return outcomes;
  };
  expect_equal(nsga2(batch, problem, quick), nsga2(cost_and_yield, problem, quick));
  EXPECT_EQ(sizes, std::vector<Eigen::Index>(41, 40));
}

TEST(Nsga2, EveryEvaluationHasItsOwnSeed) {
  std::vector<doe::Seed> seeds;
  const auto f = [&seeds](const Eigen::VectorXd& x, doe::Seed seed) -> doe::Outcome {
    seeds.push_back(seed);
    return {x[0], -x[0]};
  };
  nsga2(f, support::unit_problem(1, 2), quick);
  std::sort(seeds.begin(), seeds.end());
  EXPECT_EQ(seeds.size(), 40U * 41U);
  EXPECT_EQ(std::adjacent_find(seeds.begin(), seeds.end()), seeds.end());
}

// Without the limit the whole range of x_0 is on the front; at_most 4 on x_0 - 2 x_1 cuts it where x_1 has to
// rise.
TEST(Nsga2, LimitsAreKeptAndReached) {
  for (const bool at_most : {true, false}) {
    const doe::Response limit{"slope", "m", at_most ? doe::Goal::at_most : doe::Goal::at_least, 4.0};
    const Front front = nsga2(cost_and_yield, cost_problem(limit), quick);
    ASSERT_GT(front.X.rows(), 10);
    const Eigen::VectorXd slope = front.responses.col(2);
    if (at_most) {
      EXPECT_LE(slope.maxCoeff(), 4.0);
      EXPECT_GT(slope.maxCoeff(), 3.8);
    } else {
      EXPECT_GE(slope.minCoeff(), 4.0);
      EXPECT_LT(slope.minCoeff(), 4.2);
    }
  }
}

// Σ x_i <= 0.5 and Σ x_i >= 0.4 in ten variables leave less than 0.5^10/10! = 2.7e-10 of the box: no random
// point gets there, it is the violation that leads there, from limits in different units.
TEST(Nsga2, FindsASmallFeasibleRegion) {
  doe::Problem problem = support::unit_problem(10, 2);
  problem.responses.push_back({"low", "mm", doe::Goal::at_least, 400.0});
  problem.responses.push_back({"high", "km", doe::Goal::at_most, 0.5e-3});
  const auto f = [](const Eigen::VectorXd& x) -> doe::Outcome {
    return {x[0], x[1] - x[0], 1e3 * x.sum(), 1e-3 * x.sum()};
  };
  const Front front = nsga2(f, problem, {.search = {.population = 60, .stopping = {.generations = 100}}});
  EXPECT_EQ(front.status, SearchStatus::completed);
  ASSERT_GT(front.X.rows(), 10);
  EXPECT_GE(front.responses.col(2).minCoeff(), 400.0);
  EXPECT_LE(front.responses.col(3).maxCoeff(), 0.5e-3);
}

TEST(Nsga2, TheUnitOfALimitDoesNotMatter) {
  const auto search = [](double unit) {
    const auto f = [unit](const Eigen::VectorXd& x) -> doe::Outcome {
      return {x[0], 1.0 - x[0], unit * (x[0] + x[1]), x[1] - x[0]};
    };
    doe::Problem problem = support::unit_problem(2, 2);
    problem.responses.push_back({"sum", "1", doe::Goal::at_least, 1.75 * unit});
    problem.responses.push_back({"difference", "1", doe::Goal::at_most, 0.0});
    return nsga2(f, problem, quick).X;
  };
  EXPECT_EQ(search(1.0), search(1024.0));  // a power of two scales without rounding
}

TEST(Nsga2, FailedRunsRankLastAndAreCounted) {
  const auto f = [](const Eigen::VectorXd& x) -> doe::Outcome {
    if (x[0] < 5.0) throw std::runtime_error("stuck");
    return cost_and_yield(x);
  };
  const Front front = nsga2(f, cost_problem(), quick);
  EXPECT_EQ(front.status, SearchStatus::completed);
  EXPECT_GT(front.failed, 0);
  EXPECT_LT(front.failed, front.evaluations / 2);  // the search leaves the failing half of the box
  EXPECT_GE(front.X.col(0).minCoeff(), 5.0);
  EXPECT_LT(front.X.col(0).minCoeff(), 5.2);
}

TEST(Nsga2, ASearchWithoutResultSaysWhy) {
  const auto fails = [](const Eigen::VectorXd&) -> doe::Outcome { return doe::Failure{"no licence"}; };
  const Front none =
      nsga2(fails, cost_problem(), {.search = {.population = 10, .stopping = {.generations = 2}}});
  EXPECT_EQ(none.status, SearchStatus::all_failed);
  EXPECT_EQ(none.message, "all 30 evaluations failed; the first: no licence");
  EXPECT_EQ(none.X.rows(), 0);
  EXPECT_EQ(none.X.cols(), 2);
  EXPECT_EQ(none.Y.cols(), 2);

  const Front infeasible = nsga2(cost_and_yield, cost_problem({"third", "m", doe::Goal::at_least, 1e3}),
                                 {.search = {.population = 10, .stopping = {.generations = 2}}});
  EXPECT_EQ(infeasible.status, SearchStatus::no_feasible_point);
  EXPECT_EQ(infeasible.message,
            "none of 30 evaluations met every limit; relax a limit, widen the bounds or search longer");
}

TEST(Nsga2, StopsBeforeTheBudgetIsExceeded) {
  const Front front =
      nsga2(cost_and_yield, cost_problem(), {.search = {.population = 40, .stopping = {.evaluations = 230}}});
  EXPECT_EQ(front.evaluations, 200);
  EXPECT_EQ(front.generations, 4);
  EXPECT_EQ(front.stopped_by, StopReason::evaluations);
}

// The rule as it is stated: H(g) - H(g - w) <= gain H(g) holds at the last generation and at none before.
TEST(Nsga2, StopsWhenTheHypervolumeStalls) {
  std::vector<double> volumes;
  Nsga2Options options{
      .search = {.population = 40,
                 .stopping = {.generations = 500, .stall_generations = 10, .stall_gain = 1e-3}}};
  options.search.progress = [&](const SearchProgress& now) {
    EXPECT_EQ(now.generation, static_cast<int>(volumes.size()));
    EXPECT_EQ(now.evaluations, 40 * (now.generation + 1));
    volumes.push_back(now.hypervolume.value());
  };
  const Front front = nsga2(cost_and_yield, cost_problem(), options);
  EXPECT_EQ(front.stopped_by, StopReason::stall);
  EXPECT_EQ(front.generations, static_cast<int>(volumes.size()) - 1);
  for (std::size_t g = 10; g < volumes.size(); ++g)
    EXPECT_EQ(volumes[g] - volumes[g - 10] <= 1e-3 * volumes[g], g + 1 == volumes.size());
}

TEST(Nsga2, TheCallerMayStopIt) {
  std::stop_source source;
  Nsga2Options options = quick;
  options.search.stop = source.get_token();
  options.search.progress = [&](const SearchProgress& now) {
    EXPECT_FALSE(now.hypervolume.has_value());
    if (now.generation == 3) source.request_stop();
  };
  const Front front = nsga2(cost_and_yield, cost_problem(), options);
  EXPECT_EQ(front.stopped_by, StopReason::stopped);
  EXPECT_EQ(front.generations, 3);
  EXPECT_EQ(front.evaluations, 40 * 4);
}

TEST(Nsga2, OneObjectiveAndOddPopulationsWork) {
  const auto f = [](const Eigen::VectorXd& x) { return (x.array() - 0.25).square().sum(); };
  const Front front =
      nsga2(f, support::unit_problem(3), {.search = {.population = 41, .stopping = {.generations = 100}}});
  ASSERT_GE(front.X.rows(), 1);
  EXPECT_LT(front.Y.maxCoeff(), 1e-4);  // each x within about 0.006 of the optimum
}

TEST(Nsga2, BadInputIsNamed) {
  const auto text = [](const Nsga2Options& options, const doe::Problem& problem = cost_problem()) {
    return support::thrown_text<std::invalid_argument>([&] { nsga2(cost_and_yield, problem, options); });
  };
  EXPECT_EQ(text({.search = {.population = 1}}), "pareto::nsga2: population is 1; allowed is 2 or more");
  EXPECT_EQ(text({.search = {.stopping = {.generations = -1}}}),
            "pareto::nsga2: generations is -1; allowed is 0 or more");
  EXPECT_EQ(text({.search = {.variation = {.crossover_probability = 1.5}}}),
            "pareto::nsga2: crossover_probability is 1.5; allowed is 0 to 1");
  EXPECT_EQ(text({.search = {.variation = {.mutation_probability = -0.1}}}),
            "pareto::nsga2: mutation_probability is -0.1; allowed is 0 to 1");
  EXPECT_EQ(text({.elitism_ratio = 1.0}),
            "pareto::nsga2: elitism_ratio is 1; allowed is 0 (plain) to below 1");
  EXPECT_EQ(text({.pareto_fraction = 0.0}), "pareto::nsga2: pareto_fraction is 0; allowed is above 0 to 1");
  EXPECT_EQ(text({.search = {.stopping = {.evaluations = 0}}}),
            "pareto::nsga2: evaluations is 0; allowed is 1 or more; leave it out for no limit");
  EXPECT_EQ(text({.search = {.stopping = {.stall_generations = 0}}}),
            "pareto::nsga2: stall_generations is 0; allowed is 1 or more; leave it out for never");
  EXPECT_EQ(text({.search = {.threads = -1}}),
            "pareto::nsga2: threads is -1; allowed is 0 (all cores) or more");
  EXPECT_EQ(
      text({.search = {.stopping = {.stall_generations = 5}}}, support::unit_problem(2, 9)),
      "pareto::nsga2: stall_generations needs the hypervolume, which is limited to 8 objectives, not 9; "
      "leave stall_generations out");
  EXPECT_EQ(text({}, support::unit_problem(2, 3, doe::Goal::record)),
            "pareto::nsga2: no response has goal minimize or maximize; give at least one");
  EXPECT_NE(text({}, doe::Problem{}).find("doe::Problem: no variables"), std::string::npos);
}

}  // namespace
