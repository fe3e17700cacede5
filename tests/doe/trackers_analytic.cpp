// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

/// Faults that users of other libraries reported in public, as cases whose answer is known exactly. Each
/// test names the tracker and the number of the report.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <drawpoint/doe/distribution.hpp>
#include <drawpoint/doe/fractional_factorial.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/morris.hpp>
#include <drawpoint/doe/quality.hpp>
#include <drawpoint/doe/sensitivity.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

/// 1 at all points but the first that is asked for, times `unit`, plus `offset`.
struct OneOddRun {
  double offset, unit;
  std::optional<Eigen::VectorXd> odd = {};

  double operator()(const Eigen::VectorXd& x) {
    if (!odd) odd = x;
    return offset + (x == *odd ? -139.8 : 1.0) * unit;
  }
};

SobolIndices indices_of_one_odd_run(double offset, double unit, SobolEstimator estimator, int samples) {
  OneOddRun f{offset, unit};
  const auto black_box = [&f](const Eigen::VectorXd& x) { return f(x); };
  return sobol_indices(black_box, support::unit_problem(2), {.samples = samples, .estimator = estimator})
      .responses[0];
}

/// "J=ABCD" for bits 0 to 3 of the word, behind `free` free variables.
std::vector<std::string> generators_of(int free, const std::vector<unsigned>& words) {
  std::vector<std::string> generators;
  for (const unsigned word : words) {
    std::string text{detail::factor_letters[static_cast<std::size_t>(free) + generators.size()], '='};
    for (std::size_t j = 0; j < static_cast<std::size_t>(free); ++j)
      if (word >> j & 1U) text += detail::factor_letters[j];
    generators.push_back(text);
  }
  return generators;
}

}  // namespace

// numpy/numpy #32446: the correlation of two constant columns came out as 1, because the mean of 1448 times
// 1.81 is not 1.81 to the last bit, and what is left over was taken for variance. A column that does not
// vary correlates with nothing; the header of largest_correlation counts it as uncorrelated, which is 0.
TEST(Trackers, ConstantColumnsCorrelateWithNothing) {
  for (const int n : {2, 3, 10, 50, 1000, 1448}) {
    Eigen::MatrixXd X(n, 2);
    X.col(0).setConstant(1.810);
    X.col(1).setConstant(0.576);
    EXPECT_EQ(largest_correlation(X), 0.0) << n << " rows";
    X.col(0).setConstant(0.3);
    X.col(1).setConstant(0.1);
    EXPECT_EQ(largest_correlation(X), 0.0) << n << " rows";
  }
}

// scipy/scipy #9353: pearsonr squared small numbers until they vanished, and then called the columns
// perfectly correlated. A correlation has no unit: columns times a power of two, which rounds nothing, have
// the same one. That of (1, 2, 3) and (3, 2, 1.5) is Σ (x − 2) y/√(2 Σ (y − 13/6)²) = −1.5/√(2·(25 + 1 +
// 16)/36) = −0.98198.
TEST(Trackers, ACorrelationHasNoUnit) {
  Eigen::MatrixXd X(3, 2);
  X << 1, 3, 2, 2, 3, 1.5;
  const double exact = 1.5 / std::sqrt(2.0 * 42 / 36);
  for (const int power : {-700, -300, 0, 300, 700})  // a dozen operations on numbers below 10
    EXPECT_NEAR(largest_correlation(std::ldexp(1.0, power) * X), exact, 1e-14) << "2^" << power;
}

// SALib/SALib #619: where all but one of the values are equal, the variance of the equal ones was round-off,
// and indices were quotients of round-off. With D the odd value less the others, p = 1/2N and V = p (1 − p)
// D²: f(A) − f(C) is D in the one odd pair, so T = ½D²/N/V = 1/(1 − p), and f(B), its mean taken off, is
// −pD, so S = pD²/N/V = 2p/(1 − p). Martinez's S is the correlation of f(B) with f(C), which do not vary: 0,
// and T = 1. Offset and unit change nothing. The terms are sums of 128 numbers below 1, and V is 1/256 of
// their largest: 1e-12 is a wide bound of the rounding.
TEST(Trackers, OneOddValueAmongEqualOnesHasExactIndices) {
  const int N = 128;
  const double p = 0.5 / N;
  for (const double offset : {0.0, 191.53, -0.9, 1e3})
    for (const double unit : {1.0, 0.1, 7.0}) {
      const SobolIndices saltelli = indices_of_one_odd_run(offset, unit, SobolEstimator::saltelli, N),
                         martinez = indices_of_one_odd_run(offset, unit, SobolEstimator::martinez, N);
      for (int j = 0; j < 2; ++j) {
        EXPECT_NEAR(saltelli.first.value[j], 2 * p / (1 - p), 1e-12);
        EXPECT_NEAR(saltelli.total.value[j], 1 / (1 - p), 1e-12);
        EXPECT_EQ(saltelli.total.lower[j], 0.0) << "one bootstrap sample in e misses the odd pair";
        EXPECT_NEAR(martinez.first.value[j], 0.0, 1e-12) << offset << ", " << unit;
        EXPECT_NEAR(martinez.first.lower[j], 0.0, 1e-12) << offset << ", " << unit;
        EXPECT_NEAR(martinez.first.upper[j], 0.0, 1e-12) << offset << ", " << unit;
        EXPECT_NEAR(martinez.total.value[j], 1.0, 1e-12) << offset << ", " << unit;
      }
    }
}

// anyoptimization/pymoo #133: whole numbers with wide bounds passed through 32 bits, turned negative and
// left their bounds. The slope of f = n is 1 everywhere, so each effect per range is the range, 2e9, exactly
// but for a quotient of three roundings; and no run may lie outside of the bounds, which evaluate would
// refuse.
TEST(Trackers, WideIntegersStayInTheirBounds) {
  const Problem problem{{integer_variable("n", "1", -1000000000, 1000000000)}, {{"f", "1"}}};
  const auto f = [](const Eigen::VectorXd& x) { return x[0]; };
  const Eigen::MatrixXd X = latin_hypercube(problem, 1000);
  EXPECT_GE(X.minCoeff(), -1e9);
  EXPECT_LE(X.maxCoeff(), 1e9);
  EXPECT_EQ(X, X.array().round().matrix());
  const ElementaryEffects e = morris_screening(f, problem, {.trajectories = 100}).responses[0];
  EXPECT_NEAR(e.mean[0], 2e9, 1e-5);
  EXPECT_NEAR(e.mean_absolute[0], 2e9, 1e-5);
  EXPECT_NEAR(e.deviation[0], 0.0, 1e-5);
  EXPECT_EQ(e.count[0], 100);
}

// SALib/SALib #312: with many levels the second input of Ishigami's function seemed inert; with four it is
// known exactly. From −π, −π/3, π/3, π the term 7 sin²x₂ takes 0, 21/4, 21/4, 0, and a step of two levels,
// 2/3 of the range, changes it by 21/4 up or down: every |effect| is (21/4)/(2/3) = 7.875, the number that
// the report prints. The other terms, below 11, cancel to 1e-14, over 2/3.
TEST(Trackers, TheSecondInputOfIshigamisFunctionHasEffectsOfOneSize) {
  Problem problem = support::unit_problem(3);
  for (Variable& v : problem.variables) v.lower = -std::numbers::pi, v.upper = std::numbers::pi;
  const auto ishigami = [](const Eigen::VectorXd& x) {
    return std::sin(x[0]) * (1 + 0.1 * std::pow(x[2], 4)) + 7 * std::pow(std::sin(x[1]), 2);
  };
  const ElementaryEffects e = morris_screening(ishigami, problem, {.trajectories = 40}).responses[0];
  EXPECT_NEAR(e.mean_absolute[1], 7.875, 1e-13);
  EXPECT_NEAR(e.standard_error[1], 0.0, 1e-13);
  // Effects of ±a with the mean m have the squared deviation (a² − m²) n/(n − 1).
  EXPECT_NEAR(e.deviation[1], std::sqrt((7.875 * 7.875 - e.mean[1] * e.mean[1]) * 40 / 39), 1e-12);
}

// scipy/scipy #22829 (of #19839 and #21293): which of the discrepancies is the square was not said, and
// users got roots of roots. The request quotes the squared ones that Zhou, Fang and Ning print for a design
// of 24 runs of three levels, with 16 digits. 576 products below 2 are summed, and a constant of 1.3 to 2.4
// taken off: some 20 roundings of 2.
TEST(Trackers, DiscrepanciesAreTheSquaredOnesOfThePaper) {
  Eigen::MatrixXd U(24, 3);
  for (Eigen::Index i = 0; i < 24; ++i) U(i, 0) = static_cast<double>(1 + i / 8);
  U.col(1) << 1, 1, 2, 2, 2, 3, 3, 3, 1, 1, 1, 2, 2, 2, 3, 3, 1, 1, 1, 2, 2, 3, 3, 3;
  U.col(2) << 1, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 1, 2, 3, 2, 3, 1, 2, 3;
  U = ((2.0 * U.array() - 1.0) / 6.0).matrix().eval();
  EXPECT_NEAR(squared_centred_discrepancy(U), 0.0327789208962088, 1e-14);
  EXPECT_NEAR(squared_wrap_around_discrepancy(U), 0.10085162322816635, 1e-14);
}

// equinor/libres #878: the triangle 0.5, 1, 5 was sampled wrongly because it is lopsided. Left of its mode
// lies (1 − 0.5)/4.5 = 1/9 of it; beyond x >= 1 lies (5 − x)²/(4.5·4), so the median is 5 − √9 = 2, and half
// of the runs of a Latin hypercube of 1000, those of its lower 500 strata, lie below.
TEST(Trackers, ALopsidedTriangleHasItsMedianAtTwo) {
  const Distribution triangle = triangular(0.5, 1.0, 5.0);
  EXPECT_NEAR(triangle.quantile(1.0 / 9), 1.0, 1e-15);
  EXPECT_NEAR(triangle.quantile(0.5), 2.0, 1e-15);
  EXPECT_NEAR(triangle.probability(2.0), 0.5, 1e-15);
  Problem problem = support::unit_problem(1);
  problem.variables[0].lower = 0.5, problem.variables[0].upper = 5.0;
  const Eigen::MatrixXd X =
      distributed(problem, {{"x0", triangle}}, latin_hypercube(problem, 1000, {.centred = true}));
  EXPECT_EQ((X.array() < 2.0).count(), 500);
}

// pydoe/pydoe #157 (of #83 and #153): fractions asked for by their resolution did not reach it, among them 9
// to 15 factors at resolution V. The words of a fraction are a linear code and the resolution is its least
// distance; adding in rising order each column that is no sum of R − 2 or fewer of those before gives the
// generators below, whose resolution is counted word by word. So a fraction of that size has it, and one of
// minimum aberration cannot have less.
TEST(Trackers, FractionsHaveTheHighestResolutionThatIsKnown) {
  struct Case {
    int free, resolution;
    std::vector<unsigned> words;
  };
  const std::array<Case, 7> cases{Case{7, 6, {31, 103}},
                                  Case{7, 5, {15, 51, 85}},
                                  Case{7, 5, {15, 51, 85, 106}},
                                  Case{8, 6, {31, 103, 171, 213}},
                                  Case{8, 5, {15, 51, 85, 106, 150}},
                                  Case{8, 5, {15, 51, 85, 106, 150, 171, 219}},
                                  Case{8, 5, {15, 51, 85, 106, 150, 171, 219, 237, 247}}};
  for (const auto& [free, resolution, words] : cases) {
    const int d = free + static_cast<int>(words.size());
    ASSERT_EQ(aliasing(d, generators_of(free, words)).resolution, resolution) << d << " variables";
    EXPECT_GE(aliasing(d, fractional_generators(d, 1 << free)).resolution, resolution)
        << d << " variables in " << (1 << free) << " runs";
  }
}
