// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// How sure a front is, against what normal distributions say of one point and of two.
///
/// 1024 draws: a probability p is known within √(p(1-p)/1024), 0.016 at most. Four such errors are allowed
/// for: of correct code one check in 16 000 would fail, and the seeds are fixed.

#include <gtest/gtest.h>

#include <drawpoint/studies/model/fronts/front_uncertainty.h>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/fit.hpp>

#include <cmath>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

constexpr double four_errors = 4 * 0.0157;

double normal(double t) { return 0.5 * std::erfc(-t / std::sqrt(2.0)); }

doe::Problem problem_of(const std::vector<doe::Goal>& goals, double limit = std::nan("")) {
  doe::Problem problem{{{"x", "1", 0.0, 1.0}}, {}};
  for (std::size_t j = 0; j < goals.size(); ++j) {
    const bool limited = doe::is_constraint(goals[j]);
    problem.responses.push_back({.name = std::string(1, 'y') + std::to_string(j),
                                 .unit = "1",
                                 .goal = goals[j],
                                 .limit = limited ? limit : std::nan("")});
  }
  return problem;
}

/// 1.5 + sin(3x), and noise that leaves the models unsure of it.
kriging::TransformedModel unsure_model(doe::Seed seed, kriging::Scale scale = kriging::Scale::linear) {
  const Eigen::VectorXd X = Eigen::VectorXd::LinSpaced(16, 0.0, 1.0);
  doe::RandomStream random(seed);
  Eigen::VectorXd y(16);
  for (Eigen::Index i = 0; i < 16; ++i) y[i] = 1.5 + std::sin(3 * X[i]) + 0.15 * random.normal();
  return kriging::fit_transformed(X, y, scale, {.lower = 0.0});
}

pareto::Front front_at(const std::vector<kriging::TransformedModel>& models, const Eigen::MatrixXd& X) {
  pareto::Front front;
  front.X = X;
  front.Y.resize(X.rows(), static_cast<Eigen::Index>(models.size()));
  for (std::size_t j = 0; j < models.size(); ++j)
    front.Y.col(static_cast<Eigen::Index>(j)) = models[j].mean(X);
  front.responses = front.Y;
  return front;
}

/// P(the response is higher at row a than at row b), of a joint normal.
double higher(const kriging::Model& model, const Eigen::MatrixXd& X, Eigen::Index a, Eigen::Index b) {
  const Eigen::VectorXd mean = model.mean(X);
  const Eigen::MatrixXd C = model.covariance(X);
  return normal((mean[a] - mean[b]) / std::sqrt(C(a, a) + C(b, b) - 2 * C(a, b)));
}

}  // namespace

// Of two points a is dominated where b is higher in the first response and lower in the second, whose errors
// are unrelated. The two places lie so near that each response errs alike at both.
TEST(FrontUncertainty, IsThatOfTwoJointNormals) {
  const doe::Problem problem = problem_of({doe::Goal::maximize, doe::Goal::minimize});
  const std::vector models{unsure_model(1), unsure_model(2)};
  const Eigen::Vector2d X(0.4, 0.65);
  const double a_better = higher(models[0].model(), X, 0, 1) * higher(models[1].model(), X, 1, 0);
  const double b_better = higher(models[0].model(), X, 1, 0) * higher(models[1].model(), X, 0, 1);
  ASSERT_GT(std::max(a_better, b_better), 0.05) << "or the check says little";
  const auto found = uncertainty_of(front_at(models, X), models, problem, 7);
  ASSERT_EQ(found.non_dominated.size(), 2);
  EXPECT_NEAR(found.non_dominated[0], 1 - b_better, four_errors);
  EXPECT_NEAR(found.non_dominated[1], 1 - a_better, four_errors);
}

// A response and itself: what is better in one is better in both, so of two points one is on the front. Were
// the draws unrelated, both would be in most of them.
TEST(FrontUncertainty, ResponsesErrTogetherAsTheirLeftOutRunsDo) {
  const doe::Problem problem = problem_of({doe::Goal::maximize, doe::Goal::maximize});
  const std::vector models{unsure_model(1), unsure_model(1)};
  const Eigen::Vector2d X(0.45, 0.6);
  const double a_better = higher(models[0].model(), X, 0, 1);
  ASSERT_GT(std::min(a_better, 1 - a_better), 0.05) << "or the check says little";
  const auto found = uncertainty_of(front_at(models, X), models, problem, 7);
  EXPECT_NEAR(found.non_dominated[0], a_better, four_errors);
  EXPECT_NEAR(found.non_dominated.sum(), 1.0, four_errors);
}

// A point alone is on the front where it keeps the limit, here half a standard deviation above its mean; on a
// scale of its own the response keeps it as often.
TEST(FrontUncertainty, CountsTheLimits) {
  const Eigen::MatrixXd X = Eigen::MatrixXd::Constant(1, 1, 0.3);
  for (const auto scale : {kriging::Scale::linear, kriging::Scale::logarithm}) {
    const std::vector models{unsure_model(1), unsure_model(2, scale)};
    const auto z = models[1].model().predict(X);
    const double limit = kriging::mean_response(
        models[1].transform(), z.mean[0] + 0.5 * std::sqrt(z.variance[0]), models[1].noise_variance());
    const doe::Problem problem = problem_of({doe::Goal::maximize, doe::Goal::at_most}, limit);
    pareto::Front front = front_at(models, X);
    front.Y.conservativeResize(1, 1);
    const auto found = uncertainty_of(front, models, problem, 3);
    EXPECT_NEAR(found.non_dominated[0], normal(0.5), four_errors) << to_string(scale);
    EXPECT_TRUE(found.bands.empty()) << "one objective makes no trade-off";
  }
}

// One point, and the first response as good as its mean in half of the draws. So 5 of 100 draws reach the
// 0.1-quantile of the second, and 95 never reach anything. A quantile from 1024 draws is known within
// √(0.05 · 0.95/1024)/(φ(t)/2) = 0.078 standard deviations.
TEST(FrontUncertainty, BandIsTheAttainmentOfOnePoint) {
  const doe::Problem problem = problem_of({doe::Goal::maximize, doe::Goal::minimize});
  const std::vector models{unsure_model(1), unsure_model(2)};
  const Eigen::MatrixXd X = Eigen::MatrixXd::Constant(1, 1, 0.3);
  const auto found = uncertainty_of(front_at(models, X), models, problem, 5);
  ASSERT_EQ(found.bands.size(), 1u);
  const PairBand& band = found.bands[0];
  EXPECT_EQ(band.first, 0u);
  EXPECT_EQ(band.second, 1u);
  EXPECT_EQ(band.at[0], models[0].mean(X)[0]);
  const auto y = models[1].predict(X);
  const double deviation = std::sqrt(y.variance[0]);
  EXPECT_NEAR(band.optimistic[0], y.mean[0] - 1.2816 * deviation, 4 * 0.078 * deviation);
  EXPECT_TRUE(std::isinf(band.pessimistic[0]));
}

TEST(FrontUncertainty, HasABandForEachPairOfObjectives) {
  const doe::Problem problem = problem_of({doe::Goal::maximize, doe::Goal::minimize, doe::Goal::minimize});
  const std::vector models{unsure_model(1), unsure_model(2), unsure_model(3)};
  const auto found =
      uncertainty_of(front_at(models, Eigen::VectorXd::LinSpaced(9, 0.1, 0.9)), models, problem, 5);
  ASSERT_EQ(found.bands.size(), 3u);
  for (const PairBand& band : found.bands) {
    EXPECT_TRUE((band.optimistic.array() <= band.median.array()).all()) << "the second is minimised";
    EXPECT_TRUE((band.median.array() <= band.pessimistic.array()).all());
  }
  EXPECT_EQ(found.bands[2].first, 1u);
  EXPECT_EQ(found.bands[2].second, 2u);
}

TEST(FrontUncertainty, EqualSeedsGiveEqualBits) {
  const doe::Problem problem = problem_of({doe::Goal::maximize, doe::Goal::minimize});
  const std::vector models{unsure_model(1), unsure_model(2)};
  const auto front = front_at(models, Eigen::VectorXd::LinSpaced(9, 0.1, 0.9));
  const auto once = uncertainty_of(front, models, problem, 5);
  EXPECT_EQ(once.non_dominated, uncertainty_of(front, models, problem, 5).non_dominated);
  EXPECT_NE(once.non_dominated, uncertainty_of(front, models, problem, 6).non_dominated);
}

TEST(FrontUncertainty, SaysNothingWithoutAFrontOrAVariance) {
  const doe::Problem problem = problem_of({doe::Goal::maximize});
  EXPECT_EQ(uncertainty_of({}, {unsure_model(1)}, problem, 1).non_dominated.size(), 0);
  const Eigen::MatrixXd X = Eigen::MatrixXd::Constant(1, 1, 0.5);
  const std::vector<kriging::TransformedModel> of_one_run{kriging::fit(X, Eigen::VectorXd::Ones(1))};
  EXPECT_EQ(uncertainty_of(front_at(of_one_run, X), of_one_run, problem, 1).non_dominated.size(), 0);
}
