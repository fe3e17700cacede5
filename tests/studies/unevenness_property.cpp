// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A response that jumps is said to, with the place and the size; one that does not is not spoken of.

#include <drawpoint/studies/model/fits/unevenness.h>
#include <gtest/gtest.h>
#include <drawpoint/doe/latin_hypercube.hpp>

#include <cmath>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

/// Sixty runs of a wave with noise, and `step` more where the bucket has more than 0.55 of its width.
Tables sixty_runs(double step) {
  Tables tables;
  tables.training.problem = {.variables = {{"width", "m", 0.0, 1.0}, {"speed", "m/s", 0.0, 1.0}},
                             .responses = {{"cost", "EUR", doe::Goal::minimize}}};
  tables.validation.problem = tables.training.problem;
  const Eigen::MatrixXd X = doe::latin_hypercube(tables.training.problem, 60);
  doe::RandomStream random(1);
  for (int i = 0; i < 60; ++i) {
    const Eigen::VectorXd x = X.row(i);
    const double cost = 30 * std::sin(3 * x[0]) + 50 * x[0] * x[1] + (x[0] > 0.55 ? step : 0.0);
    tables.training.rows.push_back({i + 1, 0, 1, x, {cost + 5 * random.normal()}, 0.0});
  }
  return tables;
}

TEST(Unevenness, ASmoothResponseIsNotSpokenOf) {
  const Tables tables = sixty_runs(0);
  EXPECT_TRUE(unevenness(fit_models(tables), tables).empty());
}

// 60 runs fill strata of 1/60, so the step at 0.55 = 33/60 lies between the runs of strata 33 and 34: both
// within 1/60 of it.
TEST(Unevenness, AJumpIsSaidWithPlaceAndSize) {
  const Tables tables = sixty_runs(100);
  const std::vector<std::string> said = unevenness(fit_models(tables), tables);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].find("The cost is not alike everywhere: where width lies from 0."), 0U) << said[0];
  EXPECT_NE(said[0].find("It jumps between width = 0.5"), std::string::npos) << said[0];
  double after = 0, before = 0, size = 0;
  ASSERT_EQ(std::sscanf(said[0].c_str() + said[0].find("width = "), "width = %lf and %lf m, by %lf EUR",
                        &after, &before, &size),
            3)
      << said[0];
  EXPECT_GE(after, 0.55 - 1.0 / 60 - 0.0005);  // three digits
  EXPECT_LE(before, 0.55 + 1.0 / 60 + 0.0005);
  EXPECT_NEAR(size, 100, 10);  // four standard errors of some 2, and what the wave gains across the gap, 2
}

}  // namespace
