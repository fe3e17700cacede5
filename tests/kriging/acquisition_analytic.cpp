// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/doe/propose.hpp>
#include <drawpoint/kriging/acquisition_constraints.hpp>
#include <drawpoint/kriging/cross_validation.hpp>
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

constexpr double infinity = std::numeric_limits<double>::infinity();

MatrixXd point(double mean, double deviation) { return (MatrixXd(1, 2) << mean, deviation).finished(); }

double improvement(double mean, double deviation, Goal goal, double best) {
  return expected_improvement(NormalSurrogate{}, goal, best)(point(mean, deviation))[0];
}

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

double bowl(const VectorXd& x) { return (x[0] - 0.3) * (x[0] - 0.3) + 0.5 * x[1]; }

// Runs of a noisy response and its model.
struct Noisy {
  MatrixXd X = reference::design(30, 2, 4);
  VectorXd y = reference::values(bowl, X);
  Noisy() {
    doe::RandomStream random(9);
    for (double& value : y) value += 0.1 * random.normal();
  }
};

}  // namespace

// Below −2 the continued fraction serves, above it erfc. At −2 the second loses a factor of 0.045/0.0085 =
// 5.4 to cancellation, some 1e-15 of relative error; 1e-14 leaves room for that of erfc itself. Far out the
// alternating series φ/t² (1 − 3/t² + 15/t⁴ − 105/t⁶) errs by less than its next term, 945/t⁸ = 2.5e-11 at t
// = 50, and that of Φ by 105/t⁸.
TEST(NormalTail, AgreesWithErfcAndWithTheAsymptoticSeries) {
  for (const double z : {-2.0, -1.999999}) {
    const double K = detail::laplace_fraction(-z);
    EXPECT_NEAR(detail::normal_density(z) * K / (K - z) / detail::normal_improvement(z), 1.0, 1e-14);
    EXPECT_NEAR(detail::log_normal_density(z) - std::log(K - z), detail::log_normal_probability(z), 1e-14);
  }
  const double t = 50, u = 1 / (t * t);
  EXPECT_NEAR(detail::log_normal_improvement(-t) - detail::log_normal_density(t),
              std::log(u * (1 - 3 * u + 15 * u * u - 105 * u * u * u)), 3e-11);
  EXPECT_NEAR(detail::log_normal_probability(-t) - detail::log_normal_density(t),
              std::log((1 - u + 3 * u * u - 15 * u * u * u) / t), 3e-12 + 1e-13);
  EXPECT_EQ(detail::log_normal_probability(-infinity), -infinity);
}

// ∫ (f* − y) φ((y − μ)/σ)/σ dy over [min(μ, f*) − 12σ, f*] by Simpson's rule with 4000 panels: h <= 6e-3 σ,
// error below (24σ/180) h⁴ max|f⁗| ~ 0.13·1.3e-9·10 σ = 2e-9 σ; what is left out below is 1e-31.
TEST(ExpectedImprovement, EqualsTheIntegral) {
  const double sigma = 0.7, best = 1.3;
  for (const double mean : {-2.0, 1.0, 1.3, 2.5, 4.0}) {
    const double from = std::min(mean, best) - 12 * sigma, h = (best - from) / 4000;
    double sum = 0;
    for (int k = 0; k <= 4000; ++k) {
      const double y = from + k * h, weight = k == 0 || k == 4000 ? 1 : k % 2 ? 4 : 2;
      sum += weight * (best - y) * detail::normal_density((y - mean) / sigma) / sigma;
    }
    EXPECT_NEAR(improvement(mean, sigma, Goal::minimize, best), sum * h / 3, 2e-9) << mean;
    EXPECT_EQ(improvement(mean, sigma, Goal::minimize, best),
              improvement(-mean, sigma, Goal::maximize, -best));
  }
}

TEST(ExpectedImprovement, WithoutVarianceIsTheImprovement) {
  EXPECT_EQ(improvement(1.0, 0.0, Goal::minimize, 1.5), 0.5);
  EXPECT_EQ(improvement(1.0, 0.0, Goal::maximize, 1.5), 0.0);
  const doe::Criterion logarithm = log_expected_improvement(NormalSurrogate{}, Goal::minimize, 1.5);
  EXPECT_EQ(logarithm(point(1.0, 0.0))[0], std::log(0.5));
  EXPECT_EQ(logarithm(point(2.0, 0.0))[0], -infinity);
}

// Four deviations from the best and more, to where the number itself has underflowed. The logarithm of a
// number with a relative error of a few 1e-15 errs by as much, relative to at least 1.
TEST(ExpectedImprovement, ItsLogarithmKeepsTheOrderWhereItUnderflows) {
  const doe::Criterion logarithm = log_expected_improvement(NormalSurrogate{}, Goal::minimize, 0.0);
  for (const double mean : {-1.0, 0.0, 2.0, 4.0, 20.0})
    EXPECT_NEAR(logarithm(point(mean, 1.0))[0], std::log(improvement(mean, 1.0, Goal::minimize, 0.0)),
                2e-14 * (1 + mean * mean));
  EXPECT_EQ(improvement(60.0, 1.0, Goal::minimize, 0.0), 0.0);
  EXPECT_GT(logarithm(point(60.0, 1.0))[0], logarithm(point(61.0, 1.0))[0]);
  EXPECT_TRUE(std::isfinite(logarithm(point(1e6, 1.0))[0]));
}

// At a run the re-interpolation has no variance, and its mean is the fitted value up to the round-off of rᵀα:
// n ε Σ|α|.
TEST(ExpectedImprovement, OfANoisyModelAsksForNoRunAgain) {
  const Noisy data;
  const Model model = fit(data.X, data.y);
  ASSERT_GT(model.noise_variance(), 1e-4);
  const detail::ModelState& s = model.state();
  const double round_off = 30 * 2.2e-16 * s.gls.alpha.cwiseAbs().sum() * s.y_scale;
  for (const Goal goal : {Goal::minimize, Goal::maximize}) {
    const VectorXd at_runs = expected_improvement(model, goal)(data.X);
    EXPECT_LE(at_runs.maxCoeff(), 4 * round_off);
    EXPECT_GE(at_runs.minCoeff(), 0.0);
    EXPECT_GT(expected_improvement(model, goal)(reference::design(200, 2, 5)).maxCoeff(), 1e3 * round_off);
    const double best =
        goal == Goal::minimize ? fitted_values(model).minCoeff() : fitted_values(model).maxCoeff();
    EXPECT_GT(expected_improvement(model, goal, best)(data.X).maxCoeff(), 1e-3)
        << "the regression asks again";
  }
  EXPECT_LE((fitted_values(model) - model.mean(data.X)).cwiseAbs().maxCoeff(), 4 * round_off);
}

// s² = αᵀCα/n of noise 10¹⁴ times the process: S − λαᵀα, the same without rounding, has lost all but one
// digit of it. A product of n² terms of one sign keeps 1e-13.
TEST(Reinterpolation, KeepsItsVarianceWhereNoiseIsAlmostAll) {
  const Eigen::MatrixXd X = reference::design(30, 2, 1);
  const Eigen::VectorXd y = X.col(0) + X.col(1);
  FitOptions options;
  options.nugget_lower = options.nugget_upper = 1e14;
  const Model model = fit(X, y, options);
  const detail::ModelState& s = model.state();
  const Eigen::MatrixXd C = cross_correlation(s.X, s.X, s.correlation);
  const double wanted = s.gls.alpha.dot(C * s.gls.alpha) / 30.0 * s.y_scale * s.y_scale;
  ASSERT_GT(wanted, 0.0);
  EXPECT_NEAR(reinterpolated(model).process_variance() / wanted, 1.0, 1e-12);
}

TEST(MaximumVariance, IsTheVariance) {
  const Noisy data;
  const Model model = fit(data.X, data.y);
  const MatrixXd X = reference::design(50, 2, 6);
  EXPECT_EQ(maximum_variance(model)(X), model.predict(X).variance);
}

// Φ(1) and Φ(−1), tabulated.
TEST(Feasibility, IsTheProbabilityOfKeepingTheLimit) {
  const doe::Response at_most{"damage", "s", Goal::at_most, 3.0}, at_least{"rate", "1", Goal::at_least, 3.0};
  const auto of = [&](const doe::Response& r, double mean, double deviation) {
    return probability_of_feasibility(NormalSurrogate{}, r)(point(mean, deviation))[0];
  };
  EXPECT_NEAR(of(at_most, 1.0, 2.0), 0.8413447460685429, 1e-15);
  EXPECT_NEAR(of(at_least, 1.0, 2.0), 0.15865525393145707, 1e-15);
  EXPECT_EQ(of(at_most, 3.0, 0.0), 1.0);
  EXPECT_EQ(of(at_least, 2.0, 0.0), 0.0);
  const doe::Problem problem{.variables = {{"a", "1", 0, 1}},
                             .responses = {at_most, {"note", "1"}, at_least}};
  const std::vector<NormalSurrogate> models(3);
  EXPECT_NEAR(probability_of_feasibility(problem, models)(point(1.0, 2.0))[0],
              0.8413447460685429 * 0.15865525393145707, 1e-15);
  const doe::Problem free{.variables = {{"a", "1", 0, 1}}, .responses = {{"note", "1"}}};
  EXPECT_EQ(probability_of_feasibility(free, std::vector<NormalSurrogate>(1))(point(1.0, 2.0))[0], 1.0);
}

// y = (1 − x)², limit x >= 0.5 on the second response x: the best feasible run is at 0.5..., not at the end.
TEST(ConstrainedImprovement, IsMeasuredFromTheBestFeasibleRun) {
  const MatrixXd X = VectorXd::LinSpaced(9, 0, 1);
  const VectorXd cost = X.col(0).array().square(), length = X.col(0);
  doe::Problem problem{.variables = {{"x", "m", 0, 1}},
                       .responses = {{"cost", "EUR", Goal::minimize}, {"length", "m", Goal::at_least, 0.55}}};
  const std::vector<Model> models{fit(X, cost), fit(X, length)};
  const MatrixXd points = VectorXd::LinSpaced(33, 0, 1);
  const VectorXd score = constrained_improvement(problem, models)(points);
  Eigen::Index best = 0;
  score.maxCoeff(&best);
  EXPECT_NEAR(points(best, 0), 0.55, 0.05) << "0.625 is the best run that keeps the limit";
  const VectorXd feasible = probability_of_feasibility(problem, models)(points);
  for (Eigen::Index i = 0; i < points.rows(); ++i) EXPECT_LE(score[i], feasible[i] * 0.4);
  problem.responses[1].limit = 2.0;
  EXPECT_EQ(constrained_improvement(problem, models)(points),
            probability_of_feasibility(problem, models)(points))
      << "no run is feasible";
}

TEST(CrossValidationError, IsThatOfTheNearestRun) {
  const Noisy data;
  const Model model = fit(data.X, data.y);
  const Validation v = leave_one_out(model);
  const VectorXd error = (v.observed - v.predicted).cwiseAbs();
  const MatrixXd near = data.X.array() + 1e-6;
  // v subtracts a number of the size of y from y: its round-off is some ε|y| ~ 1e-16·2.
  EXPECT_TRUE(cross_validation_error(model)(near).isApprox(error, 1e-13));
  EXPECT_EQ(cross_validation_error(fit(data.X, VectorXd::Ones(30)))(near), VectorXd(VectorXd::Zero(30)));
}

TEST(Believer, LetsABatchSpreadByItsOwnExpectations) {
  const doe::Problem problem{.variables = {{"a", "1", 0, 1}, {"b", "1", 0, 1}},
                             .responses = {{"y", "1", Goal::minimize}}};
  const Noisy data;
  doe::Evaluations runs{problem, {}};
  for (Eigen::Index i = 0; i < data.X.rows(); ++i)
    runs.rows.push_back({i, 0, 0, data.X.row(i), doe::Outcome(data.y[i]), 0.0});
  const Model model = fit(data.X, data.y);
  const doe::Outcome expected = believer(std::vector<Model>{model})(data.X.row(3).transpose());
  EXPECT_EQ(expected.values()[0], model.mean(data.X.row(3))[0]);
  const doe::Sampler improve = [](const doe::Evaluations& so_far) {
    return expected_improvement(fit(so_far.X(), so_far.y("y")), Goal::minimize);
  };
  const MatrixXd batch = doe::propose(runs, improve,
                                      {.batch = 3,
                                       .candidates = 500,
                                       .rule = doe::BatchRule::believer,
                                       .believe = believer(std::vector<Model>{model})});
  ASSERT_EQ(batch.rows(), 3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) EXPECT_GT((batch.row(i) - batch.row(j)).norm(), 1e-3);
}

TEST(Acquisition, RefusesWhatItCannotServe) {
  EXPECT_EQ(refusal([] { expected_improvement(NormalSurrogate{}, Goal::at_most, 1.0); }),
            "kriging::expected_improvement: goal is at_most; allowed are minimize and maximize; use "
            "probability_of_feasibility for limits");
  EXPECT_EQ(refusal([] { expected_improvement(NormalSurrogate{}, Goal::minimize, infinity); }),
            "kriging::expected_improvement: best is inf; allowed are finite numbers; leave failed runs out");
  EXPECT_EQ(
      refusal([] {
        probability_of_feasibility(NormalSurrogate{}, {"cost", "EUR", Goal::minimize});
      }),
      "kriging::probability_of_feasibility: response \"cost\" has the goal minimize; allowed are at_most and "
      "at_least; use expected_improvement for objectives");
  EXPECT_EQ(refusal([] { product_of_criteria({}); }),
            "kriging::product_of_criteria: 0 criteria; allowed is 1 or more; name at least one");
  const doe::Problem problem{.variables = {{"x", "m", 0, 1}}, .responses = {{"length", "m"}}};
  EXPECT_EQ(refusal([&] { constrained_improvement(problem, {}); }),
            "kriging::constrained_improvement: 0 models; the problem has 1 responses; give one model a "
            "response, in "
            "their order");
  const Noisy data;
  EXPECT_EQ(refusal([&] { constrained_improvement(problem, {fit(data.X, data.y)}); }),
            "kriging::constrained_improvement: the problem has 0 objectives; allowed is 1; use "
            "expected_hypervolume_improvement for more");
}

// Any two levels are as far apart: a level without runs is nearest to the run that is nearest otherwise.
TEST(CrossValidationError, TakesALevelForNoLength) {
  MatrixXd X(6, 2);
  X << 0.0, 0, 0.2, 9, 0.4, 0, 0.6, 9, 0.8, 0, 1.0, 9;
  const VectorXd y = (VectorXd(6) << 1, 2, 4, 3, 5, 9).finished();
  const Model model = fit(X, y, {.levels = {0, 10}});
  const Validation v = leave_one_out(model);
  const doe::Criterion error = cross_validation_error(model);
  const VectorXd score = error((MatrixXd(2, 2) << 0.41, 1, 0.41, 8).finished());
  EXPECT_EQ(score[0], score[1]);
  // Round-off of a difference of numbers of the size of y, some ε·9.
  EXPECT_NEAR(score[0], std::abs(v.observed[2] - v.predicted[2]), 1e-13);
}
