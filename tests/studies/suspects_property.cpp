// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A run that does not belong to the others is named by its number, with what they expect.

#include <drawpoint/studies/model/fits/suspects.h>
#include <gtest/gtest.h>
#include <drawpoint/doe/latin_hypercube.hpp>

#include <cmath>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

/// Forty runs of a smooth response with noise, numbered from 1; the third has failed.
Tables forty_runs() {
  Tables tables;
  tables.training.problem = {.variables = {{"a", "m", 0.0, 1.0}, {"b", "m", 0.0, 1.0}},
                             .responses = {{"cost", "EUR", doe::Goal::minimize}}};
  tables.validation.problem = tables.training.problem;
  const Eigen::MatrixXd X = doe::latin_hypercube(tables.training.problem, 40);
  doe::RandomStream random(1);
  for (int i = 0; i < 40; ++i) {
    const Eigen::VectorXd x = X.row(i);
    const doe::Outcome good = {100 + 20 * std::sin(4 * x[0]) * x[1] + random.uniform()};
    tables.training.rows.push_back(
        {i + 1, 0, 1, x, i == 2 ? doe::Outcome(doe::Failure{"jammed"}) : good, 0.0});
  }
  return tables;
}

TEST(Suspects, RunsThatBelongAreNotNamed) {
  const Tables tables = forty_runs();
  EXPECT_TRUE(suspects(fit_models(tables), tables).empty());
}

TEST(Suspects, TheRunIsNamedByItsNumber) {
  Tables tables = forty_runs();
  tables.training.rows[16].outcome = {1000.0};
  const std::vector<std::string> said = suspects(fit_models(tables), tables);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].find("Run 17 has a cost of 1e+03 EUR where the other runs put 1"), 0U) << said[0];
  EXPECT_NE(said[0].find("evaluate --run 17"), std::string::npos);
}

}  // namespace
