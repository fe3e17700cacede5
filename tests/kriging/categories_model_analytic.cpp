// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/reinterpolation.hpp>
#include <drawpoint/kriging/sample_paths.hpp>
#include <drawpoint/tests/kriging/categories.hpp>
#include <drawpoint/tests/kriging/correlations.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {}  // namespace

// A category is in no polynomial, and its direction has no slope; those of numbers are difference quotients:
// with h = 1e-5 of variables on [0, 1], good to some 1e-9 of round-off over h, 1e-4 of truncation squared.
TEST(ModelsOfCategories, HaveNoSlope) {
  const auto [X, y] = categories::runs(categories::scrambled, 32, 5);
  for (const Correlation family : reference::families)
    for (const Trend trend : {Trend::constant, Trend::quadratic}) {
      FitOptions options = categories::unit_options(3);
      options.levels = {0, 0, 4};
      options.correlation = family;
      options.trend = trend;
      const Model model = fit(X, y, options);
      for (const TrendTerm& term : model.trend_function().terms) EXPECT_TRUE(term.a != 2 && term.b != 2);
      const VectorXd x = categories::points(1, 4, 2).row(0);
      const PredictionGradient g = model.gradient(x);
      EXPECT_EQ(g.mean[2], 0.0);
      EXPECT_EQ(g.variance[2], 0.0);
      for (int k = 0; k < 2; ++k) {
        constexpr double h = 1e-5;
        VectorXd up = x, down = x;
        up[k] += h;
        down[k] -= h;
        const Prediction p = model.predict(up.transpose()), q = model.predict(down.transpose());
        EXPECT_NEAR(g.mean[k], (p.mean[0] - q.mean[0]) / (2 * h), 1e-5 * (1 + std::abs(g.mean[k])));
        EXPECT_NEAR(g.variance[k], (p.variance[0] - q.variance[0]) / (2 * h),
                    1e-5 * (1 + std::abs(g.variance[k])));
      }
    }
}

// The user's functions see the index of the level; their differences are not taken along it.
TEST(ModelsOfCategories, ATrendOfTheUserSeesTheIndex) {
  const auto [X, y] = categories::runs(categories::scrambled, 32, 5);
  FitOptions options = categories::unit_options(3);
  options.levels = {0, 0, 4};
  options.trend = Trend::user;
  options.basis.values = [](const VectorXd& x) {
    if (x[2] != std::floor(x[2])) throw std::logic_error("no level");
    return VectorXd(Eigen::Vector3d(1.0, x[2] == 2.0 ? 1.0 : 0.0, x[0]));
  };
  const Model model = fit(X, y, options);
  EXPECT_EQ(model.gradient(categories::points(1, 4, 2).row(0)).mean[2], 0.0);
}

TEST(ModelsOfCategories, AppendedRunsAreThoseOfAFit) {
  const auto [X, y] = categories::runs(categories::scrambled, 32, 5);
  FitOptions options = categories::unit_options(3);
  options.levels = {0, 0, 4};
  const Model first = fit(X.topRows(28), y.head(28), options);
  const Model grown = append(first, X.bottomRows(4), y.tail(4));
  // The factor is that of the matrix of all runs, entries of which are below 2.
  const MatrixXd L = grown.state().L;
  MatrixXd C;
  fill_correlation(grown.state().X, grown.correlation(), C);
  C.diagonal().array() += grown.nugget();
  EXPECT_LT((MatrixXd(L * L.transpose()) - MatrixXd(C.selfadjointView<Eigen::Lower>())).cwiseAbs().maxCoeff(),
            1e-12);
}

// One run less, with β anew and θ as it is: the equations of prediction, for each run.
TEST(ModelsOfCategories, LeaveOneOutIsAFitWithoutTheRun) {
  const auto [X, y] = categories::runs(categories::scrambled, 24, 7);
  FitOptions options = categories::unit_options(3);
  options.levels = {0, 0, 4};
  options.parameter_uncertainty = false;
  const Model model = fit(X, y, options);
  const Validation v = leave_one_out(model);
  MatrixXd C;
  fill_correlation(model.state().X, model.correlation(), C);
  const MatrixXd full = C.selfadjointView<Eigen::Lower>();
  for (Eigen::Index out = 0; out < X.rows(); ++out) {
    std::vector<Eigen::Index> rest;
    for (Eigen::Index i = 0; i < X.rows(); ++i)
      if (i != out) rest.push_back(i);
    MatrixXd R = full(rest, rest);
    R.diagonal().array() += model.nugget();
    const VectorXd z = y(rest), r = full(rest, out), ones = VectorXd::Ones(z.size());
    const Eigen::LDLT<MatrixXd> solver(R);
    const double beta = ones.dot(solver.solve(z)) / ones.dot(solver.solve(ones));
    const double mean = beta + r.dot(solver.solve(VectorXd(z.array() - beta)));
    EXPECT_NEAR(v.predicted[out], mean, 1e-6 * (1 + std::abs(mean)));
  }
}

TEST(ModelsOfCategories, ReinterpolationAndSamplePathsKnowThem) {
  const auto [X, y] = categories::runs(categories::scrambled, 32, 5);
  FitOptions options = categories::unit_options(3);
  options.levels = {0, 0, 4};
  const Model model = fit(X, y, options), exact = reinterpolated(model);
  const MatrixXd Z = categories::points(12, 4, 9);
  // The factor of the exact matrix loses digits with its condition; the mean does not change but for that.
  EXPECT_LT((exact.mean(Z) - model.mean(Z)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(exact.predict(X).variance.maxCoeff(), 1e-6 * model.process_variance());
  const MatrixXd paths = sample_paths(model, Z, 4000);
  const VectorXd deviation = model.predict(Z).variance.cwiseSqrt();
  // Means of 4000 normal numbers lie within 5 standard errors: chance 1e-5 for the twelve.
  for (Eigen::Index j = 0; j < Z.rows(); ++j) {
    EXPECT_NEAR(paths.row(j).mean(), model.mean(Z)[j], 5 * deviation[j] / std::sqrt(4000.0) + 1e-9);
  }
}

TEST(ModelsOfCategories, AProblemSaysWhichTheyAre) {
  const doe::Problem problem{.variables = {{"x", "m", 0, 1},
                                           doe::integer_variable("n", "1", 0, 5),
                                           doe::categorical_variable("tool", {"a", "b", "c"})},
                             .responses = {{"y", "1"}}};
  EXPECT_EQ(doe::level_counts(problem), (std::vector<int>{0, 0, 3}));
}
