// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// A response that jumps is called uneven, and the jump is found; one that does not is left alone.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/kriging/nonstationarity.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;

namespace {

/// n runs of a wave in two inputs, `lower` to `lower + 1` each, with noise and a step where the first passes
/// lower + 0.55.
struct Wave {
  double step = 0, noise = 0.05, lower = 0;
  int runs = 60;

  Eigen::MatrixXd X(doe::Seed seed) const {
    const doe::Problem box{{{"a", "1", lower, lower + 1}, {"b", "1", lower, lower + 1}}, {{"y", "1"}}};
    return doe::latin_hypercube(box, runs, {.seed = seed});
  }
  Model fitted(doe::Seed seed) const {
    const Eigen::MatrixXd P = X(seed);
    Eigen::VectorXd y(P.rows());
    doe::RandomStream random(seed);
    for (Eigen::Index i = 0; i < P.rows(); ++i) {
      const double a = P(i, 0) - lower, b = P(i, 1) - lower;
      y[i] = 0.3 * std::sin(3 * a) + 0.5 * b * a + (a > 0.55 ? step : 0.0) + noise * random.normal();
    }
    return fit(P, y);
  }
};

// Level 0.01: of 60 designs five or more are called uneven with a chance of 4e-4.
TEST(Stationarity, ASmoothResponseIsEven) {
  int uneven = 0;
  for (doe::Seed seed = 1; seed <= 60; ++seed) uneven += check_stationarity(Wave{}.fitted(seed)).uneven;
  EXPECT_LE(uneven, 4);
}

// A step of 20 deviations of the noise between two of 60 runs. Its size is that of the true step but for four
// standard errors, to which the wave's change across a gap of 1/60, at most 1.4/60, adds.
TEST(Stationarity, AJumpIsFoundWithItsPlaceAndSize) {
  for (doe::Seed seed = 1; seed <= 12; ++seed) {
    const Stationarity s = check_stationarity(Wave{.step = -1}.fitted(seed));
    EXPECT_TRUE(s.uneven) << seed;
    EXPECT_EQ(s.input, 0) << seed;
    ASSERT_TRUE(s.jump) << seed;
    EXPECT_EQ(s.jump->input, 0) << seed;
    EXPECT_LE(s.jump->after, 0.55) << seed;
    EXPECT_GE(s.jump->before, 0.55) << seed;
    EXPECT_LE(s.from, s.jump->after) << seed;
    EXPECT_GE(s.to, s.jump->before) << seed;
    EXPECT_NEAR(s.jump->size, -1, 4 * s.jump->standard_error + 1.4 / 60) << seed;
    EXPECT_LT(s.jump->error_left, 0.7);
  }
}

// Every other run has noise of 2, a variance 1600 times that of the rest, and the model knows it: the precise
// runs alone tell of the jump. The trend of the model stays beside the step.
TEST(Stationarity, AJumpIsFoundAmongRunsOfKnownNoise) {
  int found = 0;
  for (doe::Seed seed = 1; seed <= 6; ++seed) {
    const Wave wave{.step = 1};
    const Eigen::MatrixXd X = wave.X(seed);
    Eigen::VectorXd y = wave.fitted(seed).state().observed, variance(60);
    doe::RandomStream random(50 + seed);
    for (Eigen::Index i = 0; i < 60; ++i) {
      variance[i] = i % 2 == 0 ? 0.05 * 0.05 : 2 * 2;
      if (i % 2 != 0) y[i] += 2 * random.normal();
    }
    FitOptions options;
    options.trend = seed % 2 == 0 ? Trend::linear : Trend::constant;
    options.noise = Noise::known;
    options.noise_variance = variance;
    const Stationarity s = check_stationarity(fit(X, y, options));
    if (!s.jump) continue;
    ++found;
    EXPECT_EQ(s.jump->input, 0);
    // Between two of 30 precise runs, as a Latin design scatters them.
    EXPECT_NEAR(0.5 * (s.jump->after + s.jump->before), 0.55, 0.1);
    EXPECT_NEAR(s.jump->size, 1, 4 * s.jump->standard_error + 0.14);  // and 1.4 of it of the wave
  }
  EXPECT_GE(found, 3);  // the place and size are right in all six; errors fall by enough in four
}

// An input of three whole values, noise at the middle one alone: the window is that value, with all its runs.
TEST(Stationarity, RunsOfOneValueStayTogether) {
  Eigen::MatrixXd X(90, 2);
  Eigen::VectorXd y(90);
  doe::RandomStream random(4);
  for (Eigen::Index i = 0; i < 90; ++i) {
    X(i, 0) = static_cast<double>((7 * i) % 3);
    X(i, 1) = random.uniform();
    y[i] = 2 * std::sin(3 * X(i, 1)) + (X(i, 0) == 1 ? 1.0 : 0.02) * random.normal();
  }
  const Stationarity s = check_stationarity(fit(X, y));
  ASSERT_TRUE(s.uneven);
  EXPECT_EQ(s.input, 0);
  EXPECT_NEAR(s.from, 1, 1e-12);
  EXPECT_NEAR(s.to, 1, 1e-12);
  EXPECT_EQ(s.runs.size(), 30U);
}

TEST(Stationarity, NamesTheRunsInTheWindow) {
  const Wave wave{.step = 1};
  const Eigen::MatrixXd X = wave.X(2);
  const Stationarity s = check_stationarity(wave.fitted(2));
  ASSERT_TRUE(s.uneven);
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    const bool named = std::find(s.runs.begin(), s.runs.end(), i) != s.runs.end();
    // A scaled input and back: round-off of 1.
    EXPECT_EQ(named, X(i, 0) >= s.from - 1e-12 && X(i, 0) <= s.to + 1e-12);
  }
}

// A step along x + y = 1.1 shows along no input alike, but between neighbours.
TEST(Stationarity, AJumpThatFollowsNoInputIsUneven) {
  int uneven = 0, along_none = 0;
  for (doe::Seed seed = 1; seed <= 10; ++seed) {
    const Eigen::MatrixXd X = Wave{.runs = 80}.X(seed);
    Eigen::VectorXd y(80);
    for (Eigen::Index i = 0; i < 80; ++i)
      y[i] = 0.3 * std::sin(3 * X(i, 0)) + (X(i, 0) + X(i, 1) > 1.1 ? 1.0 : 0.0);
    const Stationarity s = check_stationarity(fit(X, y));
    uneven += s.uneven;
    if (s.uneven && s.input < 0) {
      ++along_none;
      EXPECT_EQ(s.runs.size(), 8U);
      for (const Eigen::Index i : s.runs) EXPECT_LT(std::abs(X(i, 0) + X(i, 1) - 1.1), 0.35) << seed;
    }
  }
  // 38 of 40 optimised designs; with a power of 0.85 fewer than 6 have a chance of 0.01
  EXPECT_GE(uneven, 6);
  EXPECT_GE(along_none, 1);
}

// Runs of one site are left out together, as leave-one-out has it: with a jump between 30 places of four runs
// each, the squared errors over their variances are those of leave_one_out.
TEST(Stationarity, LeavesSitesOut) {
  const Eigen::MatrixXd P = Wave{.runs = 30}.X(3);
  Eigen::MatrixXd X(120, 2);
  X << P, P, P, P;
  Eigen::VectorXd y(120);
  doe::RandomStream random(3);
  for (Eigen::Index i = 0; i < 120; ++i)
    y[i] = X(i, 1) + (X(i, 0) > 0.55 ? 1.0 : 0.0) + 0.05 * random.normal();
  const Model model = fit(X, y);
  const Validation v = leave_one_out(model);
  const Eigen::VectorXd squares = detail::SitesOfModel(model.state()).squared_errors(model.state().gls.alpha);
  for (Eigen::Index i = 0; i < 120; ++i) {
    const double error = v.observed[i] - v.predicted[i];
    const double expected = error * error / v.observation_variance[i];
    EXPECT_NEAR(squares[i] / model.state().process_variance, expected, 1e-6 * expected + 1e-9) << i;
  }
  const Stationarity s = check_stationarity(model);
  ASSERT_TRUE(s.jump);
  EXPECT_EQ(s.jump->input, 0);
  EXPECT_LE(s.jump->after, 0.55);
  EXPECT_GE(s.jump->before, 0.55);
}

TEST(Stationarity, DoesNotDependOnUnitOrOffset) {
  const Stationarity a = check_stationarity(Wave{.step = 1}.fitted(2));
  const Wave far{.step = 1, .lower = 64};  // a power of two: the same design to the last bit but four
  const Stationarity b = check_stationarity(far.fitted(2));
  ASSERT_TRUE(a.jump && b.jump);
  EXPECT_EQ(a.p_value, b.p_value);
  EXPECT_EQ(a.runs, b.runs);
  EXPECT_NEAR(b.jump->after - 64, a.jump->after, 1e-12);
  EXPECT_NEAR(b.jump->size, a.jump->size, 1e-3 * std::abs(a.jump->size));  // as far as a search's end goes
}

// One wild run is for find_outliers: of 20 designs, level 0.01, three or more would be called uneven by
// chance once in a thousand.
TEST(Stationarity, OneWildRunIsNotUnevenness) {
  int uneven = 0;
  for (doe::Seed seed = 1; seed <= 20; ++seed) {
    const Wave wave;
    const Model whole = wave.fitted(seed);
    Eigen::VectorXd y = whole.state().observed;
    y[static_cast<Eigen::Index>(seed)] += 3;
    uneven += check_stationarity(fit(wave.X(seed), y)).uneven;
  }
  EXPECT_LE(uneven, 2);
}

// A formula without noise is uneven in its last digits, which matter to nobody.
TEST(Stationarity, SmallErrorsAreLeftAlone) {
  const Stationarity s = check_stationarity(Wave{.noise = 0}.fitted(1));
  EXPECT_LT(s.error_share, 0.05);
  EXPECT_FALSE(s.uneven);
  EXPECT_EQ(s.p_value, 1);
}

TEST(Stationarity, NeedsTwentyRunsThatDiffer) {
  EXPECT_FALSE(check_stationarity(Wave{.step = 5, .runs = 19}.fitted(1)).uneven);
  const Eigen::MatrixXd X = Wave{}.X(1);
  EXPECT_FALSE(check_stationarity(fit(X, Eigen::VectorXd::Constant(60, 3.0))).uneven);
}

// R⁻¹ − R⁻¹F(FᵀR⁻¹F)⁻¹FᵀR⁻¹ by its definition: condition of R times round-off.
TEST(Stationarity, ProjectsAsTheDefinitionSays) {
  const Model model = Wave{.runs = 25}.fitted(4);
  const detail::ModelState& s = model.state();
  const Eigen::MatrixXd R = s.L * s.L.transpose(), inverse = R.inverse();
  const Eigen::MatrixXd G = s.F.transpose() * inverse * s.F;
  const Eigen::MatrixXd P = inverse - inverse * s.F * G.inverse() * s.F.transpose() * inverse;
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(25, -1, 2).array().sin();
  const double tolerance = 1e-15 * 25 * model.report().condition * (P * v).norm();
  EXPECT_NEAR((detail::without_trend(s, v) - P * v).norm(), 0, tolerance);
}

TEST(Stationarity, BadOptionsAreNamed) {
  const Model model = Wave{}.fitted(1);
  const auto text = [&](const StationarityOptions& options) {
    return support::told([&] { check_stationarity(model, options); });
  };
  EXPECT_EQ(
      text({.simulations = 98}),
      "kriging::check_stationarity: simulations is 98; allowed is 99 or more; 399 tell a chance of 0.01");
  EXPECT_EQ(text({.level = 0.001}),
            "kriging::check_stationarity: level is 0.001; allowed is 0.005 to 1 with so many simulations");
  EXPECT_EQ(text({.matters = 2}), "kriging::check_stationarity: matters is 2; allowed is 0 to 1");
}

// Twenty runs in a row along the first input, four errors of 2 among ones of 1: m = 4, w = 4, v = 1,
// u = 32/20; no square is above four times that.
TEST(ErrorScan, FindsTheWindowOfLargeErrors) {
  Eigen::MatrixXd X(20, 2);
  for (Eigen::Index i = 0; i < 20; ++i) {
    X(i, 0) = static_cast<double>(i);
    X(i, 1) = static_cast<double>((7 * i) % 20);
  }
  Eigen::VectorXd squares = Eigen::VectorXd::Ones(20);
  squares.segment(5, 4).setConstant(4);
  const detail::ErrorWindow window = detail::ErrorScan(X).widest_errors(squares);
  EXPECT_EQ(window.input, 0);
  EXPECT_EQ(window.from, 5);
  EXPECT_EQ(window.to, 8);
  EXPECT_NEAR(window.ratio, -0.5 * (4 * std::log(4 / 1.6) + 16 * std::log(1 / 1.6)), 1e-13);
  EXPECT_EQ(detail::ErrorScan(X).widest_errors(Eigen::VectorXd::Ones(20)).input, -1);
}

// On a line the two nearest of a run are those on both sides, at the ends the next two. Large errors side by
// side: of runs 5 and 6 one neighbour of two differs, so with g = ±c I = (12 − 1 − 1)/12. Every other error
// large: both differ but at the ends, where one does: I = (−10 + 0 + 0)/12.
TEST(ErrorScan, NeighboursAlike) {
  Eigen::MatrixXd X(12, 1);
  for (Eigen::Index i = 0; i < 12; ++i) X(i, 0) = static_cast<double>(i);
  Eigen::VectorXd together = Eigen::VectorXd::Ones(12), apart = together;
  together.tail(6).setConstant(4);
  for (Eigen::Index i = 0; i < 12; i += 2) apart[i] = 4;
  const detail::ErrorScan scan(X);
  EXPECT_NEAR(scan.neighbours_alike(together), 10.0 / 12, 1e-12);
  EXPECT_NEAR(scan.neighbours_alike(apart), -10.0 / 12, 1e-12);
}

}  // namespace
