// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <drawpoint/pareto/sharpening.hpp>
#include <drawpoint/pareto/vorobev.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <stdexcept>

using namespace drawpoint;
using namespace drawpoint::pareto;

namespace {

const doe::Problem two = support::unit_problem(1, 2);

/// Candidates: a known front (0,1), (1,0); near it an uncertain point and a certain one; far off, a point
/// more uncertain still.
PredictedResponses five_candidates() {
  PredictedResponses p{Eigen::MatrixXd(5, 2), Eigen::MatrixXd::Zero(5, 2)};
  p.mean << 0, 1, 1, 0, 0.45, 0.5, 0.5, 0.45, 3, 3;
  p.deviation.row(2).setConstant(0.1);
  p.deviation.row(4).setConstant(0.3);
  return p;
}

// The far point dominates or equals nothing unless it falls by two, seven deviations: its probability is 0.
TEST(NextSimulations, PreferUncertainPointsNearTheFront) {
  const NextSimulations next = next_simulations(two, draws_of_normals(five_candidates()), 5);
  ASSERT_EQ(next.rows, std::vector<int>{2});  // all others are known or surely dominated
  EXPECT_EQ(next.status, NextStatus::fewer);
  EXPECT_EQ(next.message, "1 of 5 simulations: all other candidates are known or not on the front");
  EXPECT_EQ(next.probability[4], 0.0);
  EXPECT_GT(next.uncertainty[4], next.uncertainty[2]);
  EXPECT_GT(next.score[0], 0.0);
}

// Two rows that are always drawn alike would tell the same: the second choice is the other point, though it
// is less uncertain.
TEST(NextSimulations, ABatchDoesNotRepeatItself) {
  PredictedResponses p{Eigen::MatrixXd(3, 2), Eigen::MatrixXd(3, 2)};
  p.mean << 0, 1, 0.01, 0.99, 1, 0;
  p.deviation << 0.1, 0.1, 0.1, 0.1, 0.05, 0.05;
  Draws draws = draws_of_normals(p);
  for (Eigen::MatrixXd& Y : draws) Y.row(1) = Y.row(0) + Eigen::RowVector2d(0.01, -0.01);
  const NextSimulations next = next_simulations(two, draws, 3);
  ASSERT_EQ(next.rows.size(), 2u);
  EXPECT_LT(next.rows[0], 2);
  EXPECT_EQ(next.rows[1], 2);
}

TEST(NextSimulations, BadInputIsNamed) {
  EXPECT_EQ(support::thrown_text<std::invalid_argument>(
                [] { next_simulations(two, draws_of_normals(five_candidates()), 0); }),
            "pareto::next_simulations: count is 0; allowed is 1 or more");
}

/// A Gaussian process of zero mean, deviation 0.3 and length 0.1 on 41 candidates in [0, 1], known at some:
/// joint draws of f_2 = |x - 1/2| + process, with f_1 = x certain. Left of 1/2 the front runs, right of it
/// points are dominated unless the process falls by much.
struct Process {
  static constexpr int n = 41;
  Eigen::MatrixXd covariance = Eigen::MatrixXd(n, n);

  explicit Process(const std::vector<int>& known) {
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) covariance(i, k) = 0.09 * std::exp(-0.5 * std::pow((i - k) / 4.0, 2));
    for (const int i : known) learn(i);
  }

  void learn(int i) {
    const Eigen::VectorXd column = covariance.col(i);
    if (column[i] > 1e-12) covariance -= column * column.transpose() / column[i];
  }

  /// The result of each run is taken as its mean, so means stay.
  Draws draws(int count) const {
    const Eigen::MatrixXd jittered = covariance + 1e-9 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd L = jittered.llt().matrixL();
    doe::RandomStream random(11);
    Draws result;
    for (int s = 0; s < count; ++s) {
      Eigen::VectorXd z(n);
      for (double& value : z) value = random.normal();
      const Eigen::VectorXd error = L * z;
      Eigen::MatrixXd Y(n, 2);
      for (int i = 0; i < n; ++i) Y.row(i) << i / 40.0, std::abs(i / 40.0 - 0.5) + error[i];
      result.push_back(std::move(Y));
    }
    return result;
  }
};

// Among all single runs the one chosen leaves a Vorob'ev deviation that is among the least quarter. A batch
// of three leaves less than any three of the largest deviation: the middles of both gaps, then any of the
// four quarters.
TEST(NextSimulations, ReduceTheVorobevDeviation) {
  const std::vector<int> known{0, 20, 40};
  const VorobevOptions options{.samples = 1024, .reference = Eigen::Vector2d(1.1, 1.1)};
  const auto left_by = [&](const std::vector<int>& runs) {
    Process process(known);
    for (const int i : runs) process.learn(i);
    return vorobev(two, process.draws(256), options).deviation;
  };
  const NextSimulations next = next_simulations(two, Process(known).draws(512), 3);
  ASSERT_EQ(next.rows.size(), 3u);
  EXPECT_EQ(next.status, NextStatus::completed);
  EXPECT_LT(next.rows[0], 20);
  const double chosen = left_by({next.rows[0]});
  int better = 0;
  for (int i = 0; i < Process::n; ++i) better += left_by({i}) < chosen;
  EXPECT_LE(better, Process::n / 4);
  EXPECT_LT(chosen, left_by({}));
  for (const int third : {5, 15, 25, 35}) EXPECT_LT(left_by(next.rows), left_by({10, 30, third}));
}

}  // namespace
