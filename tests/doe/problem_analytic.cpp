// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/doe/problem.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <functional>
#include <limits>

namespace drawpoint::doe {
namespace {

std::string fault_after(const std::function<void(Problem&)>& change) {
  Problem problem = support::loader_problem();
  change(problem);
  return support::thrown_text<std::invalid_argument>([&] { check(problem); });
}

TEST(Problem, ASoundProblemPasses) {
  EXPECT_EQ(fault_after([](Problem&) {}), "");
  EXPECT_EQ(fault_after([](Problem& p) { p.responses[1] = {"spill", "kg", Goal::at_most, 3.5}; }), "");
}

TEST(Problem, BoundsAreChecked) {
  EXPECT_EQ(
      fault_after([](Problem& p) { std::swap(p.variables[0].lower, p.variables[0].upper); }),
      "doe::Problem: variable \"lip_angle\": lower bound 5 deg is not below upper bound -25 deg; swap them");
  EXPECT_EQ(fault_after([](Problem& p) { p.variables[2].lower = 1.0; }),
            "doe::Problem: variable \"kappa\": lower bound 1 equals the upper bound; widen the range or make "
            "it a constant");
  EXPECT_EQ(fault_after([](Problem& p) { p.variables[0].upper = std::numeric_limits<double>::infinity(); }),
            "doe::Problem: variable \"lip_angle\": upper bound inf deg is not finite; give a finite number");
  EXPECT_EQ(fault_after([](Problem& p) { p.variables[0].lower = std::nan(""); }),
            "doe::Problem: variable \"lip_angle\": lower bound nan deg is not finite; give a finite number");
  EXPECT_NE(fault_after([](Problem& p) {
              p.variables[0] = {"a", "m", -1.7e308, 1.7e308};
            }).find("overflows"),
            std::string::npos);
}

TEST(Problem, NamesAreChecked) {
  EXPECT_EQ(fault_after([](Problem& p) { p.variables.clear(); }),
            "doe::Problem: no variables; name at least one");
  EXPECT_EQ(fault_after([](Problem& p) { p.responses.clear(); }),
            "doe::Problem: no responses; name at least one");
  EXPECT_EQ(fault_after([](Problem& p) { p.variables[1].name = ""; }),
            "doe::Problem: variable 1 has no name; give it one");
  EXPECT_EQ(fault_after([](Problem& p) { p.responses[0].name = "kappa"; }),
            "doe::Problem: response \"kappa\": the name is used twice; names of variables and responses must "
            "differ");
  EXPECT_NE(fault_after([](Problem& p) { p.responses[0].name = "a\nb"; }).find("control character"),
            std::string::npos);
}

TEST(Problem, LimitsBelongToConstraints) {
  EXPECT_EQ(fault_after([](Problem& p) { p.responses[0].goal = Goal::at_least; }),
            "doe::Problem: response \"production\": goal at_least has limit nan kg/s; give a finite limit");
  EXPECT_EQ(fault_after([](Problem& p) { p.responses[0].limit = 2.0; }),
            "doe::Problem: response \"production\": goal maximize does not use limit 2 kg/s; remove the "
            "limit or choose "
            "at_most or at_least");
}

TEST(Problem, AnUnknownResponseIsNamedWithTheKnownOnes) {
  const Problem problem = support::loader_problem();
  EXPECT_EQ(response_index(problem, "joint, damage"), 1);
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([&] { response_index(problem, "spill"); }),
            "doe::Problem: no response \"spill\"; the responses are \"production\", \"joint, damage\"");
}

}  // namespace
}  // namespace drawpoint::doe
