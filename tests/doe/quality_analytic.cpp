// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/quality.hpp>
#include <drawpoint/tests/doe/designs.hpp>
#include <functional>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

/// Nodes and weights of Simpson's rule on every piece of [0, 1] between the breaks: exact for a function that
/// is a quadratic on each piece.
struct Simpson {
  std::vector<double> nodes, weights;

  explicit Simpson(std::vector<double> breaks) {
    breaks.insert(breaks.end(), {0.0, 1.0});
    std::sort(breaks.begin(), breaks.end());
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      const double a = breaks[k], h = breaks[k + 1] - a;
      // Nodes a hair inside: whether a box is open or closed must not matter, and a quadratic changes by
      // 1e-12.
      for (const auto& [share, weight] : {std::pair{1e-12, 1.0}, {0.5, 4.0}, {1.0 - 1e-12, 1.0}}) {
        nodes.push_back(a + share * h);
        weights.push_back(weight * h / 6.0);
      }
    }
  }
};

/// Whether a box that belongs to y holds the coordinate u, and how long it is.
struct Side {
  bool holds;
  double length;
};
using Box = std::function<Side(double y, double u)>;

Side nearest_corner(double y, double u) { return y < 0.5 ? Side{u < y, y} : Side{u > y, 1.0 - y}; }
Side origin(double y, double u) { return {u < y, y}; }

/// ∫∫ (share of points in the box - its area)² dy over the unit square, from the definition.
double mean_squared_gap(const Eigen::MatrixXd& U, const Box& box, const Simpson& rule) {
  double integral = 0.0;
  for (std::size_t a = 0; a < rule.nodes.size(); ++a)
    for (std::size_t b = 0; b < rule.nodes.size(); ++b) {
      double held = 0.0;
      for (Eigen::Index i = 0; i < U.rows(); ++i)
        held += box(rule.nodes[a], U(i, 0)).holds && box(rule.nodes[b], U(i, 1)).holds;
      const double area = box(rule.nodes[a], 0.0).length * box(rule.nodes[b], 0.0).length;
      integral +=
          rule.weights[a] * rule.weights[b] * std::pow(held / static_cast<double>(U.rows()) - area, 2);
    }
  return integral;
}

/// The same for one coordinate.
double mean_squared_gap(const Eigen::VectorXd& u, const Box& box, const Simpson& rule) {
  double integral = 0.0;
  for (std::size_t a = 0; a < rule.nodes.size(); ++a) {
    double held = 0.0;
    for (const double x : u) held += box(rule.nodes[a], x).holds;
    integral +=
        rule.weights[a] * std::pow(held / static_cast<double>(u.size()) - box(rule.nodes[a], 0.0).length, 2);
  }
  return integral;
}

Simpson rule_of(const Eigen::MatrixXd& U) {
  std::vector<double> breaks(U.data(), U.data() + U.size());
  breaks.push_back(0.5);
  return Simpson(std::move(breaks));
}

// The integrals over some 30 x 30 pieces carry 1e-12 from the nodes and 1e-16 a term from rounding; 1e-10
// covers both.
TEST(Discrepancy, StarIsTheMeanSquaredGapOfBoxesAtTheOrigin) {
  for (Seed seed = 1; seed <= 5; ++seed) {
    const Eigen::MatrixXd U = latin_hypercube(support::unit_problem(2), 7, {.seed = seed});
    EXPECT_NEAR(squared_star_discrepancy(U), mean_squared_gap(U, origin, rule_of(U)), 1e-10);
  }
}

// Hickernell's centred discrepancy adds the gaps of every projection: both axes and the square.
TEST(Discrepancy, CentredIsTheSumOverProjectionsForBoxesAtTheNearestCorner) {
  for (Seed seed = 1; seed <= 5; ++seed) {
    const Eigen::MatrixXd U = latin_hypercube(support::unit_problem(2), 7, {.seed = seed});
    const Simpson rule = rule_of(U);
    const double sum = mean_squared_gap(Eigen::VectorXd(U.col(0)), nearest_corner, rule) +
                       mean_squared_gap(Eigen::VectorXd(U.col(1)), nearest_corner, rule) +
                       mean_squared_gap(U, nearest_corner, rule);
    EXPECT_NEAR(squared_centred_discrepancy(U), sum, 1e-10);
  }
}

// One variable, n midpoints: the star discrepancy is 1/(12 n²) (Niederreiter). On a torus every box of length
// t holds n·t points rounded: the mean over place and length of the squared rounding error of n·t is ∫ f(1 -
// f) df = 1/6, over n².
TEST(Discrepancy, MidpointsOfOneVariable) {
  for (const int n : {1, 2, 5, 40}) {
    const Eigen::MatrixXd U = (Eigen::ArrayXd::LinSpaced(n, 0.0, n - 1.0) + 0.5) / n;
    EXPECT_NEAR(squared_star_discrepancy(U), 1.0 / (12.0 * n * n), 1e-15);
    EXPECT_NEAR(squared_wrap_around_discrepancy(U), 1.0 / (6.0 * n * n), 1e-15);
  }
}

// A shift on the torus changes nothing: 2e-16 a term of the double sum, divided by n².
TEST(Discrepancy, WrapAroundDoesNotSeeShifts) {
  const Eigen::MatrixXd U = latin_hypercube(support::unit_problem(3), 20, {.seed = 4});
  Eigen::MatrixXd shifted = U.array() + 0.37;
  for (double& u : shifted.reshaped()) u -= std::floor(u);
  EXPECT_NEAR(squared_wrap_around_discrepancy(U), squared_wrap_around_discrepancy(shifted), 1e-14);
}

// The example of the documentation of SciPy's qmc.discrepancy, six points, printed there with 16 digits.
TEST(Discrepancy, CentredAgreesWithSciPy) {
  Eigen::MatrixXd U(6, 2);
  U << 1, 3, 2, 6, 3, 2, 4, 5, 5, 1, 6, 4;
  U = ((U.array() - 0.5) / 6.0).matrix().eval();
  EXPECT_NEAR(squared_centred_discrepancy(U), 0.008142039609053464, 1e-15);
}

// Corners of the unit square: four distances 1 and two sqrt 2.
TEST(Distances, OfTheCornersOfASquare) {
  Eigen::MatrixXd U(4, 2);
  U << 0, 0, 0, 1, 1, 0, 1, 1;
  EXPECT_EQ(minimum_distance(U), 1.0);
  EXPECT_NEAR(phi_p(U, 2.0), std::sqrt(4.0 + 2.0 / 2.0), 1e-15);
  EXPECT_NEAR(phi_p(U, 1.0), 4.0 + 2.0 / std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(phi_p(0.001 * U, 200.0), 1000.0 * std::pow(4.0 + 2.0 * std::pow(2.0, -100.0), 1.0 / 200.0),
              1e-10);
}

TEST(Distances, CoincidingAndSinglePoints) {
  const Eigen::MatrixXd twice = Eigen::MatrixXd::Constant(2, 3, 0.25);
  EXPECT_EQ(minimum_distance(twice), 0.0);
  EXPECT_TRUE(std::isinf(phi_p(twice)));
  EXPECT_TRUE(std::isinf(minimum_distance(twice.topRows(1))));
  EXPECT_EQ(phi_p(twice.topRows(1)), 0.0);
}

TEST(Correlation, TheLargestOfAllPairs) {
  Eigen::MatrixXd X(3, 3);
  X << 1, 6, 5, 2, 4, 5, 3, 2, 5;  // column 1 falls with column 0, column 2 is constant
  EXPECT_NEAR(largest_correlation(X), 1.0, 1e-15);
  EXPECT_EQ(largest_correlation(X.col(2)), 0.0);
}

TEST(DesignQuality, IsTakenInTheUnitBox) {
  Problem wide = support::unit_problem(2);
  wide.variables[1] = {"x1", "m", -100.0, 300.0};
  const Eigen::MatrixXd U = latin_hypercube(support::unit_problem(2), 12, {.seed = 3});
  Eigen::MatrixXd X = U;
  X.col(1) = -100.0 + 400.0 * U.col(1).array();
  const DesignQuality q = design_quality(wide, X, 4.0);
  EXPECT_NEAR(q.minimum_distance, minimum_distance(U), 1e-14);
  EXPECT_NEAR(q.phi_p, phi_p(U, 4.0), 1e-10);
  EXPECT_NEAR(q.squared_centred_discrepancy, squared_centred_discrepancy(U), 1e-14);
  EXPECT_TRUE(q.latin);
  X(0, 1) = X(1, 1);
  EXPECT_FALSE(design_quality(wide, X).latin);
}

TEST(DesignQuality, PointsOutsideAreRefused) {
  const auto text = [](const auto& action) { return support::thrown_text<std::invalid_argument>(action); };
  const Problem problem = support::mixed_problem();
  Eigen::MatrixXd X(1, 4);
  X << 1.0, 6.0, 2.0, 0.0;
  EXPECT_EQ(text([&] { design_quality(problem, X); }),
            "doe::design_quality: row 0, variable \"angle\": 6 deg is not within -25 deg to 5 deg; correct "
            "the point "
            "or the bounds");
  X << 1.0, 5.0, 2.5, 0.0;
  EXPECT_EQ(text([&] { design_quality(problem, X); }),
            "doe::design_quality: row 0, variable \"teeth\": 2.5 is not a whole number from 2 to 6; correct "
            "the point "
            "or the bounds");
  EXPECT_EQ(
      text([&] { design_quality(problem, X.leftCols(3)); }),
      "doe::design_quality: X has 3 columns, the problem has 4 variables; X is n x d with one run per row");
  EXPECT_EQ(text([&] { squared_star_discrepancy(X); }),
            "doe::squared_star_discrepancy: the points span 0 to 5; allowed is 0 to 1; scale them by the "
            "bounds, or "
            "call design_quality");
  EXPECT_EQ(text([&] { phi_p(X, 0.0); }), "doe::phi_p: p is 0; allowed is above 0; 10 to 50 is usual");
}

}  // namespace
