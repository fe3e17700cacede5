// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/fit_fidelities.hpp>
#include <drawpoint/kriging/surrogates.hpp>
#include <drawpoint/tests/kriging/fidelity_functions.hpp>
#include <drawpoint/tests/kriging/joint_cokriging.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const MatrixXd points = reference::design(20, 2, 9);

double rough(const VectorXd& x) { return std::sin(5 * x[0]) + x[1] * x[1]; }
double middle(const VectorXd& x) { return 1.5 * rough(x) + std::cos(3 * x[1]); }
double fine(const VectorXd& x) { return 0.8 * middle(x) + 0.5 * x[0] - 2; }

FidelityLevel level_of(const std::string& name, const reference::Function& f, const MatrixXd& X,
                       double deviation = 0) {
  FidelityLevel level{name, X, reference::values(f, X)};
  doe::RandomStream random(5);
  for (double& value : level.y) value += deviation * random.normal();
  return level;
}

// Two or three levels; nested designs, or each with its own.
std::vector<FidelityLevel> levels_of(int count, bool nested) {
  const MatrixXd X = reference::design(24, 2, 1);
  const MatrixXd Y = nested ? X.topRows(12).eval() : reference::design(12, 2, 2);
  const MatrixXd Z = nested ? X.topRows(6).eval() : reference::design(6, 2, 3);
  if (count == 2) return {level_of("rough", rough, X), level_of("fine", middle, Y)};
  return {level_of("rough", rough, X), level_of("middle", middle, Y), level_of("fine", fine, Z)};
}

// θ and λ given, nothing unknown of them: what is left to estimate is s², ρ and β.
std::vector<FidelityLevel> with_fixed_parameters(std::vector<FidelityLevel> levels, double nugget) {
  double theta = 0.8;
  for (FidelityLevel& level : levels) {
    level.options.theta_lower = level.options.theta_upper = theta;
    level.options.nugget_lower = level.options.nugget_upper = nugget;
    level.options.parameter_uncertainty = false;
    theta *= 0.5;
  }
  return levels;
}

std::vector<reference::JointLevel> joint_levels(const detail::CokrigingLevels& levels) {
  std::vector<reference::JointLevel> joint;
  for (const detail::CokrigingLevel& level : levels) {
    const detail::ModelState& s = level.s;
    joint.push_back({level.X, s.observed, level.variance() * detail::added_noise(s),
                     s.correlation.theta.cwiseProduct(s.input.factor.cwiseAbs2()), level.variance(),
                     level.rho.empty() ? 0.0 : level.rho_given[0], level.below_centre});
  }
  return joint;
}

std::string refusal(const std::vector<FidelityLevel>& levels, const FidelityOptions& options = {}) {
  try {
    fit_fidelities(levels, options);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace

// Universal co-Kriging of all runs at once, ρ with a column of its own. Both solve systems of a condition of
// at most Σ n / λ times the ratio of variances: 42/1e-3 · 10 = 4e5. Round-off 1e-16 of the right-hand sides
// grows by that and by the same again in u, where terms of the size of the response cancel: 1e-10 relative to
// the largest response or variance.
TEST(CokrigingRecursion, EqualsCokrigingOfAllRunsAtOnce) {
  for (const int count : {2, 3})
    for (const bool nested : {true, false}) {
      const FidelityModel model =
          fit_fidelities(with_fixed_parameters(levels_of(count, nested), 1e-3), {.compare = false});
      const reference::JointCokriging joint(joint_levels(model.levels()), true);
      const Prediction p = model.predict(points);
      const VectorXd diagonal = model.covariance(points).diagonal();
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const reference::JointPrediction q = joint.predict(points.row(i).transpose());
        EXPECT_NEAR(p.mean[i], q.mean, 1e-9 * 3) << count << " levels, nested " << nested;
        EXPECT_NEAR(p.variance[i], q.variance, 1e-9) << count << " levels, nested " << nested;
        EXPECT_NEAR(p.variance[i], diagonal[i], 1e-9);
      }
    }
}

// With the given ρ moved to the estimated one, where both are the same least-squares solution, the mean is
// that of co-Kriging with known ρ: no column needed. The iteration contracts, as ρ in the covariance moves
// the estimate little; 60 times leave nothing to move. Tolerance as above.
TEST(CokrigingRecursion, HasTheMeanOfKnownRhoWhereRhoIsTheEstimate) {
  for (const bool nested : {true, false}) {
    const FidelityModel fitted =
        fit_fidelities(with_fixed_parameters(levels_of(2, nested), 1e-3), {.compare = false});
    detail::CokrigingLevels levels = fitted.levels();
    const detail::CokrigingLevels below{levels[0]};
    for (int i = 0; i < 60; ++i) {
      levels[1].rho_given = levels[1].rho_coefficients();
      ASSERT_TRUE(detail::build(below, levels[1]));
    }
    ASSERT_NEAR(levels[1].rho_given[0], levels[1].rho_coefficients()[0], 1e-12);
    const FidelityModel model(levels, {});
    const reference::JointCokriging joint(joint_levels(levels), false);
    for (const auto& x : points.rowwise())
      EXPECT_NEAR(model(x.transpose()), joint.predict(x.transpose()).mean, 3e-9);
  }
}

// Noise known run by run, at both levels, at points of their own. Tolerance as above, λ being larger.
TEST(CokrigingRecursion, KnowsTheNoiseOfEachRun) {
  std::vector<FidelityLevel> levels = with_fixed_parameters(levels_of(2, false), 1e-3);
  for (FidelityLevel& level : levels) {
    level.options.nugget_lower = 1e-10;
    level.options.nugget_upper = 10;
    level.options.noise = Noise::known;
    level.options.noise_variance = VectorXd::LinSpaced(level.y.size(), 0.001, 0.02);
  }
  const FidelityModel model = fit_fidelities(levels, {.compare = false});
  for (std::size_t t = 0; t < 2; ++t)
    EXPECT_NEAR(model.report().levels[t].noise_variance, 0.0105, 1e-12) << "the mean of what was given";
  const reference::JointCokriging joint(joint_levels(model.levels()), true);
  for (const auto& x : points.rowwise()) {
    const Prediction p = model.predict(x);
    const reference::JointPrediction q = joint.predict(x.transpose());
    EXPECT_NEAR(p.mean[0], q.mean, 3e-9);
    EXPECT_NEAR(p.variance[0], q.variance, 1e-9);
    EXPECT_NEAR(model.predict(x, Target::observation).variance[0], p.variance[0] + 0.0105, 1e-12);
  }
}

// y = 2 y⁻ + 3 − x with a linear trend lies in the span of the regressors but for what the cheap model
// misses. Predictions are linear in the runs: with their weights w, |error| <= 2 |y⁻ − m| at x + Σ |wᵢ| 2 |y⁻
// − m| at run i. The weights are those of responses that are 1 at one run and 0 elsewhere.
TEST(Cokriging, IsExactWhereTheTrueResponseIsLinearInTheCheapOne) {
  const auto cheap = [](const VectorXd& x) { return std::sin(6 * x[0]); };
  const auto truth = [](const VectorXd& x) { return 2 * std::sin(6 * x[0]) + 3 - x[0]; };
  const MatrixXd X = VectorXd::LinSpaced(21, 0, 1), runs = X({0, 3, 7, 12, 16, 20}, Eigen::all);
  std::vector<FidelityLevel> levels{level_of("rough", cheap, X), level_of("fine", truth, runs)};
  levels[0].options.nugget_power = levels[1].options.nugget_power = 0;
  levels[1].options.trend = Trend::linear;
  const FidelityModel model = fit_fidelities(levels, {.compare = false}), below = model.lower_levels(1);
  const MatrixXd points = VectorXd::LinSpaced(57, 0, 1);
  const VectorXd missed = (below.mean(points) - reference::values(cheap, points)).cwiseAbs();
  const double most = (below.mean(runs) - reference::values(cheap, runs)).cwiseAbs().maxCoeff();
  VectorXd weights = VectorXd::Zero(points.rows());
  for (Eigen::Index i = 0; i < runs.rows(); ++i) {
    detail::CokrigingLevels changed = model.levels();
    changed[1].s.observed = VectorXd::Unit(runs.rows(), i);
    changed[1].s.y_centre = 0;
    ASSERT_TRUE(detail::build({changed[0]}, changed[1]));
    weights += FidelityModel(changed, {}).mean(points).cwiseAbs();
  }
  const VectorXd error = (model.mean(points) - reference::values(truth, points)).cwiseAbs();
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    EXPECT_LE(error[i], 2 * missed[i] + 2 * most * weights[i] + 1e-12) << points(i, 0);
  EXPECT_LT(error.maxCoeff(), 1e-4) << "the cheap level is well sampled";
  // ρ is a linear function of the runs too; sin 6x varies by 2 over them, so its weights are of the order 1.
  EXPECT_NEAR(model.report().levels[1].rho[0], 2, 20 * most + 1e-9);
  EXPECT_GT(model.report().levels[1].explained, 0.9);
}

// Of the mean and of the variance, with what is unknown of the parameters: central differences with a step of
// h = 2e-5 on a range of 1 err by h²/6 times the third derivative, which at rates up to 20 and amplitudes up
// to 3 is below 3 · 20³: 2e-6. λ of 1e-4 or more keeps the weights α below 1e4, so that 24 of them with
// correlations good to 1e-16 make round-off of 2e-11, over h 1e-6.
TEST(Cokriging, GradientsAreTheDerivatives) {
  for (const Trend rho : {Trend::constant, Trend::linear}) {
    std::vector<FidelityLevel> levels = levels_of(3, false);
    for (FidelityLevel& level : levels) level.options.nugget_lower = 1e-4;
    levels[0].options.trend = Trend::linear;
    levels[1].options.correlation = Correlation::matern52;
    const FidelityModel model = fit_fidelities(levels, {.rho = rho, .compare = false});
    for (const auto& row : points.topRows(6).rowwise()) {
      const VectorXd x = row.transpose();
      const PredictionGradient g = model.gradient(x);
      EXPECT_EQ(g.mean, model.mean_gradient(x));
      for (Eigen::Index k = 0; k < 2; ++k) {
        MatrixXd both(2, 2);
        both << row, row;
        both(0, k) += 2e-5;
        both(1, k) -= 2e-5;
        const Prediction p = model.predict(both);
        EXPECT_NEAR(g.mean[k], (p.mean[0] - p.mean[1]) / 4e-5, 3e-6);
        EXPECT_NEAR(g.variance[k], (p.variance[0] - p.variance[1]) / 4e-5, 3e-6);
      }
    }
  }
}

// Each run left out of its level and of those below is the model built by hand without it.
TEST(Cokriging, LeaveOneOutLeavesThePlaceOutOfEveryLevel) {
  const FidelityModel model =
      fit_fidelities(with_fixed_parameters(levels_of(2, true), 1e-3), {.compare = false});
  const Validation v = leave_one_out(model);
  std::vector<reference::JointLevel> joint = joint_levels(model.levels());
  const auto without_first = [](const auto& A) { return A.bottomRows(A.rows() - 1).eval(); };
  for (reference::JointLevel& level : joint)
    level = {without_first(level.X),
             without_first(level.y),
             without_first(level.noise),
             level.rate,
             level.variance,
             level.rho,
             level.centre};
  const reference::JointPrediction q =
      reference::JointCokriging(joint, true).predict(model.levels()[1].X.row(0).transpose());
  EXPECT_NEAR(v.predicted[0], q.mean, 3e-9);
  EXPECT_NEAR(v.variance[0], q.variance, 1e-9);
  EXPECT_NEAR(v.observation_variance[0], q.variance + model.noise_variance(), 1e-9);
}

TEST(Cokriging, IsASurrogateAsAnyOther) {
  const std::vector<FidelityLevel> levels = levels_of(2, false);
  const FidelityModel model = fit_fidelities(levels);
  const AnySurrogate any = model;
  EXPECT_EQ(any.mean(points), model.predict(points).mean);
  EXPECT_EQ(any.variables(), 2);
  EXPECT_EQ(any.message(), model.message());
  EXPECT_EQ(any.mean_gradient(points.row(0)), model.mean_gradient(points.row(0)));
  EXPECT_TRUE(leave_one_out(any));
  const doe::ValueAndJacobian y = Surrogates({any, fit(levels[0].X, levels[0].y)})(points.row(0));
  EXPECT_EQ(y.values[0], model(points.row(0)));
  EXPECT_EQ(y.jacobian.row(0).transpose(), model.mean_gradient(points.row(0)));
  const FidelityFitter fitter({levels[0]});
  EXPECT_EQ(fitter(levels[1].X, levels[1].y).mean(points), model.mean(points));
  EXPECT_LT(k_fold(levels[1].X, levels[1].y, 4, fitter).nrmse, 0.2);
  EXPECT_LT(validate(model, points, reference::values(middle, points)).nrmse, 0.02);
}

TEST(Cokriging, ReportsRhoPerLevel) {
  const FidelityModel model = fit_fidelities(levels_of(3, true));
  ASSERT_EQ(model.report().levels.size(), 3u);
  EXPECT_EQ(model.report().levels[0].rho.size(), 0);
  for (const auto& [t, rho] : {std::pair{1, 1.5}, std::pair{2, 0.8}}) {
    const FidelityLevelReport& level = model.report().levels[static_cast<std::size_t>(t)];
    // Four standard errors, of an estimate from few runs with estimated parameters.
    EXPECT_NEAR(level.rho[0], rho, 4 * level.rho_standard_error[0]) << level.name;
    EXPECT_GT(level.explained, 0.0);
    EXPECT_LT(level.explained, 1.0);
  }
  EXPECT_NE(model.message().find("the cheaper levels help: leave-one-out RMSE"), std::string::npos)
      << model.message();
}

TEST(Cokriging, RhoThatVariesIsFound) {
  const auto cheap = [](const VectorXd& x) { return std::sin(9 * x[0]); };
  const auto truth = [](const VectorXd& x) { return (1 + 0.8 * (2 * x[0] - 1)) * std::sin(9 * x[0]); };
  const MatrixXd X = VectorXd::LinSpaced(31, 0, 1), runs = VectorXd::LinSpaced(7, 0, 1);
  const FidelityModel model = fit_fidelities({level_of("rough", cheap, X), level_of("fine", truth, runs)},
                                             {.rho = Trend::linear, .compare = false});
  const FidelityLevelReport& level = model.report().levels[1];
  ASSERT_EQ(level.rho.size(), 2);
  EXPECT_NEAR(level.rho[0], 1.0, 4 * level.rho_standard_error[0]);
  EXPECT_NEAR(level.rho[1], 0.8, 4 * level.rho_standard_error[1]);
}

// A level below that the trend of the true runs repeats says nothing: ρ is left out.
TEST(Cokriging, ALevelThatTheTrendRepeatsHasNoRho) {
  const auto plane = [](const VectorXd& x) { return 3 * x[0] - x[1]; };
  FidelityLevel cheap = level_of("rough", plane, reference::design(20, 2, 1));
  cheap.options.trend = Trend::linear;
  FidelityLevel truth = level_of("fine", rough, reference::design(12, 2, 2));
  truth.options.trend = Trend::linear;
  const FidelityModel model = fit_fidelities({cheap, truth}, {.compare = false});
  EXPECT_EQ(model.report().levels[1].rho.size(), 0);
  EXPECT_NE(model.message().find("cannot be told from its trend"), std::string::npos) << model.message();
  EXPECT_TRUE(model.predict(truth.X).mean.allFinite());
  EXPECT_TRUE(model.gradient(truth.X.row(0)).variance.allFinite());
}

TEST(FidelityErrors, NameLevelValueRangeAndNextStep) {
  const std::string place = "kriging::fit_fidelities: ";
  const std::vector<FidelityLevel> sound = levels_of(2, true);
  EXPECT_EQ(
      refusal({sound[0]}),
      place + "1 levels; allowed is 2 or more, from the cheapest to the true one; use kriging::fit for one");
  const auto changed = [&](std::size_t t, const auto& change) {
    std::vector<FidelityLevel> levels = sound;
    change(levels[t]);
    return refusal(levels);
  };
  EXPECT_EQ(
      changed(1, [](FidelityLevel& l) { l.X = l.X.leftCols(1).eval(); }),
      place +
          "level \"fine\": X has 1 columns but that of the cheapest level has 2; give all levels the same "
          "variables");
  EXPECT_EQ(
      changed(1, [](FidelityLevel& l) { l.X = l.X.topRows(2).eval(), l.y = l.y.head(2).eval(); }),
      place +
          "level \"fine\": 2 runs for 2 coefficients of rho and the trend; allowed is 3 or more; make more "
          "runs");
  EXPECT_EQ(changed(0, [](FidelityLevel& l) { l.X.resize(0, 2), l.y.resize(0); }),
            place + "level \"rough\": X has 0 runs; allowed is 1 or more; give one row per run");
  EXPECT_EQ(
      changed(0, [](FidelityLevel& l) { l.y.setConstant(4); }),
      place +
          "level \"rough\": all 24 responses equal 4; allowed are levels that vary; leave the level out, or "
          "check its response");
  EXPECT_EQ(changed(1, [](FidelityLevel& l) { l.X.rowwise() = l.X.row(0).eval(); }),
            place +
                "level \"fine\": all 12 runs have the same inputs; allowed are two points or more; run it at "
                "other points");
  EXPECT_EQ(changed(1, [](FidelityLevel& l) { l.y[3] = std::nan(""); }),
            place + "level \"fine\": y[3] is nan; allowed are finite numbers; leave failed runs out");
  EXPECT_EQ(changed(1, [](FidelityLevel& l) { l.name = "", l.y.resize(3); }),
            place + "level 1: X has 12 rows but y has 3 entries; give one response a run");
  EXPECT_EQ(
      changed(1, [](FidelityLevel& l) { l.options.trend = Trend::blind; }),
      place +
          "level \"fine\": its trend is blind; allowed above the cheapest level are constant, linear and "
          "quadratic; use constant");
  EXPECT_EQ(refusal(sound, {.rho = Trend::quadratic}),
            place + "rho is neither constant nor linear; allowed are these; use constant");
  const FidelityModel model = fit_fidelities(sound, {.compare = false});
  EXPECT_THROW(model.predict(MatrixXd::Zero(1, 3)), std::invalid_argument);
  EXPECT_THROW(model.mean_gradient(VectorXd::Zero(3)), std::invalid_argument);
  EXPECT_THROW(model.lower_levels(3), std::invalid_argument);
}
