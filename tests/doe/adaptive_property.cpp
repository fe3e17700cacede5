// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <filesystem>
#include <numbers>
#include <thread>

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

RefineOptions one_by_one(int points, int threads = 1) {
  RefineOptions options = budget(points);
  options.wait_for_batch = false;
  options.evaluate.threads = threads;
  return options;
}

TEST(RefineOneByOne, IsBatchesOfOneOnOneThread) {
  const Mix mix({{0.7, LolaVoronoi()}, {0.3, distance_to_runs}});
  const Mix fresh({{0.7, LolaVoronoi()}, {0.3, distance_to_runs}});
  const Refinement r = refine(ring, ring_problem(), first_design(), mix, one_by_one(40));
  expect_equal(r.runs, refine(ring, ring_problem(), first_design(), fresh, budget(40, 1)).runs);
  EXPECT_EQ(r.status, RefineStatus::budget_spent);
  EXPECT_EQ(r.message, "max_points was reached after 40 points");
  EXPECT_EQ(r.batches, 24);
}

// The first run takes as long as all the others need: whoever waited for its batch would end no other meanwhile.
TEST(RefineOneByOne, LetsNoRunWaitForAnother) {
  std::atomic<int> others{0};
  const Eigen::VectorXd slow = first_design().row(0).transpose();
  const auto f = [&](const Eigen::VectorXd& x) {
    if (x != slow) {
      ++others;
    } else {
      for (int wait = 0; others < 39 && wait < 10000; ++wait)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      EXPECT_EQ(others, 39);
    }
    return ring(x);
  };
  const Evaluations runs =
      refine(f, ring_problem(), first_design(), distance_to_runs, one_by_one(40, 2)).runs;
  ASSERT_EQ(runs.rows.size(), 40U);
  for (std::size_t i = 0; i < runs.rows.size(); ++i) {
    EXPECT_EQ(runs.rows[i].run, static_cast<std::int64_t>(i));
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(runs.rows[i].x, runs.rows[j].x);
  }
}

TEST(RefineOneByOne, GoesOnFromItsJournalToTheSameBits) {
  const auto path =
      std::filesystem::temp_directory_path() / ("one_by_one_" + std::to_string(::getpid()) + ".txt");
  std::filesystem::remove(path);
  std::stop_source cancel;
  RefineOptions options = one_by_one(40);
  options.evaluate.journal = path;
  options.evaluate.stop = cancel.get_token();
  int ended = 0;
  options.evaluate.on_result = [&](const Evaluation&) {
    if (++ended == 23) cancel.request_stop();
  };
  const Refinement part = refine(ring, ring_problem(), first_design(), distance_to_runs, options);
  EXPECT_EQ(part.status, RefineStatus::cancelled);
  EXPECT_EQ(part.runs.rows.size(), 23U);
  RefineOptions again = one_by_one(40);
  again.evaluate.journal = path;
  int made = 0;
  EvaluateProgress last;
  again.evaluate.on_result = [&](const Evaluation&) { ++made; };
  again.evaluate.progress = [&](const EvaluateProgress& p) { last = p; };
  const Refinement whole = refine(ring, ring_problem(), first_design(), distance_to_runs, again);
  EXPECT_EQ(made, 40 - 23);
  EXPECT_EQ(last.done, 40);
  EXPECT_EQ(last.total, 40);
  expect_equal(whole.runs,
               refine(ring, ring_problem(), first_design(), distance_to_runs, one_by_one(40)).runs);
  std::filesystem::remove(path);
}

TEST(RefineOneByOne, EndsWhereTheCriterionHoldsAndPassesOnWhatCallbacksThrow) {
  RefineOptions options = one_by_one(40, 3);
  options.enough = [](const Evaluations& runs) { return runs.rows.size() >= 24; };
  const Refinement r = refine(ring, ring_problem(), first_design(), distance_to_runs, options);
  EXPECT_EQ(r.status, RefineStatus::criterion_met);
  EXPECT_GE(r.runs.rows.size(), 24U);
  EXPECT_LE(r.runs.rows.size(), 26U);  // those under way end
  options.evaluate.on_result = [](const Evaluation&) { throw std::runtime_error("disk full"); };
  EXPECT_THROW(refine(ring, ring_problem(), first_design(), distance_to_runs, options), std::runtime_error);
  options.evaluate.replicates = 2;
  EXPECT_EQ(support::thrown_text<std::invalid_argument>(
                [&] { refine(ring, ring_problem(), first_design(), distance_to_runs, options); }),
            "doe::refine: replicates is 2 without waiting for batches; allowed is 1; wait for batches");
}

// As a sampler it is the part whose turn it is, and propose shares a batch out also where it stands as one.
TEST(Mix, IsASampler) {
  const auto at = [](double score) {
    return Sampler([score](const Evaluations&) -> Criterion {
      return [score](const Eigen::MatrixXd& X) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(X.rows(), score);
      };
    });
  };
  const Mix mix({{1, at(1.0)}, {1, at(2.0)}});
  const Eigen::MatrixXd X = first_design();
  const Evaluations sixteen = evaluate(ring, ring_problem(), X);
  const Evaluations fifteen = evaluate(ring, ring_problem(), X.topRows(15));
  EXPECT_EQ(mix(sixteen)(X)[0], 1.0);
  EXPECT_EQ(mix(fifteen)(X)[0], 2.0);
  const Mix lola({{0.7, LolaVoronoi()}, {0.3, distance_to_runs}});
  const Sampler held = lola;
  EXPECT_EQ(propose(sixteen, held, {.batch = 8}), propose(sixteen, lola, {.batch = 8}));
  const Mix nested({{1, lola}, {1, voronoi_sampler()}});
  EXPECT_EQ(propose(sixteen, nested, {.batch = 8}).rows(), 8);
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
