// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A problem comes back from its JSON as it was, and what holds for nothing is not written.

#include <gtest/gtest.h>

#include <drawpoint/doe/problem_json.hpp>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

TEST(ProblemJson, SaysWhatThereIs) {
  const Problem problem{
      .variables = {{"x", "m", 0.1, 2.0}, categorical_variable("tool", {"bucket", "blade"})},
      .responses = {{"cost", "EUR", Goal::minimize}, {"wear", "1", Goal::at_most, 0.3}}};
  EXPECT_EQ(
      to_json(problem).dump(),
      R"({"responses":[{"goal":"minimize","name":"cost","unit":"EUR"},)"
      R"({"goal":"at_most","limit":0.3,"name":"wear","unit":"1"}],)"
      R"("variables":[{"lower":0.1,"name":"x","unit":"m","upper":2.0},)"
      R"({"kind":"categorical","levels":["bucket","blade"],"lower":0.0,"name":"tool","unit":"1","upper":1.0}]})");
}

TEST(ProblemJson, EveryGoalAndKindComesBack) {
  Problem problem{.variables = {{"x", "m", -1e-300, 0.1 + 0.2},
                                integer_variable("teeth", "1", 2, 6),
                                categorical_variable("tool", {"a", "b", "c"})},
                  .responses = {}};
  for (const Goal goal : {Goal::minimize, Goal::maximize, Goal::at_most, Goal::at_least, Goal::record})
    problem.responses.push_back({std::string(to_string(goal)), "\"s\"", goal});
  problem.responses[2].limit = problem.responses[3].limit = 1.0 / 3.0;
  problem.deterministic = true;
  const Problem back = problem_from_json(nlohmann::json::parse(to_json(problem).dump()));
  EXPECT_TRUE(back.deterministic);
  ASSERT_EQ(back.variables.size(), problem.variables.size());
  for (std::size_t k = 0; k < back.variables.size(); ++k) {
    EXPECT_EQ(back.variables[k].name, problem.variables[k].name);
    EXPECT_EQ(back.variables[k].unit, problem.variables[k].unit);
    EXPECT_EQ(back.variables[k].lower, problem.variables[k].lower);
    EXPECT_EQ(back.variables[k].upper, problem.variables[k].upper);
    EXPECT_EQ(back.variables[k].kind, problem.variables[k].kind);
    EXPECT_EQ(back.variables[k].levels, problem.variables[k].levels);
  }
  ASSERT_EQ(back.responses.size(), problem.responses.size());
  for (std::size_t j = 0; j < back.responses.size(); ++j) {
    EXPECT_EQ(back.responses[j].goal, problem.responses[j].goal);
    EXPECT_EQ(std::isnan(back.responses[j].limit), std::isnan(problem.responses[j].limit));
    if (!std::isnan(back.responses[j].limit)) {
      EXPECT_EQ(back.responses[j].limit, problem.responses[j].limit);
    }
  }
  EXPECT_THROW(problem_from_json(nlohmann::json::parse("{}")), nlohmann::json::exception);
}

}  // namespace
