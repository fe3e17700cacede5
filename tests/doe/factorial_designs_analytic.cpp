// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/doe/fractional_factorial.hpp>
#include <drawpoint/doe/full_factorial.hpp>
#include <drawpoint/doe/response_surface_designs.hpp>
#include <drawpoint/tests/doe/designs.hpp>
#include <set>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

Problem coded_problem(int d) {
  Problem problem = support::unit_problem(d);
  for (Variable& v : problem.variables) v.lower = -1.0;
  return problem;
}

// 2^(4-1) with D = ABC: the textbook's example (Montgomery, Design and Analysis of Experiments, chapter 8).
TEST(Aliasing, OfAHalfFractionOfFourVariables) {
  const Aliasing report = aliasing(4, {"D=ABC"});
  EXPECT_EQ(report.resolution, 4);
  EXPECT_EQ(report.defining_words, std::vector<std::string>{"ABCD"});
  EXPECT_EQ(report.aliases,
            (std::vector<std::string>{"AB = CD", "AC = BD", "AD = BC", "BC = AD", "BD = AC", "CD = AB"}));
  EXPECT_EQ(aliasing(3, {"C=-AB"}).aliases,
            (std::vector<std::string>{"A = -BC", "B = -AC", "C = -AB", "AB = -C", "AC = -B", "BC = -A"}));
  EXPECT_EQ(aliasing(6, {"E=ABC", "F=BCD"}).defining_words,
            (std::vector<std::string>{"ABCE", "ADEF", "BCDF"}));
  EXPECT_EQ(aliasing(3, {}).resolution, 0);
}

// What the report says is what the columns do: the product of the columns of a defining word is its sign
// everywhere.
TEST(FractionalFactorial, TheColumnsObeyTheDefiningRelation) {
  const std::vector<std::string> generators{"E=ABC", "F=-BCD", "G=ACD"};
  const Eigen::MatrixXd X = fractional_factorial(coded_problem(7), generators);
  ASSERT_EQ(X.rows(), 16);
  EXPECT_TRUE((X.array().abs() == 1.0).all());
  const Aliasing report = aliasing(7, generators);
  ASSERT_EQ(report.defining_words.size(), 7U);
  for (const std::string& word : report.defining_words) {
    Eigen::ArrayXd product = Eigen::ArrayXd::Constant(16, word[0] == '-' ? -1.0 : 1.0);
    for (const char letter : word)
      if (letter != '-')
        product *= X.col(static_cast<Eigen::Index>(detail::factor_letters.find(letter))).array();
    EXPECT_TRUE((product == 1.0).all()) << word;
  }
  EXPECT_LE((X.transpose() * X - 16.0 * Eigen::MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), 0.0);
}

// Resolutions and numbers of shortest words of the minimum-aberration designs in the tables of Fries and
// Hunter 1980 and of Chen, Sun and Wu 1993.
TEST(FractionalFactorial, TheChosenGeneratorsHaveMinimumAberration) {
  struct Case {
    int d, runs, resolution, shortest;
  };
  for (const auto& [d, runs, resolution, shortest] : {Case{3, 4, 3, 1},
                                                      {5, 16, 5, 1},
                                                      {6, 16, 4, 3},
                                                      {7, 16, 4, 7},
                                                      {8, 16, 4, 14},
                                                      {7, 8, 3, 7},
                                                      {6, 32, 6, 1},
                                                      {7, 32, 4, 1},
                                                      {8, 32, 4, 3},
                                                      {9, 32, 4, 6},
                                                      {10, 32, 4, 10},
                                                      {8, 64, 5, 2}}) {
    const Aliasing report = aliasing(d, fractional_generators(d, runs));
    EXPECT_EQ(report.resolution, resolution) << d << " variables, " << runs << " runs";
    EXPECT_EQ(report.word_counts[static_cast<std::size_t>(resolution)], shortest);
    EXPECT_EQ(fractional_factorial(support::unit_problem(d), runs).rows(), runs);
  }
  EXPECT_EQ(fractional_factorial(support::loader_problem(), 8), full_factorial(support::loader_problem(), 2));
}

TEST(FractionalFactorial, BadGeneratorsAreRefused) {
  const auto text = [](const std::vector<std::string>& generators) {
    return support::thrown_text<std::invalid_argument>(
        [&] { fractional_factorial(support::unit_problem(5), generators); });
  };
  EXPECT_EQ(text({"D=ABC"}),
            "doe::fractional_factorial: generator \"D=ABC\" does not read \"E=...\"; one generator a "
            "variable, in order");
  EXPECT_EQ(text({"E=ABE"}),
            "doe::fractional_factorial: generator \"E=ABE\" uses 'E'; allowed is each of ABCD once");
  EXPECT_EQ(text({"E=AA"}),
            "doe::fractional_factorial: generator \"E=AA\" uses 'A'; allowed is each of ABCD once");
  EXPECT_EQ(text({"E=-A"}),
            "doe::fractional_factorial: generator \"E=-A\" multiplies fewer than 2 variables; name more");
  EXPECT_EQ(support::thrown_text<std::invalid_argument>([] { fractional_generators(8, 12); }),
            "doe::fractional_generators: 8 variables in 12 runs; allowed are a power of 2 from d + 1 to 2^d, "
            "at most "
            "1024, and up to 25 variables");
}

/// Σ x_j⁴ = 3 Σ x_j² x_k² for all pairs, and odd moments vanish: what makes a second-order design rotatable
/// (Box, Hunter 1957). Entries are at most α⁴ = 2^d and add up to 2^(d+2): a few ulp of that.
bool rotatable(const Eigen::MatrixXd& X) {
  const Eigen::MatrixXd squares = X.array().square();
  const Eigen::MatrixXd moments = squares.transpose() * squares;
  const double tolerance = 1e-13 * moments(0, 0);
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    for (Eigen::Index k = 0; k < X.cols(); ++k)
      if (j != k && std::abs(moments(j, j) - 3.0 * moments(j, k)) > tolerance) return false;
  return X.colwise().sum().cwiseAbs().maxCoeff() < tolerance;
}

TEST(CentralComposite, TheDefaultIsRotatableInsideTheBounds) {
  for (int d = 2; d <= 6; ++d) {
    const Problem problem = coded_problem(d);
    const Eigen::MatrixXd X = central_composite(problem, {.centre_runs = 4});
    ASSERT_EQ(X.rows(), (1 << d) + 2 * d + 4);
    EXPECT_TRUE(support::inside(problem, X));
    EXPECT_EQ(X.maxCoeff(), 1.0);
    EXPECT_TRUE(rotatable(X));
    EXPECT_TRUE((X.bottomRows(4).array() == 0.0).all());
  }
  EXPECT_TRUE(rotatable(central_composite(coded_problem(5), {.generators = {"E=ABCD"}})));
}

TEST(CentralComposite, TheThreeKinds) {
  const Problem problem = coded_problem(3);
  const auto design = [&](CentralCompositeKind kind, std::optional<double> alpha = {}) {
    return central_composite(problem, {.kind = kind, .alpha = alpha});
  };
  const double alpha = std::pow(8.0, 0.25);
  const Eigen::MatrixXd outside = design(CentralCompositeKind::circumscribed),
                        within = design(CentralCompositeKind::inscribed),
                        faces = design(CentralCompositeKind::face_centred);
  EXPECT_EQ(outside.topRows(8), full_factorial(problem, 2));
  EXPECT_NEAR(outside(8, 0), -alpha, 1e-15);
  EXPECT_TRUE(rotatable(outside));
  EXPECT_LE((within * alpha - outside).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(faces.topRows(8), outside.topRows(8));
  EXPECT_EQ(faces(9, 0), 1.0);
  EXPECT_FALSE(rotatable(faces));
  EXPECT_NEAR(design(CentralCompositeKind::circumscribed, 1.5)(8, 0), -1.5, 1e-15);
}

// The table of the paper: runs without centres, and d = 4 and 7 exactly rotatable.
TEST(BoxBehnken, RunsBlocksAndRotatability) {
  for (const auto& [d, runs] : {std::pair{3, 12}, {4, 24}, {5, 40}, {6, 48}, {7, 56}, {8, 112}}) {
    const Eigen::MatrixXd X = box_behnken(coded_problem(d), {.centre_runs = 3});
    ASSERT_EQ(X.rows(), runs + 3);
    EXPECT_EQ(rotatable(X), d == 4 || d == 7) << d;
    const Eigen::VectorXd in_use = X.topRows(runs).cwiseAbs().rowwise().sum();
    EXPECT_TRUE((in_use.array() == (d == 6 || d == 7 ? 3.0 : 2.0)).all());
    EXPECT_TRUE((X.cwiseAbs().colwise().sum().array() == X.col(0).cwiseAbs().sum()).all());
    EXPECT_LE((X.transpose() * X)
                  .eval()
                  .triangularView<Eigen::StrictlyUpper>()
                  .toDenseMatrix()
                  .cwiseAbs()
                  .maxCoeff(),
              0.0);
  }
}

TEST(ResponseSurfaceDesigns, IntegersAreRoundedAndBadInputRefused) {
  Problem problem = support::mixed_problem();
  const auto text = [](const auto& action) { return support::thrown_text<std::invalid_argument>(action); };
  EXPECT_EQ(
      text([&] { box_behnken(problem); }),
      "doe::box_behnken: variable \"tool\" is categorical and has no middle; make one design for each of its "
      "levels");
  problem.variables.pop_back();
  const Eigen::VectorXd edges = box_behnken(problem).col(2), stars = central_composite(problem).col(2);
  for (const double teeth : edges) EXPECT_TRUE(teeth == 2 || teeth == 4 || teeth == 6);
  for (const double teeth : stars) EXPECT_EQ(teeth, std::round(teeth));
  EXPECT_EQ(
      text([&] { central_composite(problem, {.alpha = 0.5}); }),
      "doe::central_composite: alpha is 0.5; allowed is 1 or more; leave it out for the rotatable design");
  EXPECT_EQ(text([&] { central_composite(problem, {.centre_runs = -1}); }),
            "doe::central_composite: centre_runs is -1; allowed is 0 or more");
  EXPECT_EQ(text([&] { box_behnken(support::unit_problem(2)); }),
            "doe::box_behnken: the problem has 2 variables; allowed is 3 or more; use central_composite");
}

}  // namespace
