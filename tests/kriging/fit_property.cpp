// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/kriging/detail/sites.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/replicates.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>
#include <thread>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double hills(const VectorXd& x) { return std::sin(6 * x[0]) + 2 * std::pow(x[1] - 0.4, 2); }

struct Runs {
  MatrixXd X;
  VectorXd y;
};

Runs hilly(int n, double noise) {
  Runs runs{reference::design(n, 2, 21), {}};
  runs.y = reference::values(hills, runs.X);
  doe::RandomStream random(4);
  for (double& value : runs.y) value += noise * random.normal();
  return runs;
}

const MatrixXd points = reference::design(50, 2, 33);

void expect_same_model(const Model& a, const Model& b) {
  EXPECT_EQ(a.theta(), b.theta());
  EXPECT_EQ(a.nugget(), b.nugget());
  EXPECT_EQ(a.log_likelihood(), b.log_likelihood());
  EXPECT_EQ(a.mean(points), b.mean(points));
}

void expect_sound(const Model& model, const MatrixXd& X) {
  const Prediction p = model.predict(X);
  EXPECT_TRUE(p.mean.allFinite());
  EXPECT_TRUE(p.variance.allFinite());
  EXPECT_GE(p.variance.minCoeff(), 0.0);
  EXPECT_FALSE(model.message().empty());
}

}  // namespace

// Powers of two change no bit of the scaled inputs and of the standardised response, so the laws hold
// exactly: θ and λ stay, predictions scale with y, s² with its square, LL loses n ln 8.
TEST(Fit, ScalesWithTheUnits) {
  const Runs runs = hilly(40, 0.05);
  const Model model = fit(runs.X, runs.y), scaled = fit(0.25 * runs.X, 8.0 * runs.y);
  EXPECT_EQ(model.theta(), scaled.theta());
  EXPECT_EQ(model.nugget(), scaled.nugget());
  EXPECT_EQ(64.0 * model.process_variance(), scaled.process_variance());
  EXPECT_NEAR(model.log_likelihood() - 40 * std::log(8.0), scaled.log_likelihood(), 1e-12);
  const Prediction a = model.predict(points), b = scaled.predict(0.25 * points);
  EXPECT_EQ(VectorXd(8.0 * a.mean), b.mean);
  EXPECT_EQ(VectorXd(64.0 * a.variance), b.variance);
}

// Shifts and the order of the runs change the rounding only. Both searches end within 1e-3 of the same
// maximum, where the predictions are flat to first order: a hundredth of the noise is far above that and far
// below another maximum.
TEST(Fit, DependsNeitherOnOffsetsNorOnTheOrderOfTheRuns) {
  const Runs runs = hilly(40, 0.05);
  doe::RandomStream random(9);
  const std::vector<int> order = doe::detail::permutation(40, random);
  Runs moved = runs;
  for (int i = 0; i < 40; ++i) {
    moved.X.row(i) = runs.X.row(order[i]).array() + 7.3;
    moved.y[i] = runs.y[order[i]] - 11.1;
  }
  const Model a = fit(runs.X, runs.y), b = fit(moved.X, moved.y);
  EXPECT_NEAR(a.log_likelihood(), b.log_likelihood(), 1e-3);
  const VectorXd difference = a.mean(points).array() - 11.1 - b.mean(points.array() + 7.3).array();
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 5e-4);
}

TEST(Fit, GivesTheSameBitsAgainAndConcurrently) {
  const Runs runs = hilly(30, 0.02);
  const Model alone = fit(runs.X, runs.y);
  std::vector<std::optional<Model>> models(4);
  std::vector<std::thread> threads;
  for (auto& model : models) threads.emplace_back([&] { model = fit(runs.X, runs.y); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& model : models) expect_same_model(alone, *model);
}

// The highest likelihood is no worse than anything on a grid that knows nothing of the searches.
TEST(Fit, IsNoWorseThanAGridSearch) {
  for (const double noise : {0.0, 0.05, 0.5}) {
    const Runs runs = hilly(30, noise);
    FitOptions options;
    options.estimation = Estimation::maximum_likelihood;
    const double found =
        fit(runs.X, runs.y, options).log_likelihood() + 30 * std::log(reference::deviation(runs.y));
    const detail::TrainingData data = detail::prepare(runs.X, runs.y, {});
    Likelihood likelihood(data.X, data.y);
    double best = -1e300;
    for (double a = -6; a <= 6; a += 0.5)
      for (double b = -6; b <= 6; b += 0.5)
        for (double c = -20; c <= 2; c += 2)
          best = std::max(best, likelihood.value(Eigen::Vector3d(a, b, c)));
    EXPECT_GE(found, best - 1e-3) << "noise " << noise;
  }
}

// 600 runs are more than the 500 from which on threads share the work.
TEST(Fit, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Runs runs = hilly(600, 0.05);
  FitOptions options;
  options.starts = 2;
  options.candidates = 8;
  options.max_iterations = 2;
  options.threads = 1;
  const Model alone = fit(runs.X, runs.y, options);
  for (const int threads : {2, 3, 8}) {
    options.threads = threads;
    expect_same_model(alone, fit(runs.X, runs.y, options));
  }
}

// 300 points are three blocks, the last of them not full.
TEST(Fit, ItsModelPredictsTheSameBitsOnAnyNumberOfThreads) {
  const Runs runs = hilly(40, 0.05);
  const Model model = fit(runs.X, runs.y);
  const MatrixXd X = reference::design(300, 2, 5);
  const Prediction alone = model.predict(X, Target::observation);
  for (const int threads : {0, 2, 3, 8}) {
    const Prediction shared = model.predict(X, Target::observation, threads);
    EXPECT_EQ(shared.mean, alone.mean);
    EXPECT_EQ(shared.variance, alone.variance);
  }
  EXPECT_THROW(model.predict(X, Target::latent, -1), std::invalid_argument);
}

TEST(Fit, OneRunIsAConstantOfInfiniteVariance) {
  const Model model = fit(points.topRows(1), VectorXd::Constant(1, 3.5));
  EXPECT_EQ(model.status(), Status::too_few_runs);
  EXPECT_EQ(model.message(),
            "one run says nothing about how the response varies: the model is the constant 3.5 with infinite "
            "variance");
  const Prediction p = model.predict(points);
  EXPECT_EQ(p.mean, VectorXd(VectorXd::Constant(50, 3.5)));
  EXPECT_EQ(p.variance.minCoeff(), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(model.gradient(points.row(0)).mean.isZero(0.0));
}

TEST(Fit, ATrendOfTooManyTermsBecomesAConstant) {
  const Runs runs = hilly(5, 0.0);
  FitOptions options;
  options.trend = Trend::quadratic;  // six terms
  const Model model = fit(runs.X, runs.y, options);
  EXPECT_EQ(model.status(), Status::too_few_runs);
  EXPECT_NE(model.message().find("it is a constant instead"), std::string::npos) << model.message();
  EXPECT_TRUE(model.trend_function().is_constant());
  expect_sound(model, points);
}

TEST(Fit, AConstantResponseIsAConstantModel) {
  const Model model = fit(points, VectorXd::Constant(50, 0.1));
  EXPECT_EQ(model.status(), Status::constant_response);
  EXPECT_EQ(model.message(), "all responses equal 0.1: the model is that constant");
  EXPECT_EQ(model.trend(), 0.1);
  EXPECT_EQ(model.process_variance(), 0.0);
  EXPECT_EQ(model.mean(points), VectorXd(VectorXd::Constant(50, 0.1)));
  EXPECT_TRUE(model.predict(points).variance.isZero(0.0));
  EXPECT_EQ(model.theta().size(), 2);
}

TEST(Fit, TakesDuplicatesThatAgreeAndThatDisagree) {
  const Runs runs = hilly(20, 0.0);
  MatrixXd X(40, 2);
  X << runs.X, runs.X;
  VectorXd y(40);
  y << runs.y, runs.y;
  const Model agree = fit(X, y);
  expect_sound(agree, points);
  EXPECT_LT(agree.nugget(), 1e-6);
  y.tail(20).array() += 0.4;
  const Model disagree = fit(X, y);
  expect_sound(disagree, points);
  // Pairs 0.4 apart show a noise variance of 0.2²: λ s² estimates it from 20 pairs, to about a third.
  EXPECT_NEAR(disagree.nugget() * disagree.process_variance(), 0.04, 0.02);
}

// Repeats that agree tell that the simulator is exact and nothing else: the model, its variances and the
// re-interpolated ones are those of exact runs without the repeats, however many there are. One that differs
// tells that there is noise.
TEST(Fit, RepeatsThatAgreeChangeNothing) {
  const Runs once = hilly(20, 0.0);
  FitOptions exact;
  exact.noise = Noise::none;
  const Model without = fit(once.X, once.y, exact);
  for (const int repeats : {1, 300}) {
    Runs all{MatrixXd(20 + repeats, 2), VectorXd(20 + repeats)};
    all.X << once.X, once.X.row(4).replicate(repeats, 1);
    all.y << once.y, VectorXd::Constant(repeats, once.y[4]);
    for (const Noise noise : {Noise::nugget, Noise::none}) {
      FitOptions options;
      options.noise = noise;
      const Model model = fit(all.X, all.y, options);
      EXPECT_EQ(model.runs(), 20 + repeats);
      EXPECT_EQ(model.theta(), without.theta());
      EXPECT_EQ(model.nugget(), without.nugget());
      EXPECT_EQ(model.process_variance(), without.process_variance());
      const Prediction p = model.predict(points), q = without.predict(points);
      const double deviation = std::sqrt(without.process_variance());
      EXPECT_LE((p.mean - q.mean).cwiseAbs().maxCoeff(), 1e-4 * deviation);
      for (Eigen::Index i = 0; i < points.rows(); ++i)
        EXPECT_NEAR(p.variance[i], q.variance[i], 0.01 * q.variance[i] + 1e-8 * deviation * deviation);
      EXPECT_NE(model.message().find("taken to be exact"), std::string::npos);
    }
    all.y[20] += 0.5;
    EXPECT_GT(fit(all.X, all.y).nugget(), 1e-6);
  }
}

// A count that is the same in two runs by chance is not exact, whether or not a response beside it differs. What is
// only recorded may differ.
TEST(Fit, RepeatsThatAgreeByChanceAreNoiseStill) {
  const int n = 24;
  doe::Evaluations runs{.problem = {.variables = {{"a", "1", 0.0, 1.0}, {"b", "1", 0.0, 1.0}},
                                    .responses = {{"y", "1", doe::Goal::minimize},
                                                  {"lost", "1", doe::Goal::minimize},
                                                  {"time", "s"}}},
                        .rows = {}};
  const Runs points = hilly(n, 0.0);
  doe::RandomStream random(5);
  for (int i = 0; i <= n; ++i) {
    const VectorXd x = points.X.row(i % n);
    const double y = points.y[i % n] + 0.1 * random.normal(), lost = std::floor(3 * random.uniform());
    runs.rows.push_back({i + 1, i / n, 1, x,
                         doe::Outcome(Eigen::Vector3d(y, i % n == 0 ? 1.0 : lost, random.uniform())), 1.0});
  }
  EXPECT_EQ(repeats_say(runs), RepeatsSay::noisy);
  FitOptions options;
  for (const bool may_be_exact : {true, false}) {
    options.may_be_exact = may_be_exact;
    EXPECT_GT(fit(runs.X(), runs.y("lost"), options).nugget(), 1e-2);
  }
  const VectorXd all = runs.y("y");
  const double inside = 0.5 * (all.minCoeff() + all.maxCoeff());
  runs.rows.front().outcome = doe::Outcome(Eigen::Vector3d(inside, 1.0, 3.0));
  runs.rows.back().outcome = doe::Outcome(Eigen::Vector3d(inside, 1.0, 7.0));
  EXPECT_EQ(repeats_say(runs), RepeatsSay::nothing) << "a count tells nothing";
  runs.problem.responses[1].goal = doe::Goal::record;
  EXPECT_EQ(repeats_say(runs), RepeatsSay::exact);
  runs.rows.back().outcome = doe::Failure{"stuck"};
  EXPECT_EQ(repeats_say(runs), RepeatsSay::nothing);
}

// y = a (1 + 0.4 N): at a = 0 nothing happens, and both runs give 0. That is no sign of a simulator without noise: of
// twelve sets none is taken for one. Inside the range the same repeats are a sign.
TEST(Fit, RepeatsThatAgreeWhereNothingHappensTellNothing) {
  for (doe::Seed seed = 1; seed <= 12; ++seed) {
    doe::RandomStream random(seed);
    MatrixXd X(25, 2);
    X << reference::design(24, 2, seed), Eigen::RowVector2d::Zero();
    X.row(0).setZero();
    VectorXd y(25);
    for (Eigen::Index i = 0; i < 25; ++i) y[i] = X(i, 0) * (1 + 0.4 * random.normal());
    y[0] = y[24] = 0;
    const auto sites = detail::sites_of(X);
    ASSERT_TRUE(detail::repeats_agree(sites, y));
    EXPECT_FALSE(detail::agreement_tells(sites, y)) << seed;
    EXPECT_GT(fit(X, y).nugget(), 1e-2) << seed;
    y[0] = y[24] = 0.5 * (y.minCoeff() + y.maxCoeff());
    EXPECT_TRUE(detail::agreement_tells(sites, y));
    EXPECT_LE(fit(X, y).nugget(), 1.001e-6) << seed << ", the upper bound of exact runs";
  }
}

TEST(Fit, AnInputWithoutEffectGetsASmallTheta) {
  const MatrixXd X = reference::design(40, 3, 5);
  const Model model = fit(X, (3.0 * X.col(0).array()).sin() + X.col(1).array());
  expect_sound(model, X);
  // Correlation exp(−4θ) across its whole range: the response changes by less than a per mille.
  EXPECT_LT(model.theta()[2], 2.5e-4);
}

TEST(Fit, AnInputThatNeverVariesIsIgnored) {
  Runs runs = hilly(25, 0.0);
  MatrixXd X(25, 3);
  X << runs.X, VectorXd::Constant(25, 9.0);
  const Model model = fit(X, runs.y);
  EXPECT_NE(model.message().find("input 2 never varies, so predictions ignore it"), std::string::npos)
      << model.message();
  MatrixXd elsewhere = X;
  elsewhere.col(2).setConstant(-1e9);
  EXPECT_EQ(model.mean(X), model.mean(elsewhere));
  // The other inputs are fitted as if it were not there.
  EXPECT_NEAR(model.log_likelihood(), fit(runs.X, runs.y).log_likelihood(), 0.01);
}

TEST(Fit, TakesFewerRunsThanInputs) {
  for (const int n : {2, 3, 5}) {
    const MatrixXd X = reference::design(n, 8, 5);
    const Model model = fit(X, X.rowwise().sum());
    expect_sound(model, reference::design(20, 8, 6));
    EXPECT_TRUE(std::isfinite(model.log_likelihood()));
  }
}

// Runs on a line at distances of 1e-9: singular to round-off without a nugget.
TEST(Fit, RaisesTheNuggetOfASingularMatrixAndSaysSo) {
  FitOptions options;
  options.nugget_lower = options.nugget_upper = 1e-30;
  options.theta_lower = options.theta_upper = 1e-3;
  const VectorXd x = VectorXd::LinSpaced(50, 0, 1);
  const Model model = fit(x, x.array().sin(), options);
  EXPECT_EQ(model.status(), Status::ill_conditioned);
  EXPECT_NE(model.message().find("the nugget was raised to"), std::string::npos) << model.message();
  EXPECT_GT(model.nugget(), 1e-30);
  expect_sound(model, x);
  EXPECT_LT((model.mean(x) - VectorXd(x.array().sin())).cwiseAbs().maxCoeff(), 1e-2);
}

// Equal bounds fix each input's θ to its own number; an input whose best θ lies outside of its bounds stays in them.
TEST(Fit, KeepsThetaWithinTheBoundsOfEachInput) {
  const Runs runs = hilly(60, 0.05);
  const Model whole = fit(runs.X, runs.y);
  FitOptions options;
  options.theta_lower = options.theta_upper = whole.theta();
  EXPECT_LT((fit(runs.X, runs.y, options).theta() - whole.theta()).cwiseAbs().maxCoeff(),
            1e-12 * whole.theta().maxCoeff());  // exp(ln θ)
  VectorXd lower = 0.5 * whole.theta(), upper = 2.0 * whole.theta();
  lower[0] = 3.0 * whole.theta()[0];
  upper[0] = 4.0 * whole.theta()[0];
  options.theta_lower = lower;
  options.theta_upper = upper;
  const VectorXd theta = fit(runs.X, runs.y, options).theta();
  for (Eigen::Index k = 0; k < theta.size(); ++k) {
    EXPECT_GE(theta[k], lower[k] * (1 - 1e-12)) << k;
    EXPECT_LE(theta[k], upper[k] * (1 + 1e-12)) << k;
  }
}

TEST(Fit, SaysThatRunsAreFewForTheirInputs) {
  const auto message = [](int n) {
    const MatrixXd X = reference::design(n, 5, 5);
    return fit(X, X.rowwise().sum()).message();
  };
  const std::string said = "10 runs in 5 variables are too few to trust";
  EXPECT_NE(message(10).find(said), std::string::npos) << message(10);
  EXPECT_EQ(message(11).find("too few"), std::string::npos) << message(11);
}

TEST(Fit, SaysWhenASearchWasCutShort) {
  FitOptions options;
  options.max_iterations = options.starts = 1;
  const Runs runs = hilly(300, 0.05);
  const Model model = fit(runs.X, runs.y, options);
  EXPECT_EQ(model.status(), Status::not_converged) << model.message();
  expect_sound(model, points);
}

TEST(Fit, SurvivesExtremeUnits) {
  const Runs runs = hilly(20, 0.0);
  for (const double unit : {1e-140, 1e-70, 1e70}) {
    const Model model = fit(unit * runs.X, unit * runs.y);
    EXPECT_LT((model.mean(unit * runs.X) / unit - runs.y).cwiseAbs().maxCoeff(), 1e-3) << unit;
  }
}

// Ipopt reads ipopt.opt in the working directory and prints by default; a library does neither.
TEST(Fit, PrintsNothingAndReadsNoOptionFile) {
  const std::filesystem::path before = std::filesystem::current_path();
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("drawpoint_kriging_silence_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::filesystem::current_path(folder);
  std::ofstream("ipopt.opt") << "print_level 5\nmax_iter 0\n";
  const Runs runs = hilly(15, 0.02);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const Model model = fit(runs.X, runs.y);
  const std::string out = testing::internal::GetCapturedStdout(),
                    err = testing::internal::GetCapturedStderr();
  std::filesystem::current_path(before);
  std::filesystem::remove_all(folder);
  EXPECT_EQ(out, "");
  EXPECT_EQ(err, "");
  EXPECT_EQ(model.status(), Status::converged) << model.message();
}
