// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/doe/orthogonal_array.hpp>
#include <drawpoint/tests/doe/designs.hpp>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

// The axioms over all elements; the primes of q <= 16 and the powers 4, 8, 9, 16 among them.
TEST(GaloisField, IsAField) {
  for (const int q : {2, 3, 4, 5, 7, 8, 9, 11, 13, 16}) {
    const detail::GaloisField f(q);
    for (int a = 0; a < q; ++a) {
      int inverses = 0, negatives = 0;
      for (int b = 0; b < q; ++b) {
        EXPECT_EQ(f.sum(a, b), f.sum(b, a));
        EXPECT_EQ(f.product(a, b), f.product(b, a));
        inverses += f.product(a, b) == 1;
        negatives += f.sum(a, b) == 0;
        for (int c = 0; c < q; ++c) {
          EXPECT_EQ(f.product(a, f.product(b, c)), f.product(f.product(a, b), c));
          EXPECT_EQ(f.sum(a, f.sum(b, c)), f.sum(f.sum(a, b), c));
          EXPECT_EQ(f.product(a, f.sum(b, c)), f.sum(f.product(a, b), f.product(a, c)));
        }
      }
      EXPECT_EQ(f.product(a, 1), a);
      EXPECT_EQ(f.sum(a, 0), a);
      EXPECT_EQ(inverses, a == 0 ? 0 : 1) << q << ", " << a;
      EXPECT_EQ(negatives, 1);
    }
  }
}

TEST(GaloisField, PrimePowersAreKnown) {
  std::vector<int> powers;
  for (int q = 0; q <= 32; ++q)
    if (detail::prime_of_power(q) != 0) powers.push_back(q);
  EXPECT_EQ(powers, (std::vector{2, 3, 4, 5, 7, 8, 9, 11, 13, 16, 17, 19, 23, 25, 27, 29, 31, 32}));
}

/// Whether the columns hold each combination of their q levels equally often.
bool balanced(const Eigen::MatrixXi& levels, const std::vector<Eigen::Index>& columns, int q) {
  std::size_t cells = 1;
  for (std::size_t k = 0; k < columns.size(); ++k) cells *= static_cast<std::size_t>(q);
  std::vector<Eigen::Index> held(cells, 0);
  for (Eigen::Index i = 0; i < levels.rows(); ++i) {
    std::size_t cell = 0;
    for (const Eigen::Index j : columns)
      cell = cell * static_cast<std::size_t>(q) + static_cast<std::size_t>(levels(i, j));
    ++held[cell];
  }
  for (const Eigen::Index h : held)
    if (h * static_cast<Eigen::Index>(cells) != levels.rows()) return false;
  return true;
}

TEST(OrthogonalArray, OfStrengthTwoBalancesEveryPair) {
  for (const int q : {2, 3, 4, 5, 7, 8, 9}) {
    const Eigen::MatrixXi levels = orthogonal_array(q, q + 1);
    ASSERT_EQ(levels.rows(), q * q);
    for (Eigen::Index j = 0; j <= q; ++j)
      for (Eigen::Index k = 0; k < j; ++k)
        EXPECT_TRUE(balanced(levels, {j, k}, q)) << q << ": " << j << ", " << k;
  }
}

TEST(OrthogonalArray, OfStrengthThreeBalancesEveryTriple) {
  for (const int q : {3, 4, 5}) {
    const Eigen::MatrixXi levels = orthogonal_array(q, q + 1, 3);
    ASSERT_EQ(levels.rows(), q * q * q);
    for (Eigen::Index j = 0; j <= q; ++j)
      for (Eigen::Index k = 0; k < j; ++k)
        for (Eigen::Index l = 0; l < k; ++l) EXPECT_TRUE(balanced(levels, {j, k, l}, q)) << q;
  }
}

Eigen::MatrixXi cells_of(const Eigen::MatrixXd& U, int q) { return (U * q).array().floor().cast<int>(); }

TEST(OrthogonalLatinHypercube, IsLatinAndKeepsTheArray) {
  for (const int sweeps : {0, 10})
    for (const LatinCriterion criterion : {LatinCriterion::maximin, LatinCriterion::centred_discrepancy}) {
      const Problem problem = support::unit_problem(5);
      const OrthogonalLatinOptions options{.seed = 6, .criterion = criterion, .sweeps = sweeps};
      const Eigen::MatrixXd X = orthogonal_latin_hypercube(problem, 49, options);
      EXPECT_TRUE(support::is_latin(problem, X));
      EXPECT_EQ(X, orthogonal_latin_hypercube(problem, 49, options));
      for (Eigen::Index j = 0; j < 5; ++j)
        for (Eigen::Index k = 0; k < j; ++k) EXPECT_TRUE(balanced(cells_of(X, 7), {j, k}, 7));
    }
  const Eigen::MatrixXd X =
      orthogonal_latin_hypercube(support::unit_problem(3), 64, {.seed = 6, .strength = 3});
  EXPECT_TRUE(balanced(cells_of(X, 4), {0, 1, 2}, 4));
}

TEST(OrthogonalLatinHypercube, TheSearchLowersTheCriterion) {
  const Problem problem = support::unit_problem(4);
  const Eigen::MatrixXd plain = orthogonal_latin_hypercube(problem, 64, {.seed = 2, .sweeps = 0}),
                        searched = orthogonal_latin_hypercube(problem, 64, {.seed = 2});
  EXPECT_LT(squared_centred_discrepancy(searched), squared_centred_discrepancy(plain));
}

TEST(OrthogonalLatinHypercube, WrongNumbersOfRunsNameTheNext) {
  const auto text = [](const auto& action) { return support::thrown_text<std::invalid_argument>(action); };
  EXPECT_EQ(text([] { orthogonal_latin_hypercube(support::unit_problem(4), 36); }),
            "doe::orthogonal_latin_hypercube: no orthogonal array of 36 runs for 4 variables at strength 2; "
            "the next "
            "larger one has 49 runs");
  EXPECT_EQ(orthogonal_array_runs(10, 7), 49);  // 6 is no prime power, 5 serves 6 variables
  EXPECT_EQ(orthogonal_array_runs(10, 6), 25);
  EXPECT_EQ(orthogonal_array_runs(5, 3, 3), 27);  // strength 3 needs 3 levels or more
  EXPECT_EQ(text([] { orthogonal_array(6, 3); }),
            "doe::orthogonal_array: 6 levels, 3 variables, strength 2; allowed are a prime power, 1 to "
            "levels + 1, and "
            "2 to the smaller of levels and 6; take more levels");
  EXPECT_EQ(text([] { orthogonal_array_runs(0, 3); }),
            "doe::orthogonal_array_runs: 0 runs, 3 variables, strength 2; allowed are 1 or more, 1 to 1000, "
            "2 to 6; "
            "correct the one outside");
}

}  // namespace
