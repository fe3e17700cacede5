// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <drawpoint/doe/full_factorial.hpp>
#include <drawpoint/doe/halton.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/sobol.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/tests/doe/designs.hpp>
#include <functional>
#include <set>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

using support::inside;
using support::is_latin;

using Design = std::function<Eigen::MatrixXd(const Problem&, int, Seed)>;

/// Every design of a given number of runs, by name.
const std::vector<std::pair<std::string, Design>> designs{
    {"latin_hypercube",
     [](const Problem& p, int n, Seed s) { return latin_hypercube(p, n, {.seed = s, .corners = false}); }},
    {"optimized_latin_hypercube",
     [](const Problem& p, int n, Seed s) {
       return optimized_latin_hypercube(p, n, {.seed = s, .sweeps = 1, .centred = false});
     }},
    {"halton", [](const Problem& p, int n, Seed s) { return halton(p, n, {.seed = s}); }},
    {"uniform_random", [](const Problem& p, int n, Seed s) { return uniform_random(p, n, {.seed = s}); }},
    {"scrambled_sobol", [](const Problem& p, int n, Seed s) { return scrambled_sobol(p, n, {.seed = s}); }}};

/// A problem whose ranges span many orders of magnitude.
Problem arbitrary_problem() {
  Problem problem = support::unit_problem(*rc::gen::inRange(1, 7));
  for (Variable& v : problem.variables) {
    const double scale = std::pow(10.0, *rc::gen::inRange(-8, 9));
    v.lower = scale * *rc::gen::inRange(-1000, 1000);
    v.upper = v.lower + scale * *rc::gen::inRange(1, 1000);
  }
  return problem;
}

RC_GTEST_PROP(Designs, StayInsideTheBoundsAndRepeat, ()) {
  const Problem problem = arbitrary_problem();
  const int runs = *rc::gen::inRange(1, 200);
  const Seed seed = *rc::gen::arbitrary<Seed>();
  for (const auto& [name, design] : designs) {
    const Eigen::MatrixXd X = design(problem, runs, seed);
    RC_ASSERT(X.rows() == runs && X.cols() == static_cast<Eigen::Index>(problem.variables.size()));
    RC_ASSERT(inside(problem, X));
    RC_ASSERT(X == design(problem, runs, seed));
    RC_ASSERT(X != design(problem, runs, seed + 1));
  }
}

RC_GTEST_PROP(LatinHypercube, OneRunInEachStratumOfEachVariable, ()) {
  const Problem problem = arbitrary_problem();
  const int runs = *rc::gen::inRange(1, 300);
  RC_ASSERT(is_latin(
      problem, latin_hypercube(problem, runs, {.seed = *rc::gen::arbitrary<Seed>(), .corners = false})));
}

RC_GTEST_PROP(Designs, IntegersAreWholeAndLevelsAreIndices, ()) {
  const Problem problem = support::mixed_problem();
  const int runs = *rc::gen::inRange(1, 100);
  const Seed seed = *rc::gen::arbitrary<Seed>();
  for (const auto& [name, design] : designs) {
    const Eigen::MatrixXd X = design(problem, runs, seed);
    RC_ASSERT(inside(problem, X));
    RC_ASSERT((X.rightCols(2).array() == X.rightCols(2).array().floor()).all());
  }
}

RC_GTEST_PROP(LatinHypercube, HoldsEachValueOfADiscreteVariableEquallyOften, ()) {
  const Problem problem = support::mixed_problem();
  const int runs = *rc::gen::inRange(1, 100);
  const Seed seed = *rc::gen::arbitrary<Seed>();
  for (const bool centred : {false, true}) {
    const Eigen::MatrixXd X = latin_hypercube(problem, runs, {.seed = seed, .centred = centred});
    for (const Eigen::Index j : {2, 3}) RC_ASSERT(support::is_balanced(X.col(j), problem.variables[j]));
  }
}

// x = lower + (s + 1/2)/n·range: in strata, a half to within the rounding of the way back (see is_latin).
RC_GTEST_PROP(LatinHypercube, CentredRunsStandInTheMiddleOfTheirStrata, ()) {
  const Problem problem = support::unit_problem(*rc::gen::inRange(1, 7));
  const int runs = *rc::gen::inRange(1, 300);
  const Eigen::MatrixXd X =
      latin_hypercube(problem, runs, {.seed = *rc::gen::arbitrary<Seed>(), .centred = true});
  RC_ASSERT(is_latin(problem, X));
  for (const double x : X.reshaped())
    RC_ASSERT(std::abs(x * runs - std::floor(x * runs) - 0.5) < 1e-15 * (2 + runs));
}

RC_GTEST_PROP(LatinHypercube, CornersComeFirstAndTheRestIsLatin, ()) {
  const Problem problem = arbitrary_problem();
  const auto d = static_cast<int>(problem.variables.size());
  const int corners = 1 << d, others = *rc::gen::inRange(0, 60);
  const Eigen::MatrixXd X =
      latin_hypercube(problem, corners + others, {.seed = *rc::gen::arbitrary<Seed>(), .corners = true});
  std::set<std::vector<bool>> seen;
  for (int i = 0; i < corners; ++i) {
    std::vector<bool> upper;
    for (int j = 0; j < d; ++j) {
      const Variable& v = problem.variables[j];
      RC_ASSERT(X(i, j) == v.lower || X(i, j) == v.upper);
      upper.push_back(X(i, j) == v.upper);
    }
    seen.insert(upper);
  }
  RC_ASSERT(static_cast<int>(seen.size()) == corners);
  RC_ASSERT(is_latin(problem, X.bottomRows(others)));
}

RC_GTEST_PROP(ScrambledSobol, OneRunInEachStratumOfEachVariable, ()) {
  const int m = *rc::gen::inRange(0, 10);
  const Problem problem = support::unit_problem(*rc::gen::inRange(1, detail::sobol_max_dimensions + 1));
  RC_ASSERT(is_latin(problem, scrambled_sobol(problem, 1 << m, {.seed = *rc::gen::arbitrary<Seed>()})));
}

RC_GTEST_PROP(Designs, TheFirstRunsOfALongerSequenceAreTheShorterOne, ()) {
  const Problem problem = arbitrary_problem();
  const int runs = *rc::gen::inRange(1, 100), more = *rc::gen::inRange(0, 100);
  RC_ASSERT(uniform_random(problem, runs + more).topRows(runs) == uniform_random(problem, runs));
  RC_ASSERT(scrambled_sobol(problem, runs + more).topRows(runs) == scrambled_sobol(problem, runs));
  RC_ASSERT(halton(problem, runs + more, {.seed = 5}).topRows(runs) == halton(problem, runs, {.seed = 5}));
}

RC_GTEST_PROP(FullFactorial, EveryCombinationOnceInLexicographicOrder, ()) {
  const Problem problem = support::unit_problem(*rc::gen::inRange(1, 5));
  const auto levels = *rc::gen::container<std::vector<int>>(problem.variables.size(), rc::gen::inRange(1, 6));
  const Eigen::MatrixXd X = full_factorial(problem, levels);
  int runs = 1;
  for (const int count : levels) runs *= count;
  RC_ASSERT(X.rows() == runs);
  for (Eigen::Index i = 0; i + 1 < X.rows(); ++i)
    RC_ASSERT(std::lexicographical_compare(X.row(i).begin(), X.row(i).end(), X.row(i + 1).begin(),
                                           X.row(i + 1).end()));
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    for (const double x : X.col(j)) {
      const double level =
          levels[j] == 1 ? 2.0 * x - 1.0 : x * (levels[j] - 1);  // a single level stands at 1/2
      RC_ASSERT(std::abs(level - std::round(level)) < 1e-14);    // x = k/(L-1) to an ulp, times at most 4
    }
}

// A seed is named; a number in its place is refused, and nothing given is seed 1.
template <class... A>
concept PlansWith = requires(const Problem& p, A... a) {
  latin_hypercube(p, 4, a...);
}
|| requires(const Problem& p, A... a) { uniform_random(p, 4, a...); }
|| requires(const Problem& p, A... a) { scrambled_sobol(p, 4, a...); }
|| requires(const Problem& p, A... a) { halton(p, 4, a...); }
|| requires(const Problem& p, A... a) { optimized_latin_hypercube(p, 4, a...); };
static_assert(PlansWith<> && !PlansWith<int> && !PlansWith<Seed>);

TEST(Designs, WithoutOptionsHaveSeedOne) {
  const Problem problem = support::unit_problem(2);
  EXPECT_EQ(latin_hypercube(problem, 4, {}), latin_hypercube(problem, 4, {.seed = 1}));
  EXPECT_EQ(latin_hypercube(problem, 4), latin_hypercube(problem, 4, {.seed = 1}));
  EXPECT_NE(latin_hypercube(problem, 4), latin_hypercube(problem, 4, {.seed = 0}));
}

TEST(Designs, TooFewRunsAreRefused) {
  const Problem problem = support::unit_problem(4);
  const auto text = [](const auto& action) { return support::thrown_text<std::invalid_argument>(action); };
  EXPECT_EQ(text([&] { latin_hypercube(problem, 0); }),
            "doe::latin_hypercube: runs is 0; allowed is 1 or more; ask for at least one run");
  EXPECT_EQ(text([&] { latin_hypercube(problem, 15, {.corners = true}); }),
            "doe::latin_hypercube: runs is 15, fewer than the 2^4 corner points of 4 variables; ask for more "
            "runs or set "
            "corners = false");
  EXPECT_EQ(text([&] { uniform_random(problem, -3); }),
            "doe::uniform_random: runs is -3; allowed is 1 or more; ask for at least one run");
  EXPECT_EQ(
      text([&] { scrambled_sobol(support::unit_problem(1112), 8); }),
      "doe::scrambled_sobol: the problem has 1112 variables; allowed is up to 1111; use latin_hypercube");
}

TEST(FullFactorial, WrongLevelsAreRefused) {
  const Problem problem = support::unit_problem(2);
  const auto text = [&](std::vector<int> levels) {
    return support::thrown_text<std::invalid_argument>([&] { full_factorial(problem, levels); });
  };
  EXPECT_EQ(text({3}),
            "doe::full_factorial: levels has 1 entries, the problem has 2 variables; give one per variable");
  EXPECT_EQ(text({3, 0}),
            "doe::full_factorial: variable \"x1\" has 0 levels; allowed is 1 or more; 2 gives the bounds");
  EXPECT_EQ(text({1 << 16, 1 << 16}),
            "doe::full_factorial: more than 2^31 - 1 runs; use fewer levels or a space-filling design");
}

TEST(FullFactorial, ADiscreteVariableTakesItsValues) {
  const Problem problem = support::mixed_problem();
  const Eigen::MatrixXd X = full_factorial(problem, 2);
  ASSERT_EQ(X.rows(), 2 * 2 * 2 * 3);
  EXPECT_EQ(std::set<double>(X.col(2).begin(), X.col(2).end()), (std::set<double>{2, 6}));
  EXPECT_EQ(std::set<double>(X.col(3).begin(), X.col(3).end()), (std::set<double>{0, 1, 2}));
  EXPECT_EQ(full_factorial(problem, 9).rows(), 9 * 9 * 5 * 3);
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([&] {
              full_factorial(problem, std::vector<int>{2, 2, 6, 3});
            }),
            "doe::full_factorial: variable \"teeth\" has 6 levels but takes only 5 values; ask for no more "
            "levels than values");
}

TEST(FullFactorial, TheBoundsAreLevels) {
  const Problem problem = support::loader_problem();
  const Eigen::MatrixXd X = full_factorial(problem, 2);
  ASSERT_EQ(X.rows(), 8);
  for (Eigen::Index j = 0; j < 3; ++j) {
    EXPECT_EQ(X(0, j), problem.variables[j].lower);
    EXPECT_EQ(X(7, j), problem.variables[j].upper);
  }
}

}  // namespace
