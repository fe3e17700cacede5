// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/constrained.hpp>
#include <drawpoint/doe/constrained_latin_hypercube.hpp>
#include <drawpoint/doe/full_factorial.hpp>
#include <drawpoint/tests/doe/designs.hpp>
#include <functional>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

using Region = std::function<bool(const Eigen::VectorXd&)>;

/// A pair of triangles cut off, a hole, and a thin shell of the unit box of d = 3.
const std::vector<std::pair<std::string, Region>> regions{
    {"cut corners",
     LinearConstraints{(Eigen::MatrixXd(2, 3) << 1, 1, 0, -1, -1, 0).finished(), Eigen::Vector2d(1.5, -0.5)}},
    {"hole", [](const Eigen::VectorXd& x) { return (x.array() - 0.5).matrix().norm() > 0.4; }},
    {"shell",
     [](const Eigen::VectorXd& x) { return std::abs((x.array() - 0.5).matrix().norm() - 0.4) < 0.02; }}};

using Design = std::function<ConstrainedDesign(const Problem&, int, const Region&, Seed)>;

const std::vector<std::pair<std::string, Design>> designs{
    {"sequence",
     [](const auto& p, int n, const Region& r, Seed s) { return feasible_sequence(p, n, r, {.seed = s}); }},
    {"maximin",
     [](const auto& p, int n, const Region& r, Seed s) { return feasible_maximin(p, n, r, {.seed = s}); }},
    {"replacement",
     [](const auto& p, int n, const Region& r, Seed s) {
       return feasible_replacement(p, latin_hypercube(p, n, {.seed = s}), r, {.seed = s});
     }},
    {"latin", [](const auto& p, int n, const Region& r, Seed s) {
       return constrained_latin_hypercube(p, n, r, {.seed = s});
     }}};

TEST(ConstrainedDesigns, EveryRunIsAllowedInsideTheBoundsAndRepeats) {
  const Problem problem = support::unit_problem(3);
  for (const auto& [region_name, region] : regions)
    for (const auto& [name, design] : designs)
      for (const int n : {1, 2, 40}) {
        const ConstrainedDesign found = design(problem, n, region, 7);
        ASSERT_EQ(found.X.rows(), n) << name << ", " << region_name;
        EXPECT_NE(found.status, RegionStatus::too_small);
        EXPECT_EQ(found.message.empty(), found.status == RegionStatus::complete);
        EXPECT_TRUE(support::inside(problem, found.X));
        for (Eigen::Index i = 0; i < n; ++i)
          EXPECT_TRUE(region(found.X.row(i))) << name << ", " << region_name;
        EXPECT_EQ(found.X, design(problem, n, region, 7).X);
      }
}

TEST(ConstrainedDesigns, EverywhereAllowedChangesNothing) {
  const Problem problem = support::mixed_problem();
  const Region everywhere = [](const Eigen::VectorXd&) { return true; };
  const Eigen::MatrixXd X = latin_hypercube(problem, 20);
  const ConstrainedDesign same = feasible_replacement(problem, X, everywhere);
  EXPECT_EQ(same.X, X);
  EXPECT_EQ(same.replaced, 0);
  EXPECT_TRUE(std::isnan(same.feasible_share)) << "no point was asked about at random";
  EXPECT_EQ(feasible_sequence(problem, 20, everywhere, {.seed = 3}).X, halton(problem, 20, {.seed = 3}));
  EXPECT_EQ(feasible_sequence(problem, 20, everywhere, {.seed = 3}).feasible_share, 1.0);
}

TEST(ConstrainedLatinHypercube, StaysLatinWhereThatIsPossible) {
  const Problem problem = support::unit_problem(3);
  for (const auto& [name, region] : {regions[0], regions[1]})
    for (Seed seed = 1; seed <= 5; ++seed)
      for (const bool centred : {false, true}) {
        const auto found =
            constrained_latin_hypercube(problem, 40, region, {.seed = seed, .centred = centred});
        EXPECT_EQ(found.status, RegionStatus::complete) << name << ", seed " << seed << ": " << found.message;
        EXPECT_TRUE(support::is_latin(problem, found.X)) << name << ", seed " << seed;
      }
}

// The mean of a Latin design is the middle of the box to within half a stratum, so a region on one side of it
// holds none.
TEST(ConstrainedLatinHypercube, SaysWhenTheRunsLeaveTheirStrata) {
  const Problem problem = support::unit_problem(2);
  const auto found = constrained_latin_hypercube(
      problem, 20, [](const Eigen::VectorXd& x) { return x[0] < 0.4; }, {.seed = 3, .exchanges = 5});
  EXPECT_EQ(found.status, RegionStatus::not_latin);
  EXPECT_EQ(found.X.rows(), 20);
  EXPECT_LT(found.X.col(0).maxCoeff(), 0.4);
  EXPECT_EQ(found.replaced, 12);  // the strata above 0.4
  EXPECT_NE(found.message.find("no Latin hypercube inside the region was found: 12 of 20 runs moved"),
            std::string::npos);
}

// Spreading may only help: farther apart than the first allowed points of the sequence, which are candidates
// too.
TEST(FeasibleMaximin, SpreadsTheRuns) {
  const Problem problem = support::unit_problem(3);
  for (const auto& [name, region] : regions)
    for (Seed seed = 1; seed <= 3; ++seed)
      EXPECT_GT(minimum_distance(feasible_maximin(problem, 50, region, {.seed = seed}).X),
                2.0 * minimum_distance(feasible_sequence(problem, 50, region, {.seed = seed}).X))
          << name;
}

// Gonzalez' bound on candidates whose best choice is known: of a 9 x 9 grid the best four points are its
// corners, one apart; half of that is sure.
TEST(FeasibleMaximin, FarthestPointsKeepHalfOfTheBestDistance) {
  const Eigen::MatrixXd C = full_factorial(support::unit_problem(2), 9);
  const auto chosen = detail::farthest_points(C, Eigen::MatrixXd(0, 2), 4);
  EXPECT_GE(minimum_distance(C(chosen, Eigen::all)), 0.5);
}

// A share of 1e-9 is not met in a thousand tries; a discrete region of three points holds no more than three
// runs.
TEST(ConstrainedDesigns, ARegionThatIsTooSmallIsReported) {
  const Problem problem = support::unit_problem(3);
  const Region tiny = [](const Eigen::VectorXd& x) { return x.norm() < 1e-3; };
  const ConstrainedDesign none = feasible_sequence(problem, 10, tiny, {.tries = 1000});
  EXPECT_EQ(none.status, RegionStatus::too_small);
  EXPECT_EQ(none.X.rows(), 0);
  EXPECT_EQ(none.message,
            "only 0 of 10 runs: distinct allowed points ran out, 0 of those tried are allowed; widen the "
            "region, shrink "
            "the bounds around it, or raise tries");
  EXPECT_EQ(feasible_maximin(problem, 10, tiny, {.tries = 1000}).X.rows(), 0);
  EXPECT_EQ(feasible_replacement(problem, latin_hypercube(problem, 10), tiny, {.tries = 1000}).X.rows(), 0);
  EXPECT_EQ(constrained_latin_hypercube(problem, 10, tiny, {.tries = 1000}).status, RegionStatus::too_small);
  const Problem discrete{{integer_variable("a", "1", 0, 2), integer_variable("b", "1", 0, 2)}, {{"f", "1"}}};
  const Region diagonal = [](const Eigen::VectorXd& x) { return x[0] == x[1]; };
  const ConstrainedDesign three = feasible_maximin(discrete, 5, diagonal);
  EXPECT_EQ(three.status, RegionStatus::too_small);
  EXPECT_EQ(three.X.rows(), 3);
}

TEST(LinearConstraints, AreCheckedRowByRow) {
  const LinearConstraints c{(Eigen::MatrixXd(2, 2) << 1, 1, -1, 0).finished(), Eigen::Vector2d(1.0, 0.0)};
  EXPECT_TRUE(c(Eigen::Vector2d(0.5, 0.5)));
  EXPECT_FALSE(c(Eigen::Vector2d(0.75, 0.5)));
  EXPECT_FALSE(c(Eigen::Vector2d(-0.25, 0.5)));
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([&] { c(Eigen::Vector3d(0, 0, 0)); }),
            "doe::LinearConstraints: A is 2 x 2, b has 2, x has 3 entries; A has a row for each entry of b "
            "and a column "
            "for each variable");
}

TEST(ConstrainedDesigns, BadOptionsAreRefused) {
  const Problem problem = support::unit_problem(2);
  const auto text = [](const auto& action) { return support::thrown_text<std::invalid_argument>(action); };
  EXPECT_EQ(text([&] { feasible_maximin(problem, 5, regions[1].second, {.tries = 0}); }),
            "doe::feasible_maximin: tries is 0; allowed is 1 or more");
  EXPECT_EQ(text([&] { feasible_maximin(problem, 5, regions[1].second, {.candidates = 0}); }),
            "doe::feasible_maximin: candidates is 0; allowed is 1 or more");
  EXPECT_EQ(text([&] { constrained_latin_hypercube(problem, 5, regions[1].second, {.exchanges = -1}); }),
            "doe::constrained_latin_hypercube: exchanges is -1; allowed is 0 or more; 200 is usual");
}

}  // namespace
