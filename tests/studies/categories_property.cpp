// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A study's categorical variable is one in its models, not the number of its level.

#include <drawpoint/studies/model/fits/failures.h>
#include <drawpoint/studies/model/fits/models.h>
#include <gtest/gtest.h>
#include <drawpoint/doe/latin_hypercube.hpp>

#include <cmath>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

/// Sixty runs: cost by tool 40, 100, 20, 70 and a slope; the fourth tool fails where a is large.
Tables runs_of_tools() {
  Tables tables;
  tables.training.problem = {
      .variables = {{"a", "m", 0.0, 1.0},
                    doe::categorical_variable("tool", {"bucket", "blade", "ripper", "comb"})},
      .responses = {{"cost", "EUR", doe::Goal::minimize}}};
  tables.validation.problem = tables.training.problem;
  const Eigen::MatrixXd X = doe::latin_hypercube(tables.training.problem, 60);
  constexpr double by_tool[] = {40, 100, 20, 70};
  for (int i = 0; i < 60; ++i) {
    const Eigen::VectorXd x = X.row(i);
    const bool fails = x[1] == 3.0 && x[0] > 0.6;
    const doe::Outcome cost = {by_tool[static_cast<int>(x[1])] + 10 * std::sin(4 * x[0])};
    tables.training.rows.push_back({i + 1, 0, 1, x, fails ? doe::Outcome(doe::Failure{"bent"}) : cost, 0.0});
  }
  return tables;
}

TEST(StudyCategories, ModelsKnowTheLevels) {
  const Tables tables = runs_of_tools();
  const Models fitted = fit_models(tables);
  EXPECT_EQ(fitted.models[0].model().correlation().levels, (std::vector<int>{0, 4}));
  EXPECT_THROW(fitted.models[0].mean(Eigen::RowVector2d(0.5, 1.5)), std::invalid_argument);
  // The error of 15 runs per tool of a smooth curve is far below a tenth of the 10 that it swings by.
  EXPECT_NEAR(fitted.models[0](Eigen::Vector2d(0.5, 2.0)), 20 + 10 * std::sin(2.0), 1.0);
  for (const kriging::WayToFit& way :
       ways_to_fit(tables.training, tables.training.problem.responses[0], kriging::Scale::linear))
    EXPECT_EQ(way.fitter(tables.training.X(), tables.training.y("cost")).model().correlation().levels.size(),
              2U);
}

TEST(StudyCategories, SuccessKnowsTheLevels) {
  const Failures failures(runs_of_tools());
  EXPECT_THROW(failures.probability_of_success(Eigen::RowVector2d(0.5, 1.5)), std::invalid_argument);
  EXPECT_LT(failures.probability_of_success(Eigen::RowVector2d(0.9, 3.0))[0],
            failures.probability_of_success(Eigen::RowVector2d(0.9, 2.0))[0] - 0.3);
}

}  // namespace
