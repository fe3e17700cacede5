// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/append.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/run_gain.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

#include <algorithm>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double wave(const VectorXd& x) { return std::sin(5 * x[0]) + x[1] * x[1]; }

const MatrixXd runs = reference::design(20, 2, 3);
const MatrixXd places = reference::design(40, 2, 12);

// Parameters held, so that one more run changes nothing but what is known.
Model model_with(double nugget, Trend trend = Trend::constant) {
  FitOptions options;
  options.lower = VectorXd::Zero(2);
  options.upper = VectorXd::Ones(2);
  options.theta_lower = options.theta_upper = 1.3;
  options.nugget_lower = options.nugget_upper = nugget;
  options.correlation = Correlation::matern52;
  options.trend = trend;
  return fit(runs, reference::values(wave, runs), options);
}

// As a share of s², which a run changes: that its own outcome has a say in s² is no matter of the gain.
double mean_share(const Model& model) {
  return model.predict(places).variance.mean() / model.process_variance();
}

Model with_run(const Model& model, const VectorXd& x) {
  return append(model, x.transpose(), VectorXd::Constant(1, 0.3));
}

RunGain gain_of(const Model& model, const MatrixXd& points) {
  return RunGain(model, points, places, VectorXd::Constant(points.rows(), model.noise_variance()));
}

MatrixXd runs_and_places() {
  MatrixXd points(runs.rows() + places.rows(), 2);
  points << runs, places;
  return points;
}

// A steep response of little noise but in the first third of the box, where runs scatter by 0.6.
struct NoisyCorner {
  Model model = [] {
    FitOptions options;
    options.lower = VectorXd::Zero(2);
    options.upper = VectorXd::Ones(2);
    options.theta_lower = options.theta_upper = 1.3;
    options.noise = Noise::known;
    options.noise_variance = noise_at(runs);
    return fit(runs, reference::values(wave, runs), options);
  }();
  static VectorXd noise_at(const MatrixXd& X) {
    return (X.col(0).array() < 1.0 / 3).select(VectorXd::Constant(X.rows(), 0.36), 1e-6);
  }
};

}  // namespace

// Against a model that has the run, factored from its own matrix. A nugget of 0.01 keeps the condition below
// 20/0.01, so 40 variances, each a difference of numbers up to 1, are good to 2000 eps: 5e-13; gains of two
// runs in a row have two such differences.
TEST(RunGain, IsWhatARunTakesOffTheVariance) {
  for (const Trend trend : {Trend::constant, Trend::linear}) {
    const Model model = model_with(1e-2, trend);
    RunGain gain = gain_of(model, runs_and_places());
    EXPECT_NEAR(gain.mean_variance() / model.process_variance(), mean_share(model), 1e-12);
    for (const Index point : {Index{4}, Index{33}}) {  // a run, and a place where there is none
      const Model more = with_run(model, runs_and_places().row(point));
      EXPECT_NEAR(gain.gains()[point] / model.process_variance(), mean_share(model) - mean_share(more),
                  1e-12);
    }
    gain.run(4);
    gain.run(33);
    const Model two = with_run(with_run(model, runs.row(4)), runs_and_places().row(33));
    EXPECT_NEAR(gain.mean_variance() / model.process_variance(), mean_share(two), 1e-12);
  }
}

// A run takes off what was gained by it, to rounding of sums of 40 variances, and after it the same point has
// less to give.
TEST(RunGain, IsUsedUp) {
  RunGain gain = gain_of(model_with(0.3), runs);
  for (int k = 0; k < 5; ++k) {
    const double before = gain.mean_variance();
    Index best = 0;
    const double gained = gain.gains().maxCoeff(&best);
    gain.run(best);
    EXPECT_NEAR(gain.mean_variance(), before - gained, 1e-14 * before);
    EXPECT_LT(gain.gains()[best], gained);
  }
}

// Eight repeats, all where the noise is; with the same noise everywhere not all are there.
TEST(RunsToRepeat, AreWhereNoiseIs) {
  const NoisyCorner corner;
  const RunGain gain(corner.model, runs, places, NoisyCorner::noise_at(runs));
  const auto chosen = runs_to_repeat({{gain, 1.0}}, {.made = runs.rows(), .count = 8});
  ASSERT_EQ(chosen.size(), 8u);
  for (const Index i : chosen) EXPECT_LT(runs(i, 0), 1.0 / 3) << i;
  const auto alike =
      runs_to_repeat({{gain_of(model_with(0.3), runs), 1.0}}, {.made = runs.rows(), .count = 8});
  EXPECT_TRUE(std::any_of(alike.begin(), alike.end(), [](Index i) { return runs(i, 0) > 1.0 / 3; }));
  EXPECT_EQ(chosen, runs_to_repeat({{gain, 1.0}}, {.made = runs.rows(), .count = 8}));
}

// Of a nearly exact simulator a run again teaches nothing, and a new point much.
TEST(RunsToRepeat, AreNoneWhereNewPointsTeachMore) {
  const Model exact = model_with(1e-8);
  const RepeatOptions options{.made = runs.rows(), .count = 4};
  EXPECT_TRUE(runs_to_repeat({{gain_of(exact, runs_and_places()), 1.0}}, options).empty());
  const Model noisy = model_with(10.0);
  EXPECT_EQ(runs_to_repeat({{gain_of(noisy, runs_and_places()), 1.0}}, options).size(), 4u);
}

// Variances are squares of errors. Two responses want different points; with units whose squares make the
// first's advantage at its point 1.2 times, or 1/1.2, the second's at its own, the sum follows the first, or the
// second. Taken as they are, not squared, or not at all, units would give the same point both times.
TEST(RunsToRepeat, SumResponsesInTheirUnits) {
  const NoisyCorner corner;
  const RunGain left(corner.model, runs, places, NoisyCorner::noise_at(runs));
  const RunGain all = gain_of(model_with(0.3), runs);
  const RepeatOptions one{.made = runs.rows()};
  const Index a = runs_to_repeat({{left, 1.0}}, one).front(), b = runs_to_repeat({{all, 1.0}}, one).front();
  ASSERT_NE(a, b);
  const double ahead = left.gains()[a] - left.gains()[b], behind = all.gains()[b] - all.gains()[a];
  const auto between = [&](double factor) {
    const double unit = std::sqrt(factor * behind / ahead);  // of `all`, whose squares are divided by it
    const VectorXd sum = left.gains() + all.gains() / (unit * unit);
    EXPECT_EQ(runs_to_repeat({{left, 1.0}, {all, unit}}, one).front(),
              std::max_element(sum.begin(), sum.end()) - sum.begin());
    return sum[a] > sum[b];
  };
  EXPECT_TRUE(between(1.2));
  EXPECT_FALSE(between(1 / 1.2));
}

TEST(RunGain, RefusesWhatItCannotUse) {
  const Model model = model_with(1e-2);
  const VectorXd noise = VectorXd::Ones(runs.rows());
  EXPECT_THROW(RunGain(model, MatrixXd(0, 2), places, VectorXd()), std::invalid_argument);
  EXPECT_THROW(RunGain(model, runs, MatrixXd(0, 2), noise), std::invalid_argument);
  EXPECT_THROW(RunGain(model, runs, MatrixXd::Zero(3, 1), noise), std::invalid_argument);
  EXPECT_THROW(RunGain(model, runs, places, VectorXd::Ones(3)), std::invalid_argument);
  EXPECT_THROW(RunGain(model, runs, places, -noise), std::invalid_argument);
  EXPECT_THROW(RunGain(model, runs, places, noise * NAN), std::invalid_argument);
  RunGain gain(model, runs, places, noise);
  EXPECT_THROW(gain.run(-1), std::invalid_argument);
  EXPECT_THROW(gain.run(runs.rows()), std::invalid_argument);
  const ResponseGain response{gain, 1.0};
  EXPECT_THROW(runs_to_repeat({}, {.made = 1}), std::invalid_argument);
  EXPECT_THROW(runs_to_repeat({response}, {}), std::invalid_argument);
  EXPECT_THROW(runs_to_repeat({response}, {.made = runs.rows() + 1}), std::invalid_argument);
  EXPECT_THROW(runs_to_repeat({response}, {.made = 1, .count = -1}), std::invalid_argument);
  EXPECT_THROW(runs_to_repeat({response}, {.made = 1, .least_share = 1.5}), std::invalid_argument);
  EXPECT_THROW(runs_to_repeat({{gain, 0.0}}, {.made = 1}), std::invalid_argument);
  EXPECT_THROW(
      runs_to_repeat({response, {RunGain(model, runs.topRows(3), places, noise.head(3)), 1.0}}, {.made = 1}),
      std::invalid_argument);
}
