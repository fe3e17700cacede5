// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// What holds of every fit by nearest runs: threads, order, units, repeats, refusals.

#include <gtest/gtest.h>

#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
#include <drawpoint/kriging/detail/nearest/search.hpp>
#include <drawpoint/kriging/fit_nearest.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <functional>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct ManyRuns {
  MatrixXd X;
  VectorXd y;
};

ManyRuns many_waves(int n, double noise) {
  ManyRuns runs{reference::design(n, 5, 21), {}};
  runs.y = reference::values(reference::waves5, runs.X);
  doe::RandomStream random(4);
  for (double& value : runs.y) value += noise * random.normal();
  return runs;
}

const MatrixXd wave_points = reference::design(200, 5, 33);

/// Small, so that 600 runs are many.
constexpr NearestOptions few_neighbours{.neighbours = 48, .neighbourhood = 96};

void expect_same_predictions(const NearestModel& a, const NearestModel& b) {
  EXPECT_EQ(a.theta(), b.theta());
  EXPECT_EQ(a.nugget(), b.nugget());
  EXPECT_EQ(a.log_likelihood(), b.log_likelihood());
  EXPECT_EQ(a.message(), b.message());
  const Prediction p = a.predict(wave_points), q = b.predict(wave_points);
  EXPECT_EQ(p.mean, q.mean);
  EXPECT_EQ(p.variance, q.variance);
}

std::string nearest_refusal(const std::function<void(ManyRuns&, FitOptions&, NearestOptions&)>& spoil) {
  ManyRuns runs = many_waves(60, 0.1);
  FitOptions options;
  NearestOptions nearest = few_neighbours;
  spoil(runs, options, nearest);
  try {
    fit_nearest(runs.X, runs.y, options, nearest);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace

TEST(Nearest, BitsDoNotDependOnThreads) {
  const ManyRuns runs = many_waves(600, 0.05);
  FitOptions options;
  const NearestModel one = fit_nearest(runs.X, runs.y, options, few_neighbours);
  for (const int threads : {2, 3}) {
    options.threads = threads;
    expect_same_predictions(one, fit_nearest(runs.X, runs.y, options, few_neighbours));
  }
}

// Runs are sorted first, so the tolerance is none.
TEST(Nearest, BitsDoNotDependOnTheOrderOfTheRows) {
  const ManyRuns runs = many_waves(600, 0.05);
  doe::RandomStream random(8);
  const std::vector<Eigen::Index> order = doe::detail::permutation<Eigen::Index>(600, random);
  FitOptions options, shuffled;
  options.noise = shuffled.noise = Noise::proportional;
  options.noise_variance = VectorXd::LinSpaced(600, 0.5, 1.5);
  shuffled.noise_variance = detail::entries_of(options.noise_variance, order);
  expect_same_predictions(fit_nearest(runs.X, runs.y, options, few_neighbours),
                          fit_nearest(detail::rows_of(runs.X, order), detail::entries_of(runs.y, order),
                                      shuffled, few_neighbours));
}

// Powers of two change no bit of what is scaled; others change the last ones of the scaled inputs, and the
// search ends elsewhere within its stopping rule: a hundredth of a unit of log likelihood, a small share of a
// standard deviation.
TEST(Nearest, ScalesWithTheUnits) {
  const ManyRuns runs = many_waves(600, 0.05);
  const NearestModel model = fit_nearest(runs.X, runs.y, {}, few_neighbours);
  const Prediction p = model.predict(wave_points);
  const NearestModel twos = fit_nearest(0.25 * runs.X, 8.0 * runs.y, {}, few_neighbours);
  EXPECT_EQ(model.theta(), twos.theta());
  EXPECT_EQ(VectorXd(8.0 * p.mean), twos.mean(0.25 * wave_points));
  EXPECT_EQ(8.0 * model.error().mean, twos.error().mean);
  for (const double unit : {1e8, 1e-8}) {
    const NearestModel scaled = fit_nearest(unit * runs.X, runs.y / unit, {}, few_neighbours);
    const Prediction q = scaled.predict(unit * wave_points);
    EXPECT_LT((unit * q.mean - p.mean).cwiseAbs().maxCoeff(), 0.01 * std::sqrt(p.variance.maxCoeff()));
    EXPECT_LT(((unit * unit * q.variance - p.variance).array() / p.variance.array()).abs().maxCoeff(), 0.02);
  }
}

// The mean misses run i by λαᵢ: at λ <= 1e-6, and next to 1e-10 where smooth runs allow it, nothing that a
// plot or a search sees.
TEST(Nearest, ExactRunsAreMet) {
  const ManyRuns runs = many_waves(600, 0.0);
  const NearestModel model = fit_nearest(runs.X, runs.y, {.noise = Noise::none}, few_neighbours);
  const Prediction p = model.predict(runs.X), elsewhere = model.predict(wave_points);
  const double range = runs.y.maxCoeff() - runs.y.minCoeff();
  EXPECT_LT((p.mean - runs.y).cwiseAbs().maxCoeff(), 1e-6 * range);
  EXPECT_LT(std::sqrt(p.variance.maxCoeff()), 0.05 * std::sqrt(elsewhere.variance.mean()));
}

// Noise that is known and next to none leaves the model what it is without.
TEST(Nearest, KnownNoiseMayBeSmall) {
  const ManyRuns runs = many_waves(600, 0.0);
  const VectorXd truth = reference::values(reference::waves5, wave_points);
  const double none =
      (fit_nearest(runs.X, runs.y, {.noise = Noise::none}, few_neighbours).mean(wave_points) - truth).norm();
  for (const double deviation : {1e-5, 1e-8}) {
    FitOptions options;
    options.noise = Noise::known;
    options.noise_variance = VectorXd::Constant(600, deviation * deviation);
    options.noise_variance[0] = 0.0;
    const NearestModel model = fit_nearest(runs.X, runs.y, options, few_neighbours);
    EXPECT_LT((model.mean(wave_points) - truth).norm(), 1.5 * none) << deviation;
  }
}

TEST(Nearest, RepeatsThatAgreeCountOnce) {
  const ManyRuns runs = many_waves(300, 0.0);
  MatrixXd X(330, 5);
  VectorXd y(330);
  X << runs.X, runs.X.topRows(30);
  y << runs.y, runs.y.head(30);
  const NearestModel once = fit_nearest(runs.X, runs.y, {.noise = Noise::none}, few_neighbours);
  expect_same_predictions(once, fit_nearest(X, y, {}, few_neighbours));
}

TEST(Nearest, NoisyRepeatsAreAveraged) {
  const ManyRuns once = many_waves(150, 0.0);
  MatrixXd X(600, 5);
  X << once.X, once.X, once.X, once.X;
  VectorXd y(600);
  y << once.y, once.y, once.y, once.y;
  doe::RandomStream random(6);
  for (double& value : y) value += 0.2 * random.normal();
  const NearestModel model = fit_nearest(X, y, {}, few_neighbours);
  EXPECT_NEAR(std::sqrt(model.noise_variance()), 0.2, 0.03);
  EXPECT_TRUE(model.predict(X).variance.allFinite());
  EXPECT_LT((model.mean(once.X) - once.y).norm() / std::sqrt(150.0), 0.12);
}

TEST(Nearest, FitAnyIsFitUpToTheStatedRuns) {
  const ManyRuns runs = many_waves(80, 0.05);
  const AnySurrogate few = fit_any(runs.X, runs.y), many = fit_any(runs.X, runs.y, {}, {.exact_up_to = 79});
  ASSERT_NE(few.as<Model>(), nullptr);
  const Model exact = fit(runs.X, runs.y);
  EXPECT_EQ(few.predict(wave_points).mean, exact.predict(wave_points).mean);
  EXPECT_EQ(few.predict(wave_points).variance, exact.predict(wave_points).variance);
  ASSERT_NE(many.as<NearestModel>(), nullptr);
  EXPECT_EQ(many.status(), Status::converged);
  EXPECT_EQ(many.variables(), 5);
  const Validation v = k_fold(runs.X, runs.y, 4, [](const MatrixXd& P, const VectorXd& z) {
    return fit_any(P, z, {}, {.exact_up_to = 0});
  });
  EXPECT_LT(v.nrmse, 0.1);
}

TEST(Nearest, ConstantAndTrendAloneAreToldApart) {
  const MatrixXd X = reference::design(200, 2, 4);
  const NearestModel constant = fit_nearest(X, VectorXd::Constant(200, 3.0));
  EXPECT_EQ(constant.status(), Status::constant_response);
  EXPECT_EQ(constant.mean(X.topRows(2)), VectorXd::Constant(2, 3.0));
  EXPECT_EQ(constant.mean_gradient(X.row(0)), VectorXd::Zero(2));
  const VectorXd plane = X * Eigen::Vector2d(2.0, -1.0);
  const NearestModel trend = fit_nearest(X, plane, {.trend = Trend::linear}, few_neighbours);
  EXPECT_EQ(trend.status(), Status::exact_trend);
  EXPECT_LT((trend.mean(X) - plane).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Nearest, RefusesWhatItCannotFit) {
  EXPECT_EQ(nearest_refusal([](auto&, auto&, auto& n) { n.neighbours = 7; }),
            "kriging::fit_nearest: neighbours is 7; allowed are 8 to 4000; use the default");
  EXPECT_EQ(nearest_refusal([](auto&, auto&, auto& n) { n.neighbourhood = 4001; }),
            "kriging::fit_nearest: neighbourhood is 4001; allowed are 8 to 4000; use the default");
  EXPECT_EQ(
      nearest_refusal([](auto&, auto& o, auto&) { o.structure = Structure::additive; }),
      "kriging::fit_nearest: structure is additive; allowed are product and isotropic, since in a sum far "
      "runs tell as much as near ones; choose one of them");
  EXPECT_EQ(nearest_refusal([](auto&, auto& o, auto&) { o.trend = Trend::blind; }),
            "kriging::fit_nearest: trend is blind; allowed are constant, linear, quadratic and user; use "
            "quadratic");
  EXPECT_EQ(nearest_refusal([](auto& r, auto&, auto&) { r.X(7, 2) = std::nan(""); }),
            "kriging::fit: X(7, 2) is nan; allowed are finite numbers; leave failed runs out");
  EXPECT_EQ(nearest_refusal([](auto& r, auto&, auto&) {
              for (int i = 10; i < 40; ++i) r.X.row(i) = r.X.row(3);
            }),
            "kriging::fit_nearest: 31 runs stand at the point of run 3; allowed are half of neighbours, 24; "
            "average "
            "them with kriging::replicates, or raise neighbours");
}

// A term that one run alone has is singular in problems of the others, whatever λ: they leave it out.
TEST(Nearest, ProblemsOfSomeRunsKeepTheTermsThatTheseTell) {
  constexpr Eigen::Index n = 300;
  LikelihoodProblem all;
  all.X = Eigen::VectorXd::LinSpaced(n, -1, 1);
  all.y = all.X.col(0);
  all.F = Eigen::MatrixXd::Ones(n, 2);
  all.F.col(1).head(n - 1).setZero();
  EXPECT_EQ(detail::first_of(all, n).F, all.F);
  EXPECT_EQ(detail::first_of(all, n - 1).F, Eigen::MatrixXd::Ones(n - 1, 1));
  EXPECT_EQ(detail::thinned(all).F, Eigen::MatrixXd::Ones(250, 1))
      << "every sixth run is left out, the last too";
}
