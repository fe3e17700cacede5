// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <drawpoint/kriging/fit_fidelities.hpp>
#include <drawpoint/tests/kriging/fidelity_functions.hpp>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const MatrixXd cheap_places = VectorXd::LinSpaced(14, 0, 1), many_points = VectorXd::LinSpaced(41, 0, 1);

double waves(const VectorXd& x) { return std::sin(8 * x[0]) * x[0] + x[0]; }
double line(const VectorXd& x) { return x[0]; }

FidelityLevel cheap_level(const reference::Function& f) {
  return {"rough", cheap_places, reference::values(f, cheap_places)};
}

FidelityLevel true_level(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  return {"fine", Eigen::Map<const VectorXd>(x.data(), n), Eigen::Map<const VectorXd>(y.data(), n)};
}

std::string refused_for(const std::vector<FidelityLevel>& levels) {
  try {
    fit_fidelities(levels);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

void expect_finite(const FidelityModel& model, const std::string& what) {
  const Prediction p = model.predict(many_points, Target::observation);
  EXPECT_TRUE(p.mean.allFinite() && p.variance.allFinite()) << what;
  EXPECT_TRUE(model.gradient(VectorXd::Constant(1, 0.37)).variance.allFinite()) << what;
}

}  // namespace

// True runs that are twice the cheap mean and one: step 1 ends in the trend alone, without a spread of its
// parameters. Coefficients that meet all runs are found by any weights. What R⁻¹ makes of the round-off ε of
// a run, kᵀR⁻¹ε <= √R(x, x) |ε|/√(least eigenvalue), is below |ε|/√1e-16, since R could be factored:
// 4e-16 · 3/1e-8 √5 = 3e-7.
TEST(CokrigingLimits, ATrendThatMeetsAllRunsIsTheModel) {
  for (const Correlation correlation : {Correlation::gaussian, Correlation::power_exponential}) {
    std::vector<FidelityLevel> levels{cheap_level(waves),
                                      true_level({0, 0.2, 0.45, 0.7, 1}, {1, 2, 4, 3, 5})};
    levels[1].options.correlation = correlation;
    const FidelityModel below = fit_fidelities(levels, {.compare = false}).lower_levels(1);
    for (Eigen::Index i = 0; i < levels[1].y.size(); ++i)
      levels[1].y[i] = 2 * below(levels[1].X.row(i).transpose()) + 1;
    const FidelityModel model = fit_fidelities(levels);
    EXPECT_EQ(model.report().levels[1].fit.status, Status::exact_trend);
    expect_finite(model, "exact trend");
    const VectorXd expected = (2 * below.mean(many_points)).array() + 1;
    EXPECT_LT((model.mean(many_points) - expected).cwiseAbs().maxCoeff(), 3e-7);
    EXPECT_NEAR(model.report().levels[1].rho[0], 2, 3e-7);
  }
}

// Whatever the first step's fit ends in.
TEST(CokrigingLimits, EachStatusOfTheFirstStepIsAModelOrRefused) {
  const FidelityLevel rough = cheap_level(waves);
  FidelityLevel hurried = true_level({0, 0.2, 0.45, 0.7, 1}, {1, 3, 2, 5, 4});
  hurried.options.max_iterations = 1;
  expect_finite(fit_fidelities({rough, hurried}), "not converged");
  FidelityLevel singular = true_level({0.1, 0.1, 0.4, 0.4, 0.9, 0.9}, {1, 2, 3, 5, 4, 4.5});
  singular.options.nugget_lower = singular.options.nugget_upper = 1e-20;
  const FidelityModel model = fit_fidelities({rough, singular});
  EXPECT_EQ(model.report().levels[1].fit.status, Status::ill_conditioned);
  expect_finite(model, "ill conditioned");
  EXPECT_NE(refused_for({rough, true_level({0, 0.4, 1}, {2, 2, 2})}).find("all 3 responses equal 2"),
            std::string::npos)
      << "constant response";
  FidelityLevel wide = true_level({0, 0.4, 1}, {2, 3, 2});
  wide.options.trend = Trend::linear;
  EXPECT_NE(refused_for({rough, wide}).find("3 runs for 3 coefficients"), std::string::npos)
      << "too few runs";
  doe::RandomStream random(1);
  for (int n = 3; n < 7; ++n)
    for (int k = 0; k < 20; ++k) {
      std::vector<double> x, y;
      for (int i = 0; i < n; ++i) {
        x.push_back(random.uniform());
        y.push_back(k % 2 ? std::floor(3 * random.uniform()) : random.uniform());
      }
      y[0] += 1e-3;
      expect_finite(fit_fidelities({rough, true_level(x, y)}), std::to_string(n) + ", " + std::to_string(k));
    }
}

TEST(CokrigingLimits, TrueRunsAreCountedByTheirPlaces) {
  const std::string end =
      " for 2 coefficients of rho and the trend; allowed is 3 places or more; make runs at other places";
  const std::string place = "kriging::fit_fidelities: level \"fine\": ";
  const FidelityLevel rough = cheap_level(waves);
  EXPECT_EQ(refused_for({rough, true_level({0.5, 0.5, 0.5, 0.2}, {1, 1.1, 0.9, 3})}),
            place + "4 runs at 2 places" + end);
  EXPECT_EQ(refused_for({rough, true_level({0.2, 0.2, 0.2, 0.8}, {1, 1, 1, 2})}),
            place + "4 runs at 2 places" + end);
  EXPECT_EQ(refused_for({rough, true_level({0.2, 0.2, 0.8, 0.8}, {1, 1, 2, 2})}),
            place + "4 runs at 2 places" + end);
  EXPECT_EQ(refused_for({rough, true_level({0.2, 0.2, 0.8, 0.5}, {1, 1.1, 2, 3})}), "accepted");
}

// All that the cheap level says of these runs it says of the last one: without it they do not tell ρ.
TEST(CokrigingLimits, ARunThatAloneTellsRhoCannotBeScored) {
  const auto bump = [](const VectorXd& x) { return std::exp(-200 * std::pow(x[0] - 0.9, 2)); };
  const std::vector<FidelityLevel> flat{
      {"rough", VectorXd::LinSpaced(41, 0, 1), reference::values(bump, VectorXd::LinSpaced(41, 0, 1))},
      true_level({0.1, 0.2, 0.3, 0.4, 0.9}, {0.1, 0.3, 0.2, 0.4, 2})};
  const std::vector<FidelityLevel> near{
      cheap_level(waves), true_level({0.5, 0.5000001, 0.5000002, 0.5000003, 0.9}, {0.1, 0.3, 0.2, 0.4, 2})};
  for (const std::vector<FidelityLevel>& levels : {flat, near}) {
    const FidelityModel model = fit_fidelities(levels);
    ASSERT_EQ(model.report().levels[1].rho.size(), 1) << model.message();
    const Validation v = leave_one_out(model);
    EXPECT_TRUE(v.predicted.head(4).allFinite() && v.variance.head(4).allFinite());
    EXPECT_TRUE(std::isnan(v.predicted[4]) && std::isnan(v.variance[4]) &&
                std::isnan(v.observation_variance[4]));
    EXPECT_TRUE(std::isnan(model.report().comparison.rmse) && std::isnan(model.report().comparison.gain));
    EXPECT_TRUE(std::isfinite(model.report().comparison.rmse_alone));
    EXPECT_EQ(model.message().find("the true runs cannot tell whether the cheaper levels help: without one "),
              0u)
        << model.message();
    EXPECT_TRUE(choose_fidelities(levels).cokriging);
    expect_finite(model, "all runs");
  }
}

// A cheap level that is a line but for the error of its fit, below a true one with a linear trend: what the
// trend leaves of it is that error.
TEST(CokrigingLimits, RhoIsNotFittedToTheErrorOfTheLevelBelow) {
  const MatrixXd runs = VectorXd::LinSpaced(8, 0.03, 0.91);
  for (doe::Seed seed = 1; seed <= 10; ++seed) {
    doe::RandomStream random(seed);
    FidelityLevel truth{"fine", runs, 2 * runs.col(0)};
    for (double& value : truth.y) value += 0.1 * random.normal();
    truth.options.trend = Trend::linear;
    const FidelityModel model = fit_fidelities({cheap_level(line), truth});
    EXPECT_EQ(model.report().levels[1].rho.size(), 0) << model.message();
    EXPECT_NE(model.message().find("cannot be told from its trend"), std::string::npos) << model.message();
    // ρ that varies would bring x (m − c), a square: of a ρ without a value there is no slope.
    const FidelityModel varying = fit_fidelities({cheap_level(line), truth}, {.rho = Trend::linear});
    EXPECT_EQ(varying.report().levels[1].rho.size(), 0) << varying.message();
    expect_finite(varying, "varying");
  }
}

// Noise of the cheap runs alone: the line's error at the runs is what their model says it is.
TEST(CokrigingLimits, RhoIsNotFittedToTheNoiseOfTheLevelBelow) {
  FidelityLevel rough = cheap_level(line);
  doe::RandomStream random(3);
  for (double& value : rough.y) value += 0.05 * random.normal();
  FidelityLevel truth{"fine", VectorXd::LinSpaced(8, 0.03, 0.91), {}};
  truth.y = reference::values(waves, truth.X);
  truth.options.trend = Trend::linear;
  const FidelityModel model = fit_fidelities({rough, truth});
  EXPECT_EQ(model.report().levels[1].rho.size(), 0) << model.message();
}

// Waves of a tenth of the line's spread are a hundred times the bound, and seen well by 14 runs.
TEST(CokrigingLimits, RhoOfWeakWavesOnALineIsKept) {
  const auto weak = [](const VectorXd& x) { return x[0] + 0.05 * std::sin(9 * x[0]); };
  FidelityLevel truth{"fine", VectorXd::LinSpaced(8, 0.03, 0.91), {}};
  truth.y = 2 * reference::values(weak, truth.X);
  truth.options.trend = Trend::linear;
  const FidelityModel model = fit_fidelities({cheap_level(weak), truth}, {.compare = false});
  ASSERT_EQ(model.report().levels[1].rho.size(), 1) << model.message();
  EXPECT_NEAR(model.report().levels[1].rho[0], 2, 4 * model.report().levels[1].rho_standard_error[0] + 1e-6);
}

TEST(CokrigingLimits, TheCheapestLevelHasRunsToBeFittedTo) {
  const FidelityLevel truth = true_level({0, 0.22, 0.45, 0.7, 1}, {0, 1, 0.5, 0.2, 2});
  const auto of = [&](const MatrixXd& X) {
    return refused_for({{"rough", X, reference::values(waves, X)}, truth});
  };
  const std::string place = "kriging::fit_fidelities: level \"rough\": ",
                    end =
                        " for a Kriging model to build on; allowed at the cheapest level is variables + 3 = "
                        "4 places or more; "
                        "make more cheap runs, or use kriging::fit of the level above";
  EXPECT_EQ(of(VectorXd::LinSpaced(2, 0.1, 0.9)), place + "2 runs" + end);
  EXPECT_EQ(of(VectorXd::LinSpaced(3, 0.1, 0.9)), place + "3 runs" + end);
  EXPECT_EQ(of(Eigen::VectorXd(Eigen::Vector<double, 5>(0.1, 0.1, 0.5, 0.5, 0.9))),
            place + "5 runs at 3 places" + end);
  EXPECT_EQ(of(VectorXd::LinSpaced(4, 0.1, 0.9)), "accepted");
}
