// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Runs that do not belong are named, those that do are not.

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/kriging/outliers.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;

namespace {

constexpr Eigen::Index runs = 40;

doe::Problem unit_square() {
  return {.variables = {{"a", "1", 0.0, 1.0}, {"b", "1", 0.0, 1.0}},
          .responses = {{"y", "1", doe::Goal::record}}};
}

TransformedModel fitter(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  FitOptions options;
  options.lower = Eigen::VectorXd::Zero(2);
  options.upper = Eigen::VectorXd::Ones(2);
  return fit_transformed(X, y, Scale::linear, {}, options);
}

/// A smooth response of deviation 1 or so with noise of a tenth.
struct Case {
  Eigen::MatrixXd X;
  Eigen::VectorXd y;

  explicit Case(doe::Seed seed)
      : X(doe::latin_hypercube(unit_square(), static_cast<int>(runs), {.seed = seed})) {
    doe::RandomStream random(seed);
    y.resize(runs);
    for (Eigen::Index i = 0; i < runs; ++i)
      y[i] = 2 * std::sin(4 * X(i, 0)) * X(i, 1) + X(i, 1) + 0.1 * detail::normal_quantile(random.uniform());
  }
  std::vector<Eigen::Index> found(const OutlierOptions& options = {}) const {
    std::vector<Eigen::Index> rows;
    for (const Outlier& outlier : find_outliers(fitter(X, y), X, y, fitter, options))
      rows.push_back(outlier.run);
    return rows;
  }
};

// Level 0.01 alone would name somebody in 30 of 3000 designs; both conditions together do in fewer. Of 30
// designs more than 2 have one with probability 0.003.
TEST(Outliers, RunsThatBelongAreNotNamed) {
  int designs = 0;
  for (doe::Seed seed = 1; seed <= 30; ++seed) designs += !Case(seed).found().empty();
  EXPECT_LE(designs, 2);
}

// A run 10 deviations of the response off, alone among 40, stands √40 = 6.3 deviations of the spoilt model off,
// far beyond the 3.7 of level 0.01: it is named in each design, and none besides it.
TEST(Outliers, OneThatIsFarOffIsNamedWithWhatTheOthersExpect) {
  for (doe::Seed seed = 1; seed <= 10; ++seed) {
    Case spoilt(seed);
    const double belongs = spoilt.y[7];
    spoilt.y[7] += 10;
    const auto outliers = find_outliers(fitter(spoilt.X, spoilt.y), spoilt.X, spoilt.y, fitter);
    ASSERT_EQ(outliers.size(), 1U) << seed;
    EXPECT_EQ(outliers[0].run, 7);
    EXPECT_EQ(outliers[0].observed, spoilt.y[7]);
    EXPECT_NEAR(outliers[0].expected, belongs, 1.0);  // ten deviations of the noise
    EXPECT_LT(outliers[0].lower, outliers[0].expected);
    EXPECT_GT(outliers[0].upper, outliers[0].expected);
    EXPECT_LT(outliers[0].upper, outliers[0].observed);
  }
}

// Two hide each other's distance: √(40/2) = 4.5 deviations each is still beyond 3.7.
TEST(Outliers, TwoAreNamedInOrder) {
  Case spoilt(3);
  spoilt.y[20] += 12;
  spoilt.y[4] -= 12;
  EXPECT_EQ(spoilt.found(), (std::vector<Eigen::Index>{4, 20}));
}

TEST(Outliers, ManyAreNoOutliers) {
  Case spoilt(5);
  for (Eigen::Index i = 0; i < runs; i += 6) spoilt.y[i] += 10;  // 7 of 40
  EXPECT_TRUE(spoilt.found().empty());
}

TEST(Outliers, FaultyInputIsRefused) {
  const Case c(1);
  support::expect_told<std::invalid_argument>([&] { c.found({.level = 2}); },
                                              {"kriging::find_outliers: level is 2; allowed is 0 to 1"});
  support::expect_told<std::invalid_argument>(
      [&] { find_outliers(fitter(c.X, c.y), c.X.topRows(3), c.y, fitter); },
      {"3 points and 40 responses for a model of 40 runs"});
}

}  // namespace
