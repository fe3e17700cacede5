// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <drawpoint/doe/augmented_latin_hypercube.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>
#include <drawpoint/doe/orthogonal_array.hpp>
#include <drawpoint/tests/doe/designs.hpp>
#include <functional>
#include <numeric>
#include <set>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

using support::is_latin;

constexpr LatinCriterion criteria[] = {LatinCriterion::maximin, LatinCriterion::phi_p,
                                       LatinCriterion::centred_discrepancy};

/// 500 random exchanges, each kept, with fixed rows behind the movable ones; f sees the change that was
/// foretold and the value before and after, summed anew.
template <class Criterion>
void for_exchanges(Criterion criterion, Eigen::Index movable,
                   const std::function<void(double change, double before, double after)>& f) {
  RandomStream random(5);
  for (int e = 0; e < 500; ++e) {
    const auto i = random.below(static_cast<int>(movable)),
               k = (i + 1 + random.below(static_cast<int>(movable) - 1)) % static_cast<int>(movable);
    const Eigen::Index j = e % criterion.design().cols();
    const double before = criterion.value(), change = criterion.change(i, k, j);
    criterion.exchange(i, k, j, change);
    Criterion anew = criterion;
    anew.refresh();
    f(change, before, anew.value());
    criterion.refresh();
  }
}

// Both values are sums of 40²/2 terms near 1: 1e-16 each, over n²; 1e-14 leaves a margin of some 50.
TEST(CentredDiscrepancyState, ForetellsTheChange) {
  const Eigen::MatrixXd U = latin_hypercube(support::unit_problem(4), 40, {.seed = 2});
  for_exchanges(detail::CentredDiscrepancy(U), 30, [](double change, double before, double after) {
    EXPECT_NEAR(before + change, after, 1e-14);
  });
}

// Terms lie between 1e-10 and 1e20, all positive: the error is 1e-16·(terms) of the larger sum, before or
// after.
TEST(PairPotentialState, ForetellsTheChangeAndIsPhiP) {
  const Eigen::MatrixXd U = latin_hypercube(support::unit_problem(4), 40, {.seed = 2});
  for (const int p : {2, 10, 34}) {
    for_exchanges(detail::PairPotential(U, p), 30, [](double change, double before, double after) {
      EXPECT_NEAR(before + change, after, 1e-13 * std::max(before, after));
    });
    const double length = std::pow(40.0, -1.0 / 4.0);
    EXPECT_NEAR(std::pow(detail::PairPotential(U, p).value(), 1.0 / p), length * phi_p(U, p), 1e-12);
  }
}

TEST(OptimizedLatinHypercube, IsLatinRepeatsAndIsNoWorseThanRandom) {
  for (const auto& [n, d] : {std::pair{1, 3}, {2, 2}, {7, 1}, {12, 2}, {31, 5}, {100, 3}})
    for (const LatinCriterion criterion : criteria)
      for (const LatinStart start : {LatinStart::best, LatinStart::random, LatinStart::lattice})
        for (const bool centred : {false, true}) {
          const Problem problem = support::unit_problem(d);
          const OptimizedLatinOptions options{
              .seed = 11, .criterion = criterion, .sweeps = 10, .start = start, .centred = centred};
          const Eigen::MatrixXd X = optimized_latin_hypercube(problem, n, options);
          EXPECT_TRUE(is_latin(problem, X)) << n << " x " << d;
          EXPECT_EQ(X, optimized_latin_hypercube(problem, n, options));
          const Eigen::MatrixXd random = latin_hypercube(problem, n, {.seed = 11, .centred = centred});
          if (n < 12 || d == 1) continue;  // nothing to choose, or close to it
          if (criterion == LatinCriterion::maximin)
            EXPECT_GE(minimum_distance(X), minimum_distance(random));
          else if (criterion == LatinCriterion::phi_p)
            EXPECT_LE(phi_p(X), phi_p(random));
          else
            EXPECT_LE(squared_centred_discrepancy(X), squared_centred_discrepancy(random));
        }
}

/// The largest smallest squared distance, in strata, of all Latin squares of two variables.
int exhaustive_maximin(int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  int best = 0;
  do {
    int least = 2 * n * n;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < i; ++k) {
        const int apart = order[static_cast<std::size_t>(i)] - order[static_cast<std::size_t>(k)];
        least = std::min(least, (i - k) * (i - k) + apart * apart);
      }
    best = std::max(best, least);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

// All n! designs of two variables were compared; the default search finds the best of them.
TEST(OptimizedLatinHypercube, FindsTheBestOfAllSmallDesigns) {
  for (const int n : {3, 4, 5, 6, 7, 8}) {
    const int best = exhaustive_maximin(n);
    for (Seed seed = 1; seed <= 5; ++seed) {
      const double found =
          minimum_distance(optimized_latin_hypercube(support::unit_problem(2), n, {.seed = seed})) * n;
      EXPECT_EQ(std::lround(found * found), best) << n << " runs, seed " << seed;
    }
  }
}

// The figures that published tools reach for 500 runs of 4 variables, whatever their time: smallest distance
// 0.131 (DiceDesign's ESE), phi_10 10.62 (lhs), CD2 6.4e-5 (SciPy). Three seeds; the search is
// deterministic. Annealing alone does not reach the distance in ten sweeps.
TEST(OptimizedLatinHypercube, BeatsThePublishedToolsAt500RunsOfFourVariables) {
  const Problem problem = support::unit_problem(4);
  for (Seed seed = 1; seed <= 3; ++seed) {
    const auto X = [&](LatinCriterion criterion) {
      return optimized_latin_hypercube(
          problem, 500, {.seed = seed, .criterion = criterion, .sweeps = 10, .start = LatinStart::best});
    };
    EXPECT_GE(minimum_distance(X(LatinCriterion::maximin)), 0.131);
    EXPECT_LE(phi_p(X(LatinCriterion::phi_p), 10.0), 10.62);
    EXPECT_LE(squared_centred_discrepancy(X(LatinCriterion::centred_discrepancy)), 6.4e-5);
  }
}

TEST(OptimizedLatinHypercube, CornersComeFirstAndTheRestIsLatin) {
  const Problem problem = support::loader_problem();
  const Eigen::MatrixXd X = optimized_latin_hypercube(problem, 28, {.seed = 3, .corners = true});
  EXPECT_EQ(X.topRows(8), latin_hypercube(problem, 28, {.corners = true}).topRows(8));
  EXPECT_TRUE(is_latin(problem, X.bottomRows(20)));
  EXPECT_EQ(optimized_latin_hypercube(problem, 8, {.seed = 3, .corners = true}), X.topRows(8));
}

TEST(OptimizedLatinHypercube, KeepsDiscreteVariablesBalanced) {
  const Problem problem = support::mixed_problem();
  for (const int n : {2, 9, 30, 47})
    for (const LatinCriterion criterion : criteria) {
      const Eigen::MatrixXd X = optimized_latin_hypercube(problem, n, {.seed = 5, .criterion = criterion});
      for (const Eigen::Index j : {2, 3}) EXPECT_TRUE(support::is_balanced(X.col(j), problem.variables[j]));
    }
}

TEST(AugmentedLatinHypercube, KeepsTheOldRunsAndIsLatinAtMultiples) {
  for (const auto& [n, more, d] : {std::tuple{1, 4, 3}, {10, 10, 2}, {12, 24, 5}, {7, 7, 1}})
    for (const bool centred : {false, true}) {
      const Problem problem = support::unit_problem(d);
      const Eigen::MatrixXd X = latin_hypercube(problem, n, {.seed = 4, .centred = centred});
      const Eigen::MatrixXd grown =
          augmented_latin_hypercube(problem, X, more, {.seed = 9, .sweeps = 10, .centred = centred});
      EXPECT_EQ(grown.topRows(n), X);
      EXPECT_TRUE(is_latin(problem, grown)) << n << " + " << more;
      EXPECT_EQ(grown,
                augmented_latin_hypercube(problem, X, more, {.seed = 9, .sweeps = 10, .centred = centred}));
    }
}

/// How many of `strata` strata of a variable of the unit box the column meets.
std::size_t strata_met(const Eigen::VectorXd& u, int strata) {
  std::set<int> met;
  for (const double x : u) met.insert(std::min(static_cast<int>(std::floor(x * strata)), strata - 1));
  return met.size();
}

// New runs go where none is: of n + m strata the whole design meets those of the old runs and m more.
TEST(AugmentedLatinHypercube, FillsFreeStrataOnly) {
  const Problem problem = support::unit_problem(3);
  for (Seed seed = 1; seed <= 20; ++seed) {
    const Eigen::MatrixXd X = latin_hypercube(problem, 17, {.seed = seed});
    const Eigen::MatrixXd grown = augmented_latin_hypercube(problem, X, 9, {.seed = seed, .sweeps = 5});
    for (Eigen::Index j = 0; j < 3; ++j)
      EXPECT_EQ(strata_met(grown.col(j), 26), strata_met(X.col(j), 26) + 9);
  }
}

TEST(AugmentedLatinHypercube, KeepsDiscreteVariablesBalanced) {
  const Problem problem = support::mixed_problem();
  for (int more = 1; more <= 20; ++more) {
    const Eigen::MatrixXd X =
        augmented_latin_hypercube(problem, latin_hypercube(problem, 13), more, {.seed = 2, .sweeps = 5});
    for (const Eigen::Index j : {2, 3}) EXPECT_TRUE(support::is_balanced(X.col(j), problem.variables[j]));
  }
}

TEST(NestedLatinHypercube, EveryLayerIsLatin) {
  const Problem problem = support::unit_problem(4);
  const std::vector<int> sizes{5, 10, 30, 60};
  const Eigen::MatrixXd X = nested_latin_hypercube(problem, sizes, {.seed = 3, .sweeps = 20});
  ASSERT_EQ(X.rows(), 60);
  for (const int size : sizes) EXPECT_TRUE(is_latin(problem, X.topRows(size))) << size;
}

// A design that validates must not be the one that was fitted to, whatever the order of its rows.
TEST(LatinSearch, AnotherSeedIsAnotherSetOfPoints) {
  const Problem problem = support::unit_problem(2);
  for (const int runs : {20, 60}) {
    std::set<std::vector<std::pair<double, double>>> sets;
    for (Seed seed = 1; seed <= 11; ++seed) {
      const Eigen::MatrixXd X = optimized_latin_hypercube(problem, runs, {.seed = seed});
      std::vector<std::pair<double, double>> points;
      for (const auto& row : X.rowwise()) points.emplace_back(row[0], row[1]);
      std::sort(points.begin(), points.end());
      sets.insert(points);
    }
    EXPECT_EQ(sets.size(), 11u) << runs;
  }
}

TEST(LatinSearch, BadOptionsAreRefused) {
  const Problem problem = support::unit_problem(2);
  const auto text = [](const auto& action) { return support::thrown_text<std::invalid_argument>(action); };
  EXPECT_EQ(text([&] { optimized_latin_hypercube(problem, 5, {.seed = 1, .p = 7}); }),
            "doe::optimized_latin_hypercube: p is 7; allowed is an even number from 2 to 100; 10 is usual");
  EXPECT_EQ(text([&] { optimized_latin_hypercube(problem, 5, {.seed = 1, .sweeps = -2}); }),
            "doe::optimized_latin_hypercube: sweeps is -2; allowed is 0 or more; leave it out for a budget "
            "by size, "
            "50 to 500 is usual");
  EXPECT_EQ(text([&] { optimized_latin_hypercube(problem, 3, {.seed = 1, .corners = true}); }),
            "doe::optimized_latin_hypercube: runs is 3, fewer than the 2^2 corner points of 2 variables; ask "
            "for more "
            "runs or set corners = false");
  EXPECT_EQ(text([&] { augmented_latin_hypercube(problem, latin_hypercube(problem, 5), 0); }),
            "doe::augmented_latin_hypercube: more is 0; allowed is 1 or more; ask for at least one new run");
  EXPECT_EQ(text([&] {
              nested_latin_hypercube(problem, std::vector{10, 25});
            }),
            "doe::nested_latin_hypercube: size 25 after 10; allowed is a larger multiple of a positive size, "
            "such as "
            "10, 20, 40");
}

}  // namespace
