// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A remembered black box gives what the black box gives, and never asks it twice for a run that the store has.

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/remembered.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <filesystem>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

/// Fails in a corner, counts its runs.
struct Counted {
  std::atomic<int>* runs;

  Outcome operator()(const Eigen::VectorXd& x, Seed seed) const {
    ++*runs;
    if (x[0] < 0.2) return Failure{"stuck,\n\"twice\""};
    return x[0] / 3 + RandomStream(seed).uniform();
  }
};

/// The same in batches, which it counts.
struct Batched {
  std::atomic<int>*runs, *calls;

  std::vector<Outcome> operator()(const Eigen::MatrixXd& X, std::span<const Seed> seeds) const {
    ++*calls;
    std::vector<Outcome> outcomes;
    for (Eigen::Index i = 0; i < X.rows(); ++i)
      outcomes.push_back(Counted{runs}(X.row(i), seeds[static_cast<std::size_t>(i)]));
    return outcomes;
  }
};

class Remembering : public ::testing::Test {
 protected:
  Remembering() { std::filesystem::remove(path_); }
  ~Remembering() override { std::filesystem::remove(path_); }

  template <class F>
  void expect_as_if_run(const F& f, const Eigen::MatrixXd& X, int new_runs) {
    const Evaluations wanted = evaluate(Counted{&others_}, problem_, X);
    const int before = runs_;
    const Evaluations got = evaluate(f, problem_, X);
    EXPECT_EQ(runs_ - before, new_runs);
    ASSERT_EQ(got.rows.size(), wanted.rows.size());
    for (std::size_t i = 0; i < got.rows.size(); ++i) {
      EXPECT_EQ(got.rows[i].outcome.values(), wanted.rows[i].outcome.values());
      EXPECT_EQ(got.rows[i].outcome.reason(), wanted.rows[i].outcome.reason());
    }
  }

  const Problem problem_ = support::unit_problem(2);
  const Eigen::MatrixXd X_ = uniform_random(problem_, 20);
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("remembered_" + std::to_string(::getpid()) + ".csv");
  std::atomic<int> runs_{0}, calls_{0}, others_{0};
};

TEST_F(Remembering, OnlyWhatIsMissingIsRun) {
  MemoryStore store;
  const auto f = remembered(Counted{&runs_}, problem_, store);
  expect_as_if_run(f, X_.topRows(12), 12);
  expect_as_if_run(f, X_, 8);  // the first rows have the same seeds
  expect_as_if_run(f, X_, 0);
  EXPECT_EQ(store.size(), 20u);
}

TEST_F(Remembering, AnotherSeedIsAnotherRun) {
  MemoryStore store;
  const auto f = remembered(Counted{&runs_}, problem_, store);
  evaluate(f, problem_, X_, {.seed = 1});
  evaluate(f, problem_, X_, {.seed = 2});
  EXPECT_EQ(runs_, 40);
}

TEST_F(Remembering, AFileKeepsRunsForTheNextProgram) {
  {
    JournalStore store(problem_, path_);
    expect_as_if_run(remembered(Counted{&runs_}, problem_, store), X_.topRows(15), 15);
  }
  JournalStore store(problem_, path_);
  EXPECT_EQ(store.size(), 15u);
  expect_as_if_run(remembered(Counted{&runs_}, problem_, store), X_, 5);
}

TEST_F(Remembering, BatchesAreStoredOneAfterTheOther) {
  MemoryStore store;
  expect_as_if_run(remembered(Batched{&runs_, &calls_}, problem_, store, {.batch = 8}), X_, 20);
  EXPECT_EQ(calls_, 3);
}

TEST_F(Remembering, WhatGoesWrongIsStoredAsEvaluateRecordsIt) {
  MemoryStore store;
  const auto f = remembered([](const Eigen::VectorXd&) { return std::nan(""); }, problem_, store);
  const Evaluations runs = evaluate(f, problem_, X_.topRows(1));
  EXPECT_EQ(runs.rows[0].outcome.reason(), "response \"f0\" is nan");
  EXPECT_EQ(store.find(runs.rows[0].x, runs.rows[0].seed)->reason(), runs.rows[0].outcome.reason());
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([&] { remembered(f, problem_, store, {.batch = 0}); }),
      "doe::remembered: batch is 0; allowed is 1 or more");
}

struct TwoVariables {
  static constexpr bool predicts = true;
  double operator()(const Eigen::VectorXd& x) const { return x[0]; }
  Eigen::Index variables() const { return 2; }
};

TEST_F(Remembering, ASurrogateOfAnotherNumberOfVariablesIsRefused) {
  MemoryStore store;
  const Problem three = support::unit_problem(3);
  EXPECT_EQ(
      support::thrown_text<std::invalid_argument>([&] { remembered(TwoVariables{}, three, store); }),
      "doe: a surrogate of 2 variables is asked for points of 3; fit it to the variables of the problem, in "
      "their order");
  EXPECT_EQ(store.size(), 0u);
}

// It says nothing of the run: the program that is put right makes it again.
TEST_F(Remembering, AWrongCountIsNotStored) {
  MemoryStore store;
  const auto f = remembered([](const Eigen::VectorXd&) { return Outcome{1.0, 2.0}; }, problem_, store);
  EXPECT_NE(support::thrown_text<std::invalid_argument>([&] { evaluate(f, problem_, X_); }), "");
  EXPECT_EQ(store.size(), 0u);
  expect_as_if_run(remembered(Counted{&runs_}, problem_, store), X_, 20);
}

}  // namespace
