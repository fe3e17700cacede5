// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Climbs of a score, and what they do to proposals, on scores whose maxima are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/doe/detail/climb_score.hpp>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/propose.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <limits>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;
using detail::ScoreClimb;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

template <class F>
detail::UnitScore each_row(const F& f) {
  return [f](const MatrixXd& U) {
    VectorXd score(U.rows());
    for (Eigen::Index i = 0; i < U.rows(); ++i) score[i] = f(VectorXd(U.row(i).transpose()));
    return score;
  };
}

template <class F>
VectorXd top_from(const VectorXd& u, const F& f, std::vector<Eigen::Index> free = {0, 1}) {
  const detail::UnitScore score = each_row(f);
  return ScoreClimb(score, {u, f(u)}, std::move(free)).top().u;
}

/// A narrow slanted ridge, as improvement has along a valley: curvatures 1 and 900 times 40.
double ridge(const VectorXd& u) {
  const double along = u[0] + u[1] - 0.9, across = u[0] - 2.0 * u[1] + 0.3;
  return std::exp(-20.0 * (along * along + 900.0 * across * across));
}

// The maximum is at u0 + u1 = 0.9, u0 = 2 u1 - 0.3, that is (0.5, 0.4). Differences with a spacing h of 1e-4
// are off by h² f'''/6 against the curvature, some 1e-8 to 1e-5 of u here, and the climb goes on with 1e-6.
TEST(ScoreClimb, MeetsTheMaximumOfANarrowRidge) {
  EXPECT_LT((top_from(Eigen::Vector2d(0.62, 0.47), ridge) - Eigen::Vector2d(0.5, 0.4)).norm(), 1e-5);
}

TEST(ScoreClimb, EndsOnTheBound) {
  const auto outside = [](const VectorXd& u) { return -(u - Eigen::Vector2d(1.3, 0.25)).squaredNorm(); };
  const VectorXd top = top_from(Eigen::Vector2d(0.4, 0.9), outside);
  EXPECT_EQ(top[0], 1.0);
  EXPECT_NEAR(top[1], 0.25, 1e-6);
}

TEST(ScoreClimb, HoldsWhatIsNotFree) {
  const auto peak = [](const VectorXd& u) { return -(u - Eigen::Vector2d(0.3, 0.7)).squaredNorm(); };
  const VectorXd top = top_from(Eigen::Vector2d(0.5, 0.5), peak, {1});
  EXPECT_EQ(top[0], 0.5);
  EXPECT_NEAR(top[1], 0.7, 1e-6);
  EXPECT_EQ(top_from(Eigen::Vector2d(0.5, 0.5), peak, {}), Eigen::Vector2d(0.5, 0.5));
}

// A constant score costs its slopes once; beyond x = 0.5 no point may be, and the best of the rest is at its
// edge.
TEST(ScoreClimb, LeavesConstantsAloneAndForbiddenPlacesOut) {
  int asked = 0;
  const auto flat = [&](const VectorXd&) {
    ++asked;
    return 3.0;
  };
  EXPECT_EQ(top_from(Eigen::Vector2d(0.2, 0.9), flat), Eigen::Vector2d(0.2, 0.9));
  EXPECT_EQ(asked, 1 + 4);
  const auto half = [](const VectorXd& u) {
    return u[0] > 0.5 ? std::numeric_limits<double>::quiet_NaN() : u[0] - (u[1] - 0.2) * (u[1] - 0.2);
  };
  const VectorXd top = top_from(Eigen::Vector2d(0.2, 0.9), half);
  EXPECT_LE(top[0], 0.5);
  EXPECT_GT(top[0], 0.45);
}

Evaluations runs_of(const Problem& problem, int n) {
  return evaluate([](const VectorXd& x) { return x.sum(); }, problem,
                  latin_hypercube(problem, n, {.seed = 2}));
}

Sampler peaked(double a, double b) {
  return [=](const Evaluations&) -> Criterion {
    return [=](const MatrixXd& X) -> VectorXd {
      return (-(X.leftCols(2).rowwise() - Eigen::RowVector2d(a, b)).rowwise().squaredNorm()).array().exp();
    };
  };
}

// Of 30 candidates none is near the peak; the climb is at it.
TEST(ProposeClimbs, ToTheMaximumOfASmoothScore) {
  const Evaluations runs = runs_of(support::unit_problem(2), 20);
  const auto miss = [&](bool climb) {
    const MatrixXd X = propose(runs, peaked(0.3, 0.7), {.candidates = 30, .climb = climb});
    return (X.row(0) - Eigen::RowVector2d(0.3, 0.7)).norm();
  };
  EXPECT_GT(miss(false), 1e-3);
  EXPECT_LT(miss(true), 1e-5);
}

// Where the maximum is taken, by a run or by a point of the batch, others keep 1e-4 from it.
TEST(ProposeClimbs, ButNotOntoARun) {
  Evaluations runs = runs_of(support::unit_problem(2), 20);
  runs.rows[0].x = Eigen::Vector2d(0.3, 0.7);
  const MatrixXd X = propose(runs, peaked(0.3, 0.7), {.batch = 3, .rule = BatchRule::penalty});
  ASSERT_EQ(X.rows(), 3);
  for (int i = 0; i < 3; ++i) {
    for (const auto& row : runs.rows) EXPECT_GE((X.row(i).transpose() - row.x).norm(), 1e-4);
    for (int j = 0; j < i; ++j) EXPECT_GE((X.row(i) - X.row(j)).norm(), 1e-4);
  }
}

TEST(ProposeClimbs, WhereItIsAllowedAndOverWholeNumbers) {
  Problem problem = support::unit_problem(2);
  problem.variables.push_back(integer_variable("teeth", "1", 3, 7));
  const Evaluations runs = runs_of(problem, 20);
  const MatrixXd X =
      propose(runs, peaked(0.3, 0.7), {.allowed = [](const VectorXd& x) { return x[0] >= 0.5; }});
  EXPECT_GE(X(0, 0), 0.5);
  EXPECT_LT(X(0, 0), 0.51);
  EXPECT_NEAR(X(0, 1), 0.7, 1e-3);
  EXPECT_EQ(X(0, 2), std::round(X(0, 2)));
}

// A batch by cells: every point is the best of another cell, and no cell gives two.
TEST(ProposeClimbs, WithinTheRuleOfCells) {
  const Evaluations runs = runs_of(support::unit_problem(2), 12);
  const MatrixXd X = propose(runs, peaked(0.3, 0.7), {.batch = 12});
  ASSERT_EQ(X.rows(), 12);
  MatrixXd sites(12, 2);
  for (int i = 0; i < 12; ++i) sites.row(i) = runs.rows[static_cast<std::size_t>(i)].x.transpose();
  std::vector<int> cells = detail::nearest_sites(X, sites).site;
  std::sort(cells.begin(), cells.end());
  EXPECT_EQ(std::adjacent_find(cells.begin(), cells.end()), cells.end());
}

}  // namespace
