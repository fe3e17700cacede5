// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/doe/adaptive.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/kriging/acquisition_joint.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <numeric>

using namespace drawpoint;
using namespace drawpoint::kriging;
using doe::Goal;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Few runs, some noise: a model with much to win, of any trend.
Model few_runs(Trend trend = Trend::constant, Correlation correlation = Correlation::gaussian) {
  const MatrixXd X = reference::design(14, 2, 3);
  VectorXd y = reference::values(reference::hilly2, X);
  doe::RandomStream random(5);
  for (double& value : y) value += 0.05 * random.normal();
  FitOptions options;
  options.trend = trend;
  options.correlation = correlation;
  options.theta_lower = options.theta_upper = 2.0;
  options.nugget_lower = options.nugget_upper = 1e-2;
  return fit(X, y, options);
}

/// Points of the box, those with the largest expected improvement first.
MatrixXd best_points(const Model& model, Eigen::Index count) {
  const MatrixXd X = reference::design(400, 2, 21);
  const VectorXd score = log_expected_improvement(model, Goal::minimize)(X);
  std::vector<Eigen::Index> order(400);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return score[a] > score[b]; });
  order.resize(static_cast<std::size_t>(count));
  return detail::rows_of(X, order);
}

/// E[(f* − min(Y₁, Y₂))⁺] by the midpoint rule on (z₁, z₂) in [-8, 8]², 800 x 800.
double by_integration(const Model& model, double best, const MatrixXd& X) {
  const VectorXd mean = model.mean(X);
  const MatrixXd C = model.covariance(X);
  const double a = std::sqrt(C(0, 0)), b = C(1, 0) / a, c = std::sqrt(C(1, 1) - b * b);
  constexpr int steps = 800;
  constexpr double h = 16.0 / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double z = -8 + (i + 0.5) * h, first = mean[0] + a * z;
    double inner = 0;
    for (int j = 0; j < steps; ++j) {
      const double t = -8 + (j + 0.5) * h, second = mean[1] + b * z + c * t;
      inner += std::max(best - std::min(first, second), 0.0) * detail::normal_density(t);
    }
    sum += inner * detail::normal_density(z);
  }
  return sum * h * h;
}

}  // namespace

// The two sides sum n = 14 products of size up to s²/λ in another order: 14 · 1e2 · 1e-16 s², and ten times
// that for the solves.
TEST(CovarianceWith, IsTheCornerOfTheJointCovariance) {
  for (const Trend trend : {Trend::constant, Trend::quadratic})
    for (const Correlation correlation : {Correlation::gaussian, Correlation::matern52})
      for (const bool unknown : {true, false}) {
        FitOptions options;
        options.trend = trend;
        options.correlation = correlation;
        options.parameter_uncertainty = unknown;
        options.nugget_lower = 1e-2;
        const MatrixXd X = reference::design(14, 2, 3), points = reference::design(9, 2, 8);
        const auto model =
            std::make_shared<const Model>(fit(X, reference::values(reference::hilly2, X), options));
        const MatrixXd Z = points.topRows(4), all = model->covariance(points);
        const MatrixXd with = detail::CovarianceWith(model, Z)(points);
        EXPECT_LT((with - all.leftCols(4)).cwiseAbs().maxCoeff(), 2e-12 * model->process_variance());
      }
  const auto constant = std::make_shared<const Model>(fit(MatrixXd::Random(5, 2), VectorXd::Ones(5)));
  EXPECT_EQ(detail::CovarianceWith(constant, MatrixXd::Zero(2, 2))(MatrixXd::Zero(3, 2)),
            MatrixXd(MatrixXd::Zero(3, 2)));
}

// The logarithm of a number with a relative error of a few 1e-15 errs by as much, relative to at least 1.
TEST(JointImprovement, OfOnePointIsTheExpectedImprovement) {
  const Model model = few_runs();
  const MatrixXd points = reference::design(40, 2, 11);
  for (const Goal goal : {Goal::minimize, Goal::maximize}) {
    const VectorXd exact = expected_improvement(model, goal)(points),
                   logarithm = log_expected_improvement(model, goal)(points);
    const VectorXd joint = joint_improvement(model, goal)(MatrixXd(0, 2))(points);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      EXPECT_NEAR(joint_expected_improvement(model, goal, points.row(i)), exact[i],
                  2e-14 * (1 + std::abs(logarithm[i])) * exact[i]);
      EXPECT_NEAR(joint[i], logarithm[i], 2e-14 * (1 + std::abs(logarithm[i])));
    }
  }
}

// The second term is g(z) = E[(min(f*, Y₁) − Y₂)⁺ | z] averaged over one z in each of 2¹⁶ equal strata. With
// slopes of g up to σ₁ + σ₂ the strata within |z| < 4.2 err by 2 · 4.2 (σ₁ + σ₂)/2¹⁶ together, and the two
// outermost, where |z| is below 8.3, by 2 · 8.3 (σ₁ + σ₂)/2¹⁶ at most: 4e-4 (σ₁ + σ₂). The midpoint rule errs
// by h²/8 = 5e-5 times the jump of the slope, σ₁ + σ₂ at most, along two kinks.
TEST(JointImprovement, OfTwoPointsIsTheIntegral) {
  const Model model = few_runs();
  const double best = fitted_values(model).minCoeff();
  const MatrixXd best_first = best_points(model, 40);
  for (const Eigen::Index other : {1, 12, 39}) {
    const MatrixXd X = detail::rows_of(best_first, {0, other});
    const double deviations = reinterpolated(model).predict(X).variance.cwiseSqrt().sum();
    const double exact = by_integration(reinterpolated(model), best, X);
    ASSERT_GT(exact, 0.01 * deviations) << "there is something to win";
    EXPECT_NEAR(joint_expected_improvement(model, Goal::minimize, X, {.draws = 1 << 16}), exact,
                5e-4 * deviations);
  }
}

TEST(JointImprovement, GrowsWithTheBatchByLessThanEachPointAlone) {
  const Model model = few_runs();
  const MatrixXd X = best_points(model, 6);
  const VectorXd alone = expected_improvement(model, Goal::minimize)(X);
  double before = 0;
  for (Eigen::Index q = 1; q <= X.rows(); ++q) {
    const double now = joint_expected_improvement(model, Goal::minimize, X.topRows(q));
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_LE(before, alone.sum());
  EXPECT_GE(before, alone.maxCoeff());
}

// Y of a point chosen before is known given the draw: σ² is round-off of the order n ε s²/λ', with λ' = 4 n ε
// of the interpolation, which the floor of variances takes for 0; what is left is the round-off of a mean.
TEST(JointImprovement, APointChosenTwiceAddsNothing) {
  const Model model = few_runs();
  const MatrixXd x = best_points(model, 1), twice = x.replicate(2, 1);
  const double once = joint_expected_improvement(model, Goal::minimize, x);
  ASSERT_GT(once, 1e-3);
  EXPECT_NEAR(joint_expected_improvement(model, Goal::minimize, twice), once, 1e-6 * once);
}

TEST(JointImprovement, EqualArgumentsGiveEqualBits) {
  const Model model = few_runs();
  const MatrixXd X = reference::design(5, 2, 4), points = reference::design(20, 2, 5);
  EXPECT_EQ(joint_improvement(model, Goal::minimize)(X)(points),
            joint_improvement(model, Goal::minimize)(X)(points));
  EXPECT_NE(joint_improvement(model, Goal::minimize)(X)(points),
            joint_improvement(model, Goal::minimize, {.seed = 2})(X)(points));
}

// Its logarithm keeps the order where the number underflows: a model that is sure of being far from the best.
TEST(JointImprovement, OfDrawsIsTheirMeanAlsoFarOut) {
  const VectorXd gain = (VectorXd(4) << -1.0, 0.5, -3.0, -12.0).finished();
  double mean = 0;
  for (const double g : gain) mean += 0.25 * detail::expected_shortfall(g, 0.0, 0.7);
  // φ and Φ err by z² ε, of which φ + zΦ leaves 1/z²: z⁴ ε = 9e-13.
  EXPECT_NEAR(detail::log_mean_improvement(gain, 0.7), std::log(mean), 1e-14);
  const VectorXd near = VectorXd::Constant(4, -8.0);
  EXPECT_NEAR(detail::log_mean_improvement(near, 1.0), detail::log_normal_improvement(-8.0), 9e-13);
  EXPECT_NEAR(detail::log_mean_improvement(gain, 0.0), std::log(0.125), 1e-15);
  const VectorXd far = VectorXd::Constant(8, -60.0);
  EXPECT_NEAR(detail::log_mean_improvement(far, 1.0), detail::log_normal_improvement(-60.0), 1e-12);
}

namespace {

doe::Evaluations runs_of(int n) {
  const doe::Problem problem{.variables = {{"a", "1", 0, 1}, {"b", "1", 0, 1}},
                             .responses = {{"y", "1", Goal::minimize}}};
  return doe::evaluate(reference::hilly2, problem, reference::design(n, 2, 3));
}

doe::JointCriterion together(const doe::Evaluations& runs) {
  return joint_improvement(fit(runs.X(), runs.y("y")), Goal::minimize);
}

}  // namespace

// Each point climbs to the maximum of its own term, so no random point may have a higher one.
TEST(JointImprovement, ProposesEachPointForWhatItAdds) {
  const doe::Evaluations runs = runs_of(14);
  const MatrixXd batch = doe::propose(runs, together, {.batch = 4, .rule = doe::BatchRule::joint});
  ASSERT_EQ(batch.rows(), 4);
  const MatrixXd points = doe::uniform_random(runs.problem, 500, {.seed = 6});
  for (Eigen::Index j = 0; j < 4; ++j) {
    const doe::Criterion next = together(runs)(batch.topRows(j));
    EXPECT_GE(next(batch.row(j))[0], next(points).maxCoeff()) << j;
  }
  EXPECT_EQ(batch, doe::propose(runs, together, {.batch = 4, .rule = doe::BatchRule::joint}));
}

// One run says nothing of any other place: all are worth the same, and keep apart.
TEST(JointImprovement, AfterOneRunKeepsPointsApart) {
  const MatrixXd batch = doe::propose(runs_of(1), together, {.batch = 4, .rule = doe::BatchRule::joint});
  ASSERT_EQ(batch.rows(), 4);
  for (Eigen::Index j = 0; j < 4; ++j)
    for (Eigen::Index i = 0; i < j; ++i) EXPECT_GT((batch.row(i) - batch.row(j)).norm(), 0.1);
}

TEST(JointImprovement, RefusesWhatItCannotServe) {
  const auto refusal = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  const Model model = few_runs();
  EXPECT_EQ(refusal([&] { joint_improvement(model, Goal::minimize, {.draws = 0}); }),
            "kriging::joint_improvement: draws is 0; allowed is 1 or more; 64 tell points of a batch apart");
  EXPECT_EQ(refusal([&] { joint_expected_improvement(model, Goal::at_most, MatrixXd::Zero(1, 2)); }),
            "kriging::joint_expected_improvement: goal is at_most; allowed are minimize and maximize; use "
            "probability_of_feasibility for limits");
  EXPECT_EQ(refusal([&] { joint_improvement(model, Goal::minimize)(MatrixXd::Zero(2, 3)); }),
            "kriging::joint_improvement: the chosen points have 3 columns; allowed are 2, one per input");
}
