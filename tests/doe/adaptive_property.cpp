// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <filesystem>
#include <numbers>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

/// A hill with a steep peak in its middle: bends for r < 1 alone, in a box that is mostly flat.
double ring(const Eigen::VectorXd& x) {
  const double r2 = x.squaredNorm();
  return -4 * std::exp(-25.0 / 8 * r2) + 7 * std::exp(-125.0 / 4 * r2);
}

Problem ring_problem() { return {{{"a", "1", -2, 2}, {"b", "1", -2, 2}}, {{"y", "1", Goal::minimize}}}; }

Eigen::MatrixXd first_design(int n = 16) {
  return latin_hypercube(ring_problem(), n, {.seed = 5, .corners = true});
}

RefineOptions budget(int points, int batch = 8) {
  RefineOptions options{.max_points = points};
  options.propose.batch = batch;
  return options;
}

void expect_equal(const Evaluations& a, const Evaluations& b) {
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    ASSERT_EQ(a.rows[i].x, b.rows[i].x) << "row " << i;
    ASSERT_EQ(a.rows[i].run, b.rows[i].run);
    ASSERT_EQ(a.rows[i].seed, b.rows[i].seed);
    ASSERT_EQ(a.rows[i].outcome.values(), b.rows[i].outcome.values());
  }
}

int inside(const Evaluations& runs, double radius) {
  int count = 0;
  for (std::size_t i = 16; i < runs.rows.size(); ++i) count += runs.rows[i].x.norm() < radius;
  return count;
}

// The disc r < 1 is a share p = π/16 of the box. Points that do not know it are there np of the time, with a
// standard deviation of at most √(np(1 − p)): four of them above it are passed once in 30 000 tries.
TEST(Refine, LolaVoronoiGathersWhereTheResponseBends) {
  const Evaluations runs = refine(ring, ring_problem(), first_design(), LolaVoronoi(), budget(116)).runs;
  ASSERT_EQ(runs.rows.size(), 116U);
  const double p = std::numbers::pi / 16;
  EXPECT_GT(inside(runs, 1.0), 100 * p + 4 * std::sqrt(100 * p * (1 - p)));
  const Evaluations blind = refine(ring, ring_problem(), first_design(), voronoi_sampler(), budget(116)).runs;
  EXPECT_LT(inside(blind, 1.0), 100 * p + 4 * std::sqrt(100 * p * (1 - p)));
}

// In every window of the run, Voronoi sampling takes the largest cells: the widest hole shrinks as a grid's
// spacing does, (16/116)^½ = 0.37 in two dimensions, were the first design a grid too. Twice that is allowed.
TEST(Refine, VoronoiSamplingFillsHoles) {
  const Evaluations runs = refine(ring, ring_problem(), first_design(), voronoi_sampler(), budget(116)).runs;
  const Evaluations early{runs.problem, {runs.rows.begin(), runs.rows.begin() + 16}};
  const Eigen::MatrixXd X = latin_hypercube(ring_problem(), 20000, {.seed = 9});
  EXPECT_LT(distance_to_runs(runs)(X).maxCoeff(), 0.74 * distance_to_runs(early)(X).maxCoeff());
}

TEST(Refine, IsALoopOfItsParts) {
  LolaVoronoi lola;
  Evaluations by_hand = evaluate(ring, ring_problem(), first_design());
  for (int batch = 0; batch < 4; ++batch) {
    const Eigen::MatrixXd X = propose(by_hand, lola, {.batch = 8});
    const auto points = static_cast<std::int64_t>(by_hand.rows.size());
    for (Evaluation& row : evaluate(ring, ring_problem(), X, {.first_run = points}).rows)
      by_hand.rows.push_back(std::move(row));
  }
  const Refinement r = refine(ring, ring_problem(), first_design(), LolaVoronoi(), budget(48));
  expect_equal(r.runs, by_hand);
  EXPECT_EQ(r.batches, 4);
  EXPECT_EQ(r.status, RefineStatus::budget_spent);
  EXPECT_EQ(r.message, "max_points was reached after 48 points, 4 batches");
}

TEST(Refine, StopsWhenTheCriterionHolds) {
  RefineOptions options = budget(200, 5);
  std::vector<std::size_t> asked;
  options.enough = [&asked](const Evaluations& runs) {
    asked.push_back(runs.rows.size());
    return runs.rows.size() >= 24;
  };
  const Refinement r = refine(ring, ring_problem(), first_design(), LolaVoronoi(), options);
  EXPECT_EQ(r.status, RefineStatus::criterion_met);
  EXPECT_EQ(to_string(r.status), "criterion_met");
  EXPECT_EQ(asked, (std::vector<std::size_t>{16, 21, 26}));
  EXPECT_EQ(r.message, "the stopping criterion held after 26 points, 2 batches");
}

TEST(Refine, SpendsTheBudgetExactlyWithReplicatesAndFailures) {
  const auto f = [](const Eigen::VectorXd& x, Seed seed) -> Outcome {
    if (x[0] > 1) return Failure{"stuck"};
    return ring(x) + 0.01 * RandomStream(seed).uniform();
  };
  RefineOptions options = budget(43);
  options.evaluate.replicates = 3;
  const Mix mix({{0.7, LolaVoronoi()}, {0.3, distance_to_runs}});
  const Evaluations one = refine(f, ring_problem(), first_design(), mix, options).runs;
  EXPECT_EQ(one.rows.size(), 129U);
  EXPECT_EQ(one.rows.back().run, 42);
  EXPECT_GT(one.failed(), 0);
  options.evaluate.threads = 4;
  const Mix fresh({{0.7, LolaVoronoi()}, {0.3, distance_to_runs}});
  expect_equal(refine(f, ring_problem(), first_design(), fresh, options).runs, one);
}

TEST(Refine, GoesOnFromItsJournalToTheSameBits) {
  const auto path =
      std::filesystem::temp_directory_path() / ("refine_" + std::to_string(::getpid()) + ".txt");
  std::filesystem::remove(path);
  std::stop_source cancel;
  RefineOptions options = budget(60);
  options.evaluate.journal = path;
  int ended = 0;
  options.evaluate.stop = cancel.get_token();
  options.evaluate.on_result = [&](const Evaluation&) {
    if (++ended == 29) cancel.request_stop();
  };
  const Refinement part = refine(ring, ring_problem(), first_design(), LolaVoronoi(), options);
  EXPECT_EQ(part.status, RefineStatus::cancelled);
  EXPECT_EQ(part.runs.rows.size(), 29U);
  int calls = 0;
  const auto counted = [&calls](const Eigen::VectorXd& x) {
    ++calls;
    return ring(x);
  };
  RefineOptions again = budget(60);
  again.evaluate.journal = path;
  const Refinement whole = refine(counted, ring_problem(), first_design(), LolaVoronoi(), again);
  EXPECT_EQ(calls, 60 - 29);
  expect_equal(whole.runs, refine(ring, ring_problem(), first_design(), LolaVoronoi(), budget(60)).runs);
  std::filesystem::remove(path);
}

TEST(Refine, SaysWhenNoCandidateIsLeft) {
  RefineOptions options = budget(60);
  options.propose.allowed = [](const Eigen::VectorXd&) { return false; };
  options.propose.candidates = 10;
  const Refinement r = refine(ring, ring_problem(), first_design(), distance_to_runs, options);
  EXPECT_EQ(r.status, RefineStatus::no_candidate);
  EXPECT_EQ(r.runs.rows.size(), 16U);
}

TEST(Refine, BadInputIsNamed) {
  using support::thrown_text;
  EXPECT_EQ(thrown_text<std::invalid_argument>(
                [] { refine(ring, ring_problem(), Eigen::MatrixXd(0, 2), LolaVoronoi()); }),
            "doe::refine: the first design has 0 runs; allowed is 1 or more; start from a Latin hypercube");
  EXPECT_EQ(
      thrown_text<std::invalid_argument>(
          [] { refine(ring, ring_problem(), first_design(), LolaVoronoi(), {.max_points = 0}); }),
      "doe::refine: max_points is 0; allowed is 1 or more; give the budget with the first design in it");
}

}  // namespace
