// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/categories.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Case {
  categories::Function f;
  int levels;
};

FitOptions of_levels(const Case& of) {
  FitOptions options = categories::unit_options(3);
  options.levels = {0, 0, of.levels};
  return options;
}

FitOptions of_numbers(const Case& of) {
  FitOptions options = categories::unit_options(3);
  options.upper[2] = of.levels - 1.0;
  return options;
}

// Root mean square error at 400 points over the deviation of the response there.
double error_of(const Model& model, const Case& of) {
  const MatrixXd Z = categories::points(400, of.levels, 77);
  const VectorXd truth = categories::values(of.f, Z), centred = truth.array() - truth.mean();
  return (model.mean(Z) - truth).norm() / centred.norm();
}

}  // namespace

// Where the index says nothing of which levels are alike, it is wrong as a number. 20 designs of six runs per
// level.
TEST(CategoriesStatistical, BeatTheIndexAsANumber) {
  for (const Case& of :
       {Case{categories::scrambled, 4}, Case{categories::shuffled, 4}, Case{categories::beam, 6}}) {
    int better = 0;
    double levels = 0, numbers = 0;
    for (doe::Seed seed = 1; seed <= 20; ++seed) {
      const MatrixXd X = categories::points(6 * of.levels, of.levels, seed);
      const VectorXd y = categories::values(of.f, X);
      const double a = error_of(fit(X, y, of_levels(of)), of), b = error_of(fit(X, y, of_numbers(of)), of);
      better += a < b;
      levels += a / 20;
      numbers += b / 20;
    }
    // If both were alike, 16 or more of 20 would come by a chance of 0.6 %.
    EXPECT_GE(better, 16) << "error " << levels << " with levels, " << numbers << " with numbers";
    EXPECT_LT(levels, 0.8 * numbers);
  }
}

// Intervals of 95 %: over 40 designs and 100 points each of functions that the model does not know.
// A design's coverage scatters by about 0.08, so that the mean of 40 has a standard error of 0.013; the
// bounds are five of them around 0.95, the upper one cut by 1.
TEST(CategoriesStatistical, IntervalsCover) {
  for (const categories::Function f : {categories::scrambled, categories::unrelated}) {
    double covered = 0;
    for (doe::Seed seed = 1; seed <= 40; ++seed) {
      const auto [X, y] = categories::runs(f, 32, seed);
      const Model model = fit(X, y, of_levels({f, 4}));
      const MatrixXd Z = categories::points(100, 4, 1000 + seed);
      const VectorXd truth = categories::values(f, Z);
      const Prediction p = model.predict(Z);
      for (Eigen::Index i = 0; i < 100; ++i)
        covered += std::abs(truth[i] - p.mean[i]) <= 1.96 * std::sqrt(p.variance[i]) ? 1.0 / 4000 : 0.0;
    }
    EXPECT_GE(covered, 0.95 - 0.065);
  }
}
