// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/bounds.hpp>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <functional>
#include <limits>

using namespace drawpoint;
using namespace drawpoint::doe;

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

TEST(Problem, KindsAreChecked) {
  EXPECT_EQ(fault_after([](Problem& p) { p.variables[0] = integer_variable("teeth", "1", 2, 6); }), "");
  EXPECT_EQ(fault_after([](Problem& p) { p.variables[0] = categorical_variable("tool", {"a", "b"}); }), "");
  EXPECT_EQ(fault_after([](Problem& p) { p.variables[0].kind = VariableKind::integer; }), "");  // -25 to 5
  EXPECT_EQ(
      fault_after([](Problem& p) { p.variables[1].kind = VariableKind::integer; }),
      "doe::Problem: variable \"lift, \"speed\"\": bound 0.001 m/s of an integer variable is not a whole "
      "number of at most 1e9; round it");
  EXPECT_EQ(
      fault_after([](Problem& p) { p.variables[0] = categorical_variable("tool", {"a"}); }),
      "doe::Problem: variable \"tool\": categorical with 1 levels; name at least 2 or make it a constant");
  EXPECT_EQ(fault_after([](Problem& p) {
              p.variables[0] = categorical_variable("tool", {"a", "a"});
            }),
            "doe::Problem: variable \"tool\": level \"a\" is empty or used twice; level names must differ");
  EXPECT_EQ(
      fault_after([](Problem& p) {
        p.variables[0] = categorical_variable("tool", {"a", "b", "c"});
        p.variables[0].upper = 3.0;
      }),
      "doe::Problem: variable \"tool\": bounds 0 and 3 of a categorical variable of 3 levels; they must be 0 "
      "and 2");
  EXPECT_EQ(
      fault_after([](Problem& p) {
        p.variables[0].levels = {"a", "b"};
      }),
      "doe::Problem: variable \"lip_angle\": it has levels but is real; make it categorical or remove the "
      "levels");
}

// Four fields are enough for a real variable, as in every study that was written before the kinds.
TEST(Problem, AVariableIsRealUnlessItSaysOtherwise) {
  const Problem problem{
      .variables = {{"alpha", "1", 0.2, 2.0}, {.name = "b", .unit = "m", .lower = 0, .upper = 1}},
      .responses = {{"f", "1"}}};
  EXPECT_NO_THROW(check(problem));
  for (const Variable& v : problem.variables) EXPECT_EQ(v.kind, VariableKind::real);
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

TEST(Problem, ResponsesHaveARange) {
  EXPECT_EQ(fault_after([](Problem& p) { p.responses[0].lower = 0; }), "");
  EXPECT_EQ(
      fault_after([](Problem& p) {
        p.responses[0].lower = 3;
        p.responses[0].upper = 2;
      }),
      "doe::Problem: response \"production\": its values lie from 3 kg/s to 2 kg/s; give a lower bound below "
      "the upper one, or none");
  EXPECT_EQ(fault_after([](Problem& p) {
              p.responses[0].goal = Goal::at_least;
              p.responses[0].limit = -2;
              p.responses[0].lower = 0;
            }),
            "doe::Problem: response \"production\": limit -2 kg/s is outside its values, 0 kg/s to inf kg/s; "
            "give one "
            "among them");
  const Response spill{.name = "spill", .unit = "1", .lower = 0, .upper = 1};
  EXPECT_EQ(within_range(spill, -0.1), 0);
  EXPECT_EQ(within_range(spill, 0.4), 0.4);
  EXPECT_EQ(within_range(spill, 1.2), 1);
  EXPECT_EQ(within_range(Response{.name = "any", .unit = "1"}, -7), -7);
}

TEST(Problem, AStandardErrorIsARecordedResponseOfTheSameUnit) {
  const auto fault = [](const std::function<void(Response&)>& change) {
    return fault_after([&](Problem& p) {
      p.responses.push_back({.name = "error", .unit = p.responses[0].unit, .lower = 0});
      p.responses[0].standard_error = "error";
      change(p.responses.back());
    });
  };
  const std::string place = "doe::Problem: response \"production\": its standard error is \"error\", ";
  EXPECT_EQ(fault([](Response&) {}), "");
  EXPECT_EQ(fault([](Response& r) { r.name = "other"; }),
            place + "which is no response; add one of that name and the goal record");
  EXPECT_EQ(fault([](Response& r) { r.goal = Goal::minimize; }),
            place + "whose goal is minimize; it must be record");
  EXPECT_EQ(fault([](Response& r) { r.lower = -1; }),
            place + "which may be below 0; give it the lower bound 0");
  EXPECT_EQ(fault([](Response& r) { r.unit = "t"; }), place + "in \"t\"; give both the same unit, \"kg/s\"");
  EXPECT_EQ(fault([](Response& r) { r.standard_error = "error"; }),
            place + "which names a standard error itself; remove that one");
  EXPECT_EQ(fault_after([](Problem& p) { p.responses[0].standard_error = p.responses[0].name; }),
            "doe::Problem: response \"production\": its standard error is \"production\", which is the "
            "response itself; name another");
}

TEST(Problem, DegreesOfFreedomAreOfAStandardError) {
  const auto fault = [](const char* error, double freedom) {
    return fault_after([&](Problem& p) {
      p.responses.push_back({.name = "error", .unit = p.responses[0].unit, .lower = 0});
      p.responses[0].standard_error = error;
      p.responses[0].standard_error_freedom = freedom;
    });
  };
  EXPECT_EQ(fault("error", 1), "");
  EXPECT_EQ(fault("", 0), "");
  EXPECT_EQ(
      fault("", 2),
      "doe::Problem: response \"production\": its standard error has 2.000000 degrees of freedom; allowed "
      "are "
      "finite numbers from 0 on, and 0 without a standard error; leave it out, or name the standard error");
  for (const double freedom : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_NE(fault("error", freedom), "") << freedom;
}

TEST(Problem, SignsOfGoalsTurnToLessIsBetter) {
  for (const Goal goal : {Goal::minimize, Goal::at_most}) EXPECT_EQ(sign_of(goal), 1.0);
  for (const Goal goal : {Goal::maximize, Goal::at_least}) EXPECT_EQ(sign_of(goal), -1.0);
}

TEST(Problem, TellsNoiseWhereAResponseNamesItsStandardError) {
  Problem problem{.variables = {{"alpha", "1", 0.2, 2.0}}, .responses = {{"fill", "1"}, {"error", "1"}}};
  EXPECT_FALSE(tells_noise(problem));
  problem.responses[0].standard_error = "error";
  EXPECT_TRUE(tells_noise(problem));
}

TEST(Problem, BoundsAsVectors) {
  const Problem problem{.variables = {{"alpha", "1", 0.2, 2.0}, {"lip", "m", -1.0, 3.0}},
                        .responses = {{"fill", "1"}}};
  EXPECT_EQ(lower_bounds(problem), Eigen::Vector2d(0.2, -1.0));
  EXPECT_EQ(upper_bounds(problem), Eigen::Vector2d(2.0, 3.0));
}

TEST(Problem, AnUnknownResponseIsNamedWithTheKnownOnes) {
  const Problem problem = support::loader_problem();
  EXPECT_EQ(response_index(problem, "joint, damage"), 1);
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([&] { response_index(problem, "spill"); }),
            "doe::Problem: no response \"spill\"; the responses are \"production\", \"joint, damage\"");
}

}  // namespace
