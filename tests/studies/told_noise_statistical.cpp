// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Runs that tell their own standard error, from the table of runs to what is predicted of the next.

#include <drawpoint/studies/model/fits/models.h>
#include <drawpoint/studies/model/fits/suspects.h>
#include <drawpoint/studies/model/sampling/repeats.h>
#include <drawpoint/studies/say/model_report.h>
#include <drawpoint/studies/say/page/data.h>
#include <gtest/gtest.h>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

/// Of one variable: a mean of samples with noise of 0.02 on the left, rising fiftyfold to the right.
double deviation(double x) { return 0.02 * std::pow(50.0, x); }
double mean(double x) { return 5 + std::sin(6 * x); }

doe::Problem problem() {
  return {.variables = {{"x", "m", 0.0, 1.0}},
          .responses = {
              {.name = "load", .unit = "t", .goal = doe::Goal::maximize, .standard_error = "load_error"},
              {.name = "load_error", .unit = "t", .lower = 0}}};
}

/// Twenty samples each: the standard error that a run tells is known to a sixth of itself.
doe::Outcome run(double x, doe::RandomStream& random) {
  constexpr int samples = 20;
  Eigen::VectorXd values(samples);
  for (double& value : values) value = mean(x) + deviation(x) * std::sqrt(samples) * random.normal();
  const double scatter = (values.array() - values.mean()).square().sum() / (samples - 1);
  return {values.mean(), std::sqrt(scatter / samples)};
}

doe::Evaluations runs(int n, doe::Seed seed) {
  doe::Evaluations table{problem(), {}};
  const Eigen::MatrixXd X = doe::latin_hypercube(table.problem, n, {.seed = seed});
  doe::RandomStream random(seed);
  for (int i = 0; i < n; ++i) table.rows.push_back({i + 1, 0, 1, X.row(i), run(X(i, 0), random), 0.0});
  return table;
}

double width(const Models& fitted, double x) {
  const PlannedPoints p = with_predictions(fitted.models, problem(), Eigen::MatrixXd::Constant(1, 1, x));
  return p.upper(0, 0) - p.lower(0, 0);
}

}  // namespace

// 60 runs. The interval of a run is 2 * 1.96 of its deviation where the model of the mean is far better known
// than that, as it is in the middle and on the right: 60 runs put its error at some third of a run's. The
// standard errors are told to a sixth each, and their model has ten runs per place to learn from. A third of
// the width either way leaves room for both.
TEST(ToldNoise, IntervalsAreAsWideAsRunsScatterThere) {
  const Models fitted = fit_models({runs(60, 1), {problem(), {}}});
  EXPECT_NE(fitted.noise[0], kriging::NoiseSource::estimated) << fitted.ways[0];
  EXPECT_EQ(fitted.noise[1], kriging::NoiseSource::estimated) << fitted.ways[1];
  for (const double x : {0.3, 0.6, 0.9}) {
    const double own = 2 * 1.96 * deviation(x);
    EXPECT_GT(width(fitted, x), own / 1.33) << x;
    EXPECT_LT(width(fitted, x), own * 1.33) << x;
  }
}

// 300 fresh runs, by halves: noise of the right half is sevenfold that of the left, and intervals of one
// width would miss on the right and hold all on the left. Of 150 runs 95 % within have a standard error of
// 1.8 %; standard errors told to a sixth of themselves are a normal variable over that of Student's t with 19
// degrees of freedom, of which 1.96 hold 93.5 %. Three standard errors below that are 88 %; that all of 150
// hold has a chance of 5e-4.
TEST(ToldNoise, IntervalsHoldOnBothSides) {
  const Models fitted = fit_models({runs(60, 1), runs(300, 2)});
  const kriging::Validation& v = fitted.validations[0];
  const doe::Evaluations fresh = runs(300, 2);
  int held[2] = {}, all[2] = {};
  for (Eigen::Index i = 0; i < v.observed.size(); ++i) {
    const int side = fresh.X()(i, 0) > 0.5;
    ++all[side];
    held[side] += kriging::predicted_quantile(v, i, 0.025) <= v.observed[i] &&
                  v.observed[i] <= kriging::predicted_quantile(v, i, 0.975);
  }
  for (const int side : {0, 1}) {
    EXPECT_GT(held[side], 0.88 * all[side]);
    EXPECT_LT(held[side], all[side]);
  }
  EXPECT_TRUE(suspects(fitted, {runs(60, 1), {problem(), {}}}).empty());
}

// A problem without chance: every way to fit takes the runs for exact, on each scale, and meets them.
TEST(ExactRuns, AreMetByTheModelsOfAStudy) {
  for (const double lower : {-std::numeric_limits<double>::infinity(), 0.0}) {
    doe::Problem exact{.variables = {{"x", "1", 0, 1}, {"z", "1", 0, 1}},
                       .responses = {{.name = "y", .unit = "t", .goal = doe::Goal::minimize, .lower = lower}},
                       .deterministic = true};
    doe::Evaluations table{exact, {}};
    const Eigen::MatrixXd X = doe::latin_hypercube(exact, 30, {.seed = 1});
    for (int i = 0; i < 30; ++i)
      table.rows.push_back(
          {i + 1, 0, 1, X.row(i), doe::Outcome(2 + std::sin(6 * X(i, 0)) + X(i, 1) * X(i, 1)), 0.0});
    const Models fitted = fit_models({table, {exact, {}}});
    EXPECT_LT((fitted.models[0].mean(X) - table.y("y")).cwiseAbs().maxCoeff(), 1e-3) << lower;
  }
}

// Two samples per run tell each run's error to its own size and all of them together to a tenth: fits that know
// it are not taken in by 40 runs of nothing but noise, as estimates are now and then (docs/measurements).
// Fresh runs scatter by √(1/2); a model's interval, 3.92 of what it takes a run to scatter by where the mean
// is known, is within √(2/40)/2 = 11 % of that, and three times as much leaves room for what the mean is not
// known by, a third of a run's noise at most.
TEST(ToldNoise, OfTwoSamplesIsPooled) {
  int pooled = 0;
  for (doe::Seed seed = 1; seed <= 5; ++seed) {
    doe::Evaluations table{problem(), {}};
    doe::RandomStream random(seed);
    const Eigen::MatrixXd X = doe::latin_hypercube(table.problem, 40, {.seed = seed});
    for (int i = 0; i < 40; ++i) {
      const double a = 5 + random.normal(), b = 5 + random.normal();
      table.rows.push_back({i + 1, 0, 1, X.row(i), doe::Outcome{0.5 * (a + b), 0.5 * std::abs(a - b)}, 0.0});
    }
    const Models fitted = fit_models({table, {problem(), {}}});
    pooled += fitted.noise[0] == kriging::NoiseSource::pooled;
    EXPECT_NEAR(width(fitted, 0.5), 3.92 * std::sqrt(0.5), 0.33 * 3.92 * std::sqrt(0.5)) << seed;
  }
  EXPECT_GE(pooled, 4)
      << "another source has to be better by more than a standard error: by chance, now and then";
}

// Every third run scatters fiftyfold and tells so, by 20 samples. Where the problem says how many these are, each run's
// own word counts, moderated, and the mean is missed by less than half of what it is otherwise; where it does not, no
// run's word counts beside its neighbours'. Sum over five designs of 40 runs.
TEST(ToldNoise, OfARunCountsWhereItsSamplesAreSaid) {
  double said = 0, unsaid = 0;
  for (doe::Seed seed = 1; seed <= 5; ++seed) {
    doe::Evaluations table{problem(), {}};
    doe::RandomStream random(seed);
    const Eigen::MatrixXd X = doe::latin_hypercube(table.problem, 40, {.seed = seed});
    for (int i = 0; i < 40; ++i) {
      const double noise = i % 3 == 0 ? 1.0 : 0.02;
      double squares = 0;
      for (int k = 0; k < 19; ++k) squares += std::pow(random.normal(), 2) / 19;
      table.rows.push_back({i + 1, 0, 1, X.row(i),
                            doe::Outcome{mean(X(i, 0)) + noise * random.normal(), noise * std::sqrt(squares)},
                            0.0});
    }
    const auto error = [&](double freedom, bool weighed) {
      table.problem.responses[0].standard_error_freedom = freedom;
      const Models fitted = fit_models({table, {table.problem, {}}});
      EXPECT_EQ(fitted.noise[0] == kriging::NoiseSource::told, weighed) << seed;
      const Eigen::MatrixXd at = Eigen::VectorXd::LinSpaced(50, 0, 1);
      return (fitted.models[0].mean(at) - at.col(0).unaryExpr(&mean)).norm();
    };
    said += error(19, true);
    unsaid += error(0, false);
  }
  EXPECT_LT(said, 0.5 * unsaid);
}

namespace {

/// Rock that is lost now and then: lumps of 0.002 to 0.2, as often of each size, Poisson of this mean per cycle, 0.1 to
/// 10 over the box. The mean lump: (0.2 - 0.002)/ln 100.
double lumps(const Eigen::VectorXd& x) { return 0.1 * std::pow(10.0, x[0] + x[1]); }
double lost_in_the_mean(const Eigen::VectorXd& x) { return (0.2 - 0.002) / std::log(100.0) * lumps(x); }

double lost_in_a_cycle(const Eigen::VectorXd& x, doe::RandomStream& random) {
  double sum = 0;
  for (double left = std::exp(-lumps(x)), p = random.uniform(); p > left; p *= random.uniform())
    sum += 0.002 * std::pow(100.0, random.uniform());
  return sum;
}

/// A run of three cycles, which tells its error by the last two, as loading runs do: 0 where they lost nothing.
doe::Outcome run_that_loses(const Eigen::VectorXd& x, doe::RandomStream& random) {
  const double a = lost_in_a_cycle(x, random), b = lost_in_a_cycle(x, random), c = lost_in_a_cycle(x, random);
  return {(a + b + c) / 3, std::abs(b - c) / std::sqrt(2.0) / std::sqrt(3.0)};
}

doe::Evaluations runs_that_lose(int n, doe::Seed seed) {
  doe::Problem rare = problem();
  rare.variables.push_back({"z", "m", 0.0, 1.0});
  rare.responses[0].lower = 0;
  rare.responses[0].goal = doe::Goal::minimize;
  doe::Evaluations table{rare, {}};
  const Eigen::MatrixXd X = doe::latin_hypercube(rare, n, {.seed = seed});
  doe::RandomStream random(seed);
  for (int i = 0; i < n; ++i)
    table.rows.push_back({i + 1, 0, 1, X.row(i), run_that_loses(X.row(i), random), 0.0});
  return table;
}

}  // namespace

// 20 designs of 40 runs, 50 new places each. Errors of designs are shared by their places: coverage of one design
// scatters by some 10 %, so that of 20 by 2 %, and what quadratures and fits of lumps leave is some 3 %: 95 less three
// standard errors and that. No run's own word is taken where others tell 0, and the noise has one size on a scale that
// is not linear: what a run has in the mean lies within the interval of one run.
TEST(ToldNoise, OfRunsThatSawNothingIsNotNone) {
  int mean_held = 0, held = 0, all = 0;
  for (doe::Seed seed = 1; seed <= 20; ++seed) {
    const doe::Evaluations table = runs_that_lose(40, seed), fresh = runs_that_lose(50, 100 + seed);
    ASSERT_EQ(table.noise_variance("load").minCoeff(), 0) << seed;
    const Models fitted = fit_models({table, {table.problem, {}}});
    const kriging::TransformedModel& model = fitted.models[0];
    EXPECT_NE(fitted.noise[0], kriging::NoiseSource::told) << seed;
    if (model.transform().scale != kriging::Scale::linear) {
      EXPECT_EQ(model.model().state().noise.size(), 0) << seed;
    }
    const Eigen::MatrixXd X = fresh.X();
    const PlannedPoints p = with_predictions(fitted.models, table.problem, X);
    const Eigen::VectorXd low = model.quantile(X, 0.025), high = model.quantile(X, 0.975);
    for (int i = 0; i < 50; ++i, ++all) {
      const double y = fresh.y("load")[i], truth = lost_in_the_mean(X.row(i));
      mean_held += low[i] <= truth && truth <= high[i];
      held += p.lower(i, 0) <= y && y <= p.upper(i, 0);
      EXPECT_LE(p.lower(i, 0), p.predicted(i, 0));
      EXPECT_LE(p.predicted(i, 0), p.upper(i, 0));
    }
  }
  EXPECT_GT(mean_held, 0.86 * all);
  EXPECT_GT(held, 0.86 * all);
}

// However poor the model of the errors is, the page says nothing of it, and marks the response, so that plots
// and tables of models leave it out.
TEST(ToldNoise, HasNoModelOnThePage) {
  const Models fitted = fit_models({runs(40, 1), runs(10, 2)});
  ReportInput in;
  in.problem = problem();
  in.training = runs(40, 1);
  in.validation = runs(10, 2);
  in.models = fitted.models;
  in.validations = fitted.validations;
  in.validations[1].nrmse = 0.9;
  const nlohmann::json page = detail::report_data(in);
  EXPECT_FALSE(page["problem"]["responses"][0].contains("is_error"));
  EXPECT_TRUE(page["problem"]["responses"][1].at("is_error").get<bool>());
  ASSERT_EQ(page["summary"]["trust"].size(), 1u);
  EXPECT_EQ(page["summary"]["trust"][0]["response"], "load");
  EXPECT_TRUE(page["influence"][1].is_null());
  EXPECT_FALSE(page["influence"][0].is_null());
  EXPECT_EQ(page["summary"].dump().find("load error"), std::string::npos);
}

// The commands fit and validate speak of the response, and not of its standard error.
TEST(ToldNoise, HasNoModelInTheCommands) {
  const Tables tables{runs(40, 1), runs(10, 2)};
  const Models fitted = fit_models(tables);
  for (const std::string& text : {fit_text(fitted, problem()), validation_text(fitted, tables)}) {
    EXPECT_EQ(text.rfind("load [t]: ", 0), 0u) << text;
    EXPECT_EQ(text.find("load_error"), std::string::npos) << text;
  }
  for (const nlohmann::ordered_json& all : {fit_json(fitted, problem()), validation_json(fitted, tables)}) {
    EXPECT_EQ(all.size(), 1u) << all;
    EXPECT_TRUE(all.contains("load")) << all;
  }
}

// All runs exact: nothing is told, and fits estimate as ever.
TEST(ToldNoise, OfExactRunsIsNone) {
  doe::Evaluations table = runs(20, 1);
  for (doe::Evaluation& row : table.rows) row.outcome = {mean(row.x[0]), 0.0};
  EXPECT_EQ(told_noise(table, table.problem.responses[0]).noise, kriging::Noise::nugget);
  EXPECT_EQ(told_noise(table, table.problem.responses[1]).noise, kriging::Noise::nugget);
  EXPECT_NEAR(fit_models({table, {problem(), {}}}).models[0](Eigen::VectorXd::Constant(1, 0.5)), mean(0.5),
              1e-3);
}

// What the others leave out may leave no run that is noisy, or none whose noise can be: models stay.
TEST(ToldNoise, OfOneRunSpoilsNoModel) {
  doe::Evaluations table = runs(25, 1);
  for (doe::Evaluation& row : table.rows)
    row.outcome = row.run == 10 ? doe::Outcome{mean(row.x[0]) + 3, 3.0} : doe::Outcome{mean(row.x[0]), 0.0};
  const Tables one{table, {problem(), {}}};
  const Models fitted = fit_models(one);
  EXPECT_NO_THROW(suspects(fitted, one));
  table.rows[2].outcome = {mean(table.rows[2].x[0]), 1e99};
  const Tables absurd{table, {problem(), {}}};
  EXPECT_EQ(told_noise(table, table.problem.responses[0]).noise, kriging::Noise::nugget);
  const std::vector<std::string> said = suspects(fit_models(absurd), absurd);
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said[0],
            "Run 3 tells load_error as 1e+99 t; allowed is 1e75 at most. What the runs tell of the noise of "
            "load is "
            "left out; make the run again with evaluate --run 3.");
}

// Noise rises fiftyfold to the right, and the curve is known there by few runs for its noise: all repeats are
// in the right half, though the runs are spread evenly.
TEST(ToldNoise, RunsAreRepeatedWhereTheyAreNoisy) {
  const doe::Evaluations table = runs(40, 3);
  const Models fitted = fit_models({table, {problem(), {}}});
  ASSERT_NE(fitted.noise[0], kriging::NoiseSource::estimated);
  const Eigen::MatrixXd again = points_to_repeat(table, fitted.models, {}, {.count = 6});
  ASSERT_EQ(again.rows(), 6);
  EXPECT_GT(again.col(0).minCoeff(), 0.5);
}
