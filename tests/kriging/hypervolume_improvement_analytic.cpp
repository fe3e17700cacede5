// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/acquisition_hypervolume.hpp>
#include <drawpoint/kriging/any_surrogate.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/normal_surrogate.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using doe::Goal;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using reference::NormalSurrogate;

namespace {

doe::Problem objectives(Eigen::Index m, Goal goal = Goal::minimize) {
  doe::Problem problem{.variables = {{"a", "1", 0, 1}}, .responses = {}};
  for (Eigen::Index j = 0; j < m; ++j) problem.responses.push_back({"y" + std::to_string(j), "1", goal});
  return problem;
}

std::vector<NormalSurrogate> surrogates(Eigen::Index m) {
  std::vector<NormalSurrogate> all;
  for (Eigen::Index j = 0; j < m; ++j) all.push_back({2 * j});
  return all;
}

// One row: mean and deviation of each objective in turn.
MatrixXd point(const VectorXd& mean, const VectorXd& deviation) {
  MatrixXd x(1, 2 * mean.size());
  for (Eigen::Index j = 0; j < mean.size(); ++j) x(0, 2 * j) = mean[j], x(0, 2 * j + 1) = deviation[j];
  return x;
}

MatrixXd random_front(Eigen::Index k, Eigen::Index m, doe::Seed seed) {
  doe::RandomStream random(seed);
  MatrixXd Y(k, m);
  for (double& y : Y.reshaped()) y = random.uniform();
  return Y;
}

bool dominated(const VectorXd& z, const MatrixXd& front) {
  for (Eigen::Index i = 0; i < front.rows(); ++i)
    if ((front.row(i).transpose().array() <= z.array()).all()) return true;
  return false;
}

// ∫ Φ((z − μ)/σ) dz over [a, b] by Simpson's rule with 2000 panels.
double integral_of_probability(double mean, double sigma, double a, double b) {
  const int panels = 2000;
  const double h = (b - a) / panels;
  double sum = 0;
  for (int k = 0; k <= panels; ++k)
    sum += (k == 0 || k == panels ? 1
            : k % 2               ? 4
                                  : 2) *
           detail::normal_probability((a + k * h - mean) / sigma);
  return sum * h / 3;
}

// By Fubini the expected improvement is ∫ P(Y <= z) dz over the undominated z <= r: cells between the
// coordinates of the front, each dominated or not as a whole, each a product of one-dimensional integrals.
double by_quadrature(const VectorXd& mean, const VectorXd& deviation, const MatrixXd& front,
                     const VectorXd& r) {
  const Eigen::Index m = r.size();
  std::vector<std::vector<double>> cuts(m), parts(m);
  for (Eigen::Index j = 0; j < m; ++j) {
    cuts[j] = {std::min(mean[j], front.col(j).minCoeff()) - 9 * deviation[j], r[j]};
    for (const double y : front.col(j))
      if (y < r[j]) cuts[j].push_back(y);
    std::sort(cuts[j].begin(), cuts[j].end());
    for (std::size_t c = 0; c + 1 < cuts[j].size(); ++c)
      parts[j].push_back(integral_of_probability(mean[j], deviation[j], cuts[j][c], cuts[j][c + 1]));
  }
  double sum = 0;
  std::vector<std::size_t> cell(m, 0);
  for (;;) {
    VectorXd middle(m);
    double volume = 1;
    for (Eigen::Index j = 0; j < m; ++j) {
      middle[j] = 0.5 * (cuts[j][cell[j]] + cuts[j][cell[j] + 1]);
      volume *= parts[j][cell[j]];
    }
    if (!dominated(middle, front)) sum += volume;
    Eigen::Index j = 0;
    while (j < m && ++cell[j] == parts[j].size()) cell[j++] = 0;
    if (j == m) return sum;
  }
}

}  // namespace

// The boxes are disjoint and fill what no point dominates: random points are in one of them, or in none.
TEST(NonDominatedBoxes, CoverWhatIsNotDominatedOnce) {
  for (const Eigen::Index m : {1, 2, 3, 4})
    for (const doe::Seed seed : {1, 2, 3}) {
      const MatrixXd front = random_front(12, m, seed);
      const VectorXd r = VectorXd::Constant(m, 0.9);
      const detail::Boxes boxes = detail::non_dominated_boxes(front, r);
      doe::RandomStream random(seed + 100);
      for (int k = 0; k < 500; ++k) {
        VectorXd z(m);
        for (double& value : z) value = 1.2 * random.uniform() - 0.2;
        int inside = 0;
        for (Eigen::Index b = 0; b < boxes.lower.cols(); ++b)
          inside += (z.array() >= boxes.lower.col(b).array()).all() &&
                    (z.array() < boxes.upper.col(b).array()).all();
        EXPECT_EQ(inside, (z.array() < r.array()).all() && !dominated(z, front) ? 1 : 0) << m << " " << seed;
      }
    }
}

// On m = 2 a front of n points needs n + 1 boxes.
TEST(NonDominatedBoxes, AreAsManyAsStairsForTwoObjectives) {
  MatrixXd front(4, 2);
  front << 0.1, 0.8, 0.3, 0.5, 0.5, 0.3, 0.8, 0.1;
  EXPECT_EQ(detail::non_dominated_boxes(front, VectorXd::Ones(2)).lower.cols(), 5);
}

TEST(ExpectedHypervolumeImprovement, OfOneObjectiveIsExpectedImprovement) {
  MatrixXd x(1, 2);
  for (const double mean : {-1.0, 0.4, 3.0}) {
    x << mean, 0.5;
    const double one = expected_hypervolume_improvement(
        objectives(1), surrogates(1), {Eigen::Vector3d(0.7, 0.4, 0.9), VectorXd::Constant(1, 2.0)})(x)[0];
    EXPECT_EQ(one, expected_improvement(NormalSurrogate{}, Goal::minimize, 0.4)(x)[0]);
    const double none = expected_hypervolume_improvement(objectives(1), surrogates(1),
                                                         {MatrixXd(0, 1), VectorXd::Constant(1, 2.0)})(x)[0];
    EXPECT_EQ(none, expected_improvement(NormalSurrogate{}, Goal::minimize, 2.0)(x)[0]);
  }
}

// Intervals of at most 11 deviations of 0.2 in 2000 panels: h = 1.1e-3 = 5.5e-3 σ, so Simpson errs
// by 2.2/180·h⁴·max|Φ⁗| = 1.2e-2·1.5e-12·1.4/σ⁴ (875) = 2e-11 an interval; products and sums of some hundred
// cells stay below 5e-9.
TEST(ExpectedHypervolumeImprovement, EqualsTheQuadrature) {
  for (const Eigen::Index m : {2, 3, 4})
    for (const doe::Seed seed : {5, 6}) {
      const MatrixXd front = random_front(m == 4 ? 5 : 8, m, seed);
      const VectorXd r = VectorXd::Constant(m, 0.95);
      const doe::Criterion score = expected_hypervolume_improvement(objectives(m), surrogates(m), {front, r});
      for (const double centre : {0.05, 0.5, 1.0}) {
        const VectorXd mean = VectorXd::LinSpaced(m, centre, centre + 0.1);
        const VectorXd deviation = VectorXd::LinSpaced(m, 0.2, 0.3);
        EXPECT_NEAR(score(point(mean, deviation))[0], by_quadrature(mean, deviation, front, r), 5e-9);
      }
    }
}

// A point at (0.4, 0.2) beside (0.2, 0.6) and (0.6, 0.3), reference (1, 1): [0.4, 1] x [0.2, 1] is 0.48, of
// which [0.4, 1] x [0.6, 1] = 0.24 and [0.6, 1] x [0.3, 0.6] = 0.12 are dominated already. To maximise, all
// is mirrored.
TEST(ExpectedHypervolumeImprovement, WithoutVarianceIsTheImprovement) {
  const MatrixXd front = (MatrixXd(2, 2) << 0.2, 0.6, 0.6, 0.3).finished();
  const VectorXd y = Eigen::Vector2d(0.4, 0.2), none = VectorXd::Zero(2), r = VectorXd::Ones(2);
  EXPECT_NEAR(expected_hypervolume_improvement(objectives(2), surrogates(2), {front, r})(point(y, none))[0],
              0.12, 1e-15);
  EXPECT_NEAR(expected_hypervolume_improvement(objectives(2, Goal::maximize), surrogates(2),
                                               {-front, -r})(point(-y, none))[0],
              0.12, 1e-15);
  EXPECT_EQ(expected_hypervolume_improvement(objectives(2), surrogates(2), {front, r})(point(r, none))[0],
            0.0);
}

// Every run has a fitted value of its own among the front, or dominated by it: nothing is left to win there.
// The means at the runs are met to round-off, n ε Σ|α| of some 1e-11 for these conditions, over a front of
// length 2.
TEST(ExpectedHypervolumeImprovement, IsZeroAtTheRuns) {
  const MatrixXd X = reference::design(25, 2, 3);
  VectorXd a = X.col(0), b = (1.0 - X.col(0).array()).square() + X.col(1).array();
  doe::RandomStream random(3);
  for (double& value : a) value += 0.05 * random.normal();
  doe::Problem problem = objectives(2);
  problem.responses.push_back({"limit", "1", Goal::at_most, 5.0});
  const std::vector<Model> models{fit(X, a), fit(X, b), fit(X, VectorXd(X.col(1)))};
  const doe::Criterion score = constrained_hypervolume_improvement(problem, models);
  EXPECT_LE(score(X).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT(score(reference::design(300, 2, 8)).maxCoeff(), 1e-4);
  problem.responses[2].limit = -5.0;
  EXPECT_EQ(constrained_hypervolume_improvement(problem, models)(X),
            probability_of_feasibility(problem, models)(X));
}

// By hand: rows 0 to 2 are the front, row 3 is dominated, row 4 repeats row 0. The front is 3 long in both objectives;
// the worst run lies 1 beyond it in the first and 6 in the second. In any unit.
TEST(FrontView, ReachesAsFarBeyondTheFrontAsThatIsLong) {
  const MatrixXd Y = (MatrixXd(5, 2) << 0, 4, 1, 2, 3, 1, 4, 10, 0, 4).finished();
  for (const double unit : {1e-12, 1.0, 1e12}) {
    const std::vector<Eigen::Index> front = detail::front_rows(unit * Y, {0, 1, 2, 3, 4});
    EXPECT_EQ(front, (std::vector<Eigen::Index>{0, 1, 2}));
    const VectorXd reference = detail::reference_beyond(unit * Y, front) / unit;
    EXPECT_NEAR(reference[0], 4, 1e-12);
    EXPECT_NEAR(reference[1], 7, 1e-12);
    const FrontView view = detail::front_view(unit * Y, Eigen::Vector2d(1, -1), front);
    EXPECT_EQ(view.Y(2, 1), -unit);
    EXPECT_NEAR(view.reference[1] / unit, -7, 1e-12);
  }
  EXPECT_EQ(detail::front_rows(Y, {3, 4}), (std::vector<Eigen::Index>{4}));
  const MatrixXd ends = Y.topRows(3);  // the worst run is on the front
  EXPECT_LT((detail::reference_beyond(ends, {0, 1, 2}) - Eigen::Vector2d(3.3, 4.3)).norm(), 1e-12);
}

// One point: all runs. Two that differ by round-off in an objective: a tenth of all runs.
TEST(FrontView, OfFewRunsReachesFarEnough) {
  const MatrixXd one = (MatrixXd(2, 2) << 0, 0, 2, 4).finished();
  EXPECT_LT((detail::reference_beyond(one, {0}) - Eigen::Vector2d(2, 4)).norm(), 1e-12);
  const MatrixXd two = (MatrixXd(3, 2) << 0, 1, 1, 1 - 1e-12, 2, 5).finished();
  EXPECT_LT((detail::reference_beyond(two, {0, 1}) - Eigen::Vector2d(2, 1.4)).norm(), 1e-9);
}

// Kriging models behind AnySurrogate are re-interpolated as they are alone: noisy runs do not ask for
// themselves again.
TEST(ExpectedHypervolumeImprovement, OfModelsBehindAnySurrogateIsThatOfTheModels) {
  const MatrixXd X = reference::design(25, 2, 3);
  VectorXd a = X.col(0);
  doe::RandomStream random(3);
  for (double& value : a) value += 0.05 * random.normal();
  const std::vector<Model> models{fit(X, a), fit(X, (1.0 - X.col(0).array()).square() + X.col(1).array())};
  const FrontView front{(MatrixXd(3, 2) << 0.1, 1.2, 0.4, 0.6, 0.9, 0.1).finished(),
                        Eigen::Vector2d(1.1, 1.9)};
  const MatrixXd points = reference::design(40, 2, 8);
  const VectorXd alone = expected_hypervolume_improvement(objectives(2), models, front)(points);
  const std::vector<AnySurrogate> held(models.begin(), models.end());
  EXPECT_EQ(expected_hypervolume_improvement(objectives(2), held, front)(points), alone);
  EXPECT_GT(alone.maxCoeff(), 1e-3);
}

TEST(ExpectedHypervolumeImprovement, RefusesFrontsThatDoNotFit) {
  const auto refusal = [](const FrontView& front, Eigen::Index m) -> std::string {
    try {
      expected_hypervolume_improvement(objectives(m), surrogates(m), front);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  const std::string place = "kriging::expected_hypervolume_improvement: ";
  EXPECT_EQ(
      refusal({MatrixXd::Zero(1, 2), VectorXd::Zero(3)}, 2),
      place + "the reference point has 3 entries; the problem has 2 objectives; give one entry an objective");
  EXPECT_EQ(refusal({MatrixXd::Zero(1, 3), VectorXd::Zero(2)}, 2),
            place + "the front has 3 columns; the problem has 2 objectives; give one column an objective");
  EXPECT_NE(refusal({MatrixXd::Constant(1, 2, std::nan("")), VectorXd::Zero(2)}, 2).find("not finite"),
            std::string::npos);
}
