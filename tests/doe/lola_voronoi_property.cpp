// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <drawpoint/doe/evaluate.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/lola_voronoi.hpp>
#include <drawpoint/tests/doe/problems.hpp>
#include <limits>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

double bumpy(const Eigen::VectorXd& x) { return std::sin(9 * x[0]) * x[1] + x[1] * x[1]; }

Evaluations runs_of(double (*f)(const Eigen::VectorXd&), int d, int n) {
  const Problem problem = support::unit_problem(d);
  return evaluate(f, problem, latin_hypercube(problem, n, {.seed = 3}));
}

void expect_same(const LolaVoronoiScores& a, const LolaVoronoiScores& b) {
  EXPECT_EQ(a.U, b.U);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.nonlinear, b.nonlinear);
  EXPECT_EQ(a.hybrid, b.hybrid);
}

TEST(LolaVoronoi, VolumesSumToOneAndSharesToOne) {
  for (const int n : {1, 2, 5, 60}) {
    const LolaVoronoiScores s = LolaVoronoi().scores(runs_of(bumpy, 2, n));
    // Counts over their sum: each share is rounded, and each of the additions, by half an ulp of 1 at most.
    const double rounding = 0.5 * std::numeric_limits<double>::epsilon() * (n + 1);
    EXPECT_NEAR(s.volume.sum(), 1.0, rounding);
    if (n > 5) {
      EXPECT_NEAR(s.nonlinear.sum(), 1.0, rounding);
    }
    EXPECT_GE(s.nonlinear.minCoeff(), 0.0);
  }
}

// Cells of 0.1, 0.5, 0.8 in [0, 1] end at 0.3 and 0.65. Counts of N points are binomial: five standard
// deviations are passed by one seed in 1.7 million.
TEST(LolaVoronoi, VolumesAreThoseOfTheCells) {
  const Problem problem = support::unit_problem(1);
  const Evaluations runs =
      evaluate([](const Eigen::VectorXd& x) { return x[0]; }, problem, Eigen::Vector3d(0.1, 0.5, 0.8));
  const Eigen::VectorXd V = LolaVoronoi({.points_per_site = 10000}).scores(runs).volume;
  const Eigen::Vector3d exact(0.3, 0.35, 0.35);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(V[i], exact[i], 5 * std::sqrt(exact[i] * (1 - exact[i]) / 30000));
}

TEST(LolaVoronoi, OfALinearResponseFillsSpace) {
  const Evaluations runs =
      runs_of([](const Eigen::VectorXd& x) { return 3 * x[0] - 2 * x[1] + 0.5 * x[2] + 7; }, 3, 50);
  const LolaVoronoiScores s = LolaVoronoi().scores(runs);
  EXPECT_EQ(s.nonlinear, Eigen::VectorXd::Zero(50));
  EXPECT_EQ(s.hybrid, s.volume);
  expect_same(LolaVoronoi().scores(runs_of([](const Eigen::VectorXd&) { return 5.0; }, 3, 50)), s);
}

// |x − 0.55| on the sites 0, 0.1, ..., 1 is a plane around every site but 0.5 and 0.6, which are alike: each
// has half of ΣE. The rounding of the other nine is below 1e-14 of it.
TEST(LolaVoronoi, FindsAKink) {
  const Problem problem = support::unit_problem(1);
  Eigen::MatrixXd X(11, 1);
  for (int i = 0; i < 11; ++i) X(i) = i / 10.0;
  const Evaluations runs =
      evaluate([](const Eigen::VectorXd& x) { return std::abs(x[0] - 0.55); }, problem, X);
  const LolaVoronoiScores s = LolaVoronoi().scores(runs);
  for (int i = 0; i < 11; ++i) EXPECT_NEAR(s.nonlinear[i], i == 5 || i == 6 ? 0.5 : 0.0, 1e-13) << i;
}

TEST(LolaVoronoi, HybridsAreTheirFormulas) {
  const Evaluations runs = runs_of(bumpy, 2, 40);
  const LolaVoronoiScores s = LolaVoronoi().scores(runs);
  const auto hybrid = [&](Hybrid form, double w = 0.5) {
    return LolaVoronoi({.hybrid = form, .voronoi_weight = w}).scores(runs).hybrid;
  };
  EXPECT_EQ(s.hybrid, s.volume + s.nonlinear);
  EXPECT_TRUE(hybrid(Hybrid::weighted, 0.25).isApprox(0.25 * s.volume + 0.75 * s.nonlinear, 1e-15));
  EXPECT_EQ(hybrid(Hybrid::weighted, 1.0), s.volume);
  EXPECT_EQ(voronoi_sampler().scores(runs).hybrid, s.volume);
}

TEST(LolaVoronoi, BatchByBatchGivesTheBitsOfAllAtOnce) {
  const Evaluations all = runs_of(bumpy, 2, 60);
  LolaVoronoi growing;
  for (const std::size_t n : {7U, 8U, 31U, 60U}) {
    Evaluations some{all.problem, {all.rows.begin(), all.rows.begin() + static_cast<std::ptrdiff_t>(n)}};
    expect_same(growing.scores(some), LolaVoronoi().scores(some));
  }
  const Evaluations other = runs_of(bumpy, 2, 20);
  expect_same(growing.scores(other), LolaVoronoi().scores(other));
}

TEST(LolaVoronoi, FailedRunsTakeSpaceAndHaveNoNonlinearity) {
  Evaluations runs = runs_of(bumpy, 2, 40);
  for (const std::size_t i : {3U, 17U}) runs.rows[i].outcome = Failure{"stuck"};
  LolaVoronoi lola;
  const LolaVoronoiScores s = lola.scores(runs);
  EXPECT_EQ(s.volume, LolaVoronoi().scores(runs_of(bumpy, 2, 40)).volume);
  EXPECT_EQ(s.nonlinear[3], 0.0);
  EXPECT_EQ(s.nonlinear[17], 0.0);
  EXPECT_FALSE(s.ok[3]);
  EXPECT_GT(s.nonlinear.sum(), 0.0);
  runs.rows[3].outcome = 0.25;  // a second try succeeds
  expect_same(lola.scores(runs), LolaVoronoi().scores(runs));
  for (Evaluation& row : runs.rows) row.outcome = Failure{"all"};
  EXPECT_EQ(LolaVoronoi().scores(runs).hybrid, s.volume);
}

TEST(LolaVoronoi, ReplicatesAreOneSiteWithTheirMean) {
  const Evaluations once = runs_of(bumpy, 2, 30);
  Evaluations twice = once;
  for (std::size_t i = 0; i < once.rows.size(); ++i) {
    const double y = once.rows[i].outcome.values()[0];
    twice.rows[i].outcome = y + 0.25;
    Evaluation second = once.rows[i];
    second.replicate = 1;
    second.outcome = y - 0.25;
    twice.rows.push_back(second);
  }
  const LolaVoronoiScores a = LolaVoronoi().scores(once), b = LolaVoronoi().scores(twice);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_TRUE(a.nonlinear.isApprox(b.nonlinear, 1e-12));  // the means carry rounding of 1e-16 of a range of 1
}

TEST(LolaVoronoi, UnitsDoNotMatter) {
  const Evaluations runs = runs_of(bumpy, 2, 40);
  Evaluations scaled = runs;  // by powers of two, which do not round
  scaled.problem.variables[1].upper = 1024;
  for (Evaluation& row : scaled.rows) {
    row.x[1] *= 1024;
    row.outcome = 4096 * row.outcome.values()[0];
  }
  const LolaVoronoiScores a = LolaVoronoi().scores(runs), b = LolaVoronoi().scores(scaled);
  EXPECT_EQ(a.U, b.U);
  EXPECT_EQ(a.nonlinear, b.nonlinear);
}

TEST(LolaVoronoi, SeveralResponsesAreCombined) {
  const Problem problem = support::unit_problem(2, 2);
  const auto f = [](const Eigen::VectorXd& x) -> Outcome { return {bumpy(x), 1e6 * std::abs(x[0] - 0.3)}; };
  const Evaluations runs = evaluate(f, problem, latin_hypercube(problem, 40, {.seed = 3}));
  const auto shares = [&](std::vector<std::string> names, Combine combine) {
    return LolaVoronoi({.responses = std::move(names), .combine = combine}).scores(runs).nonlinear;
  };
  const Eigen::VectorXd first = shares({"f0"}, Combine::largest), second = shares({"f1"}, Combine::largest);
  EXPECT_GT((first - second).norm(), 0.1);
  EXPECT_EQ(first, LolaVoronoi().scores(runs_of(bumpy, 2, 40)).nonlinear);
  // E = a·first + b·second with the unknown totals a and b: both come back from the average by least squares.
  const Eigen::VectorXd average = shares({}, Combine::average);
  Eigen::MatrixXd basis(40, 2);
  basis << first, second;
  const Eigen::Vector2d ab = basis.colPivHouseholderQr().solve(average);
  EXPECT_LT((basis * ab - average).norm(), 1e-13);
  EXPECT_NEAR(ab.sum(), 1.0, 1e-12);
  const Eigen::VectorXd largest = shares({}, Combine::largest);
  const double c = (ab[0] * first).cwiseMax(ab[1] * second).sum();
  EXPECT_TRUE(largest.isApprox((ab[0] * first).cwiseMax(ab[1] * second) / c, 1e-12));
}

// In the half x0 < 0.5 of the box, the volume of the sites beyond comes from the border alone.
TEST(LolaVoronoi, CountsVolumesWhereRunsAreAllowed) {
  const Evaluations runs = runs_of(bumpy, 2, 40);
  const auto allowed = [](const Eigen::VectorXd& x) { return x[0] < 0.5; };
  const LolaVoronoiScores s = LolaVoronoi({.allowed = allowed}).scores(runs);
  EXPECT_NEAR(s.volume.sum(), 1.0, 1e-14);
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(s.U(i, 0) < 0.9 || s.volume[i] == 0.0);
}

TEST(LolaVoronoi, ACandidateHasTheScoreOfItsCell) {
  const Evaluations runs = runs_of(bumpy, 2, 25);
  LolaVoronoi lola;
  const LolaVoronoiScores s = lola.scores(runs);
  EXPECT_EQ(lola(runs)(s.U), s.hybrid);
}

TEST(LolaVoronoi, BadInputIsNamed) {
  using support::thrown_text;
  EXPECT_EQ(thrown_text<std::invalid_argument>([] { LolaVoronoi({.voronoi_weight = 1.5}); }),
            "doe::LolaVoronoi: voronoi_weight is 1.5; allowed is 0 to 1; 1 fills space and 0 follows the "
            "non-linearity");
  EXPECT_EQ(thrown_text<std::invalid_argument>([] { LolaVoronoi({.points_per_site = 0}); }),
            "doe::LolaVoronoi: points_per_site is 0; allowed is 1 or more; 100 gives volumes to a tenth");
  const Evaluations runs = runs_of(bumpy, 2, 5);
  EXPECT_EQ(thrown_text<std::invalid_argument>([&] { LolaVoronoi({.responses = {"g"}}).scores(runs); }),
            "doe::Problem: no response \"g\"; the responses are \"f0\"");
  EXPECT_EQ(thrown_text<std::invalid_argument>([&] {
              LolaVoronoi().scores({runs.problem, {}});
            }),
            "doe::LolaVoronoi: the table has 0 runs; allowed is 1 or more; evaluate an initial design first");
  const auto never = [](const Eigen::VectorXd&) { return false; };
  EXPECT_EQ(
      thrown_text<std::invalid_argument>([&] { LolaVoronoi({.allowed = never}).scores(runs); }),
      "doe::VoronoiCells: allowed holds at fewer than 1 of 1000 points of the box; narrow the bounds of "
      "the variables to the allowed part");
}

}  // namespace
