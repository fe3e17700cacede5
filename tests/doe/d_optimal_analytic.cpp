// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/d_optimal.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <functional>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

/// det(FᵀF) of X below the present runs.
double determinant(const Problem& problem, const Eigen::MatrixXd& X, ModelTerms terms,
                   const Eigen::MatrixXd& present = {}) {
  Eigen::MatrixXd all(X.rows() + present.rows(), X.cols());
  all.topRows(X.rows()) = X;
  if (present.rows() > 0) all.bottomRows(present.rows()) = present;
  const Eigen::MatrixXd F = model_matrix(problem, all, terms);
  return (F.transpose() * F).determinant();
}

/// The largest determinant of all choices of n points, repeats allowed, from the 3 x 3 grid of the unit
/// square.
double best_of_all(int n, const DOptimalOptions& options) {
  const Problem problem = support::unit_problem(2);
  std::vector<Eigen::Vector2d> grid;
  for (const double a : {0.0, 0.5, 1.0})
    for (const double b : {0.0, 0.5, 1.0})
      if (!options.allowed || options.allowed(Eigen::Vector2d(a, b))) grid.emplace_back(a, b);
  Eigen::MatrixXd X(n, 2);
  double best = 0;
  const std::function<void(int, std::size_t)> choose = [&](int row, std::size_t from) {
    if (row == n) {
      best = std::max(best, determinant(problem, X, options.terms, options.present));
      return;
    }
    for (std::size_t k = from; k < grid.size(); ++k) {
      X.row(row) = grid[k].transpose();
      choose(row + 1, k);
    }
  };
  choose(0, 0);
  return best;
}

/// Determinants of small whole numbers over powers of two: round-off of six columns stays far below 1e-9.
void expect_best_of_all(int n, const DOptimalOptions& options) {
  const Problem problem = support::unit_problem(2);
  const DOptimalDesign design = d_optimal(problem, n, options);
  ASSERT_EQ(design.status, DOptimalStatus::found);
  const double found = determinant(problem, design.X, options.terms, options.present);
  const double best = best_of_all(n, options);
  EXPECT_NEAR(found / best, 1, 1e-9) << n << " runs, " << to_string(options.terms) << " terms";
  const auto p = static_cast<double>(model_matrix(problem, design.X, options.terms).cols());
  const auto all = static_cast<double>(n + options.present.rows());
  EXPECT_NEAR(design.determinant, std::pow(found, 1 / p) / all, 1e-9);
}

TEST(DOptimal, IsTheBestOfAllChoices) {
  for (const int n : {6, 7, 8}) expect_best_of_all(n, {});
  for (const int n : {4, 5, 7}) expect_best_of_all(n, {.terms = ModelTerms::interactions});
  for (const int n : {3, 4, 5}) expect_best_of_all(n, {.terms = ModelTerms::linear});
}

TEST(DOptimal, CountsRunsThatThereAre) {
  Eigen::MatrixXd present(4, 2);
  present << 0, 0, 0, 1, 1, 0, 1, 1;
  for (const int n : {2, 3, 5}) expect_best_of_all(n, {.present = present});
  expect_best_of_all(1, {.terms = ModelTerms::interactions, .present = present});
}

TEST(DOptimal, StaysWhereRunsAreAllowed) {
  const auto below = [](const Eigen::VectorXd& x) { return x[0] + x[1] <= 1.5; };
  for (const int n : {6, 8}) expect_best_of_all(n, {.allowed = below});
  const DOptimalDesign design = d_optimal(support::unit_problem(2), 8, {.allowed = below, .levels = 11});
  for (const auto& x : design.X.rowwise()) EXPECT_LE(x[0] + x[1], 1.5);
}

// A parabola on a tenth of the range: the best six runs lie at the ends and in the middle, twice each, as on the
// whole of it, and with z = 0.1 w the determinant is that of w times 0.1² 0.1⁴: 4 · 2³ · 1e-6.
TEST(DOptimal, FindsTermsThatHardlyVaryWhereRunsAreAllowed) {
  const Problem problem = support::unit_problem(1);
  const DOptimalDesign design = d_optimal(
      problem, 6,
      {.allowed = [](const Eigen::VectorXd& x) { return std::abs(x[0] - 0.5) <= 0.0501; }, .levels = 101});
  ASSERT_EQ(design.status, DOptimalStatus::found) << design.message;
  EXPECT_NEAR(determinant(problem, design.X, ModelTerms::quadratic), 32e-6, 32e-6 * 1e-6);
  EXPECT_NEAR(design.efficiency, 1, 1e-6);
}

// Linear terms in twenty variables: the bound is that of the largest variance over all corners, which for M with
// rows f = (1, ±1, ...) is found from 2^20 of them.
TEST(DOptimal, BoundsItsEfficiencyInManyVariables) {
  const Problem problem = support::unit_problem(20);
  const DOptimalDesign design =
      d_optimal(problem, 24, {.terms = ModelTerms::linear, .levels = 2, .starts = 3});
  ASSERT_EQ(design.status, DOptimalStatus::found);
  const Eigen::MatrixXd F = model_matrix(problem, design.X, ModelTerms::linear);
  const Eigen::MatrixXd D = (F.transpose() * F / 24).inverse();
  Eigen::VectorXd f = Eigen::VectorXd::Ones(21), Df = D * f;
  double largest = f.dot(Df);
  for (unsigned code = 1; code < 1U << 20; ++code) {  // in Gray's order: one sign changes at a time
    const int j = 1 + __builtin_ctz(code);
    Df -= 2 * f[j] * D.col(j);
    f[j] = -f[j];
    largest = std::max(largest, f.dot(Df));
  }
  EXPECT_NEAR(design.efficiency, std::min(1.0, 21 / largest), 1e-6);
}

// ±1 in every entry, columns orthogonal: FᵀF = n I, Hadamard's bound, so both figures are 1.
TEST(DOptimal, OfLinearTermsIsAnOrthogonalArray) {
  for (const auto& [d, n] : {std::pair{3, 4}, {7, 8}, {6, 12}}) {
    const DOptimalDesign design =
        d_optimal(support::unit_problem(d), n, {.terms = ModelTerms::linear, .starts = 50});
    EXPECT_NEAR(design.determinant, 1, 1e-12) << d << " variables, " << n << " runs";
    EXPECT_NEAR(design.efficiency, 1, 1e-12);
  }
}

// A parabola: the best for any number of runs has a third of them at each bound and in the middle (Guest
// 1958), FᵀF/n of determinant 4/27.
TEST(DOptimal, OfAParabolaIsBoundsAndMiddle) {
  const DOptimalDesign design = d_optimal(support::unit_problem(1), 9);
  for (const double level : {0.0, 0.5, 1.0}) EXPECT_EQ((design.X.array() == level).count(), 3);
  EXPECT_NEAR(design.determinant, std::cbrt(4.0 / 27), 1e-12);
  EXPECT_NEAR(design.efficiency, 1, 1e-12);
  // Ten runs are one more than a multiple of three: 4·3·3/10³ instead of 4·(10/3)³/10³.
  const DOptimalDesign ten = d_optimal(support::unit_problem(1), 10);
  EXPECT_NEAR(ten.determinant, std::cbrt(4.0 * 4 * 3 * 3 / 1000), 1e-12);
  EXPECT_LE(ten.efficiency, std::cbrt(36.0 / std::pow(10.0 / 3, 3)) + 1e-12);
  EXPECT_GT(ten.efficiency, 0.85);
}

// Three tools at two levels of a number: six runs of all combinations are orthogonal in contrasts.
TEST(DOptimal, TakesCategoricalAndIntegerVariables) {
  Problem problem{.variables = {categorical_variable("tool", {"bucket", "blade", "ripper"}),
                                integer_variable("teeth", "1", 2, 6)},
                  .responses = {{"f", "1"}}};
  const DOptimalDesign design = d_optimal(problem, 6, {.terms = ModelTerms::interactions});
  EXPECT_NEAR(design.determinant, 1, 1e-12);
  EXPECT_NEAR(design.efficiency, 1, 1e-12);
  for (const auto& x : design.X.rowwise()) EXPECT_TRUE(x[1] == 2 || x[1] == 6);
  const Eigen::MatrixXd F = model_matrix(problem, design.X, ModelTerms::interactions);
  EXPECT_EQ(F.cols(), 6);
  EXPECT_TRUE((F.transpose() * F).isApprox(6 * Eigen::MatrixXd::Identity(6, 6), 1e-12));
}

TEST(DOptimal, IsTheSameForTheSameSeedInAnyUnit) {
  Problem problem = support::unit_problem(3);
  const DOptimalDesign a = d_optimal(problem, 14, {.seed = 4}), b = d_optimal(problem, 14, {.seed = 4});
  EXPECT_EQ(a.X, b.X);
  problem.variables[1].lower = -1e6;
  problem.variables[1].upper = 3e6;
  EXPECT_NEAR(d_optimal(problem, 14, {.seed = 4}).determinant, a.determinant, 1e-9);
}

TEST(DOptimal, SaysWhatIsNotPossible) {
  const Problem problem = support::unit_problem(2);
  const auto text = [&](int runs, const DOptimalOptions& options) {
    return support::thrown_text<std::invalid_argument>([&] { d_optimal(problem, runs, options); });
  };
  EXPECT_EQ(text(5, {}),
            "doe::d_optimal: 5 runs for the 6 coefficients of quadratic terms; allowed is 6 or more, present "
            "ones included; add runs or take fewer terms");
  EXPECT_EQ(text(6, {.levels = 2}),
            "doe::d_optimal: levels is 2; allowed is 3 to 101 with quadratic terms; 3 are usual");
  EXPECT_EQ(text(6, {.starts = 0}), "doe::d_optimal: starts is 0; allowed is 1 or more; 20 are usual");
  const DOptimalDesign line =
      d_optimal(problem, 6, {.allowed = [](const Eigen::VectorXd& x) { return x[0] == 0.5; }});
  EXPECT_EQ(line.status, DOptimalStatus::singular);
  const DOptimalDesign nowhere =
      d_optimal(problem, 6, {.allowed = [](const Eigen::VectorXd&) { return false; }});
  EXPECT_EQ(nowhere.status, DOptimalStatus::no_points);
  EXPECT_EQ(nowhere.X.rows(), 0);
  EXPECT_EQ(to_string(nowhere.status), "no_points");
}

}  // namespace
