// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Where the highest likelihood is not the best predictor: designs with many corners, and pure noise.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/polynomial.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/corner_design.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <drawpoint/tests/kriging/wide_functions.hpp>
#include <string>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

FitOptions likeliest() {
  FitOptions options;
  options.estimation = Estimation::maximum_likelihood;
  return options;
}

VectorXd noise(Eigen::Index count, doe::Seed seed) {
  doe::RandomStream random(seed);
  VectorXd z(count);
  for (double& value : z) value = random.normal();
  return z;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// Of 11 fits to 100 runs of unit normal noise: medians of the noise found and of the mean's error.
struct Found {
  double noise, error;
};

Found of_pure_noise(int variables, const FitOptions& options) {
  std::vector<double> found, error;
  for (doe::Seed seed = 1; seed <= 11; ++seed) {
    const MatrixXd X = reference::design(100, variables, seed),
                   Z = reference::design(200, variables, 50 + seed);
    const Model model = fit(X, noise(100, 100 + seed), options);
    found.push_back(std::sqrt(model.noise_variance()));
    error.push_back(std::sqrt(model.mean(Z).squaredNorm() / 200));
  }
  return {median(found), median(error)};
}

}  // namespace

// 60 runs of which 32 are corners. Friedman's function is a sine, a square and two lines: a model worth its
// name beats the least-squares quadratic of the same runs. The highest likelihood does not, in most of these
// designs.
TEST(DefaultFit, IsNotMisledByCorners) {
  const MatrixXd Z = reference::design(1000, 5, 999);
  const VectorXd z = reference::values(reference::friedman5, Z);
  int misled = 0;
  for (doe::Seed seed = 1; seed <= 5; ++seed) {
    const MatrixXd X = reference::corner_design(seed);
    const VectorXd y = reference::values(reference::friedman5, X);
    const double quadratic = validate(fit_polynomial(X, y), Z, z).nrmse;
    EXPECT_LT(validate(fit(X, y), Z, z).nrmse, quadratic) << "seed " << seed;
    if (validate(fit(X, y, likeliest()), Z, z).nrmse > quadratic) ++misled;
  }
  EXPECT_GE(misled, 3) << "the designs no longer show what this test is about";
}

// The noise of 100 runs is known to 1/√200 = 0.07 of itself at best, the mean to 1/√100 = 0.1 as a constant
// and to √(d + 1)/10 as a plane: a fit that explains no noise stays below these, twice the first for the
// median of 11.
TEST(DefaultFit, SaysThatNoiseIsNoise) {
  for (const int variables : {4, 10}) {
    const Found found = of_pure_noise(variables, {});
    EXPECT_GT(found.noise, 0.86) << variables;
    EXPECT_LT(found.error, 0.1 * std::sqrt(variables + 1.0)) << variables;
  }
  EXPECT_LT(of_pure_noise(4, likeliest()).noise, 0.5) << "plain maximum likelihood no longer shows the fault";
}

// 40 runs of draws of the process that a fit takes for granted, deviation 1, with noise of 0.05. Runs so far
// apart can hardly tell it from a rough response: without a power of λ in the prior most of eleven fits find
// less than a tenth of it. With one, what is found scatters by a deviation of some 0.35 in its logarithm:
// within three of these, a factor of 3, lie all eleven.
TEST(DefaultFit, FindsNoiseThatFewRunsHide) {
  int unseen = 0;
  for (doe::Seed seed = 1; seed <= 11; ++seed) {
    const MatrixXd X = reference::design(40, 4, seed);
    const VectorXd y = reference::values([&](const VectorXd& x) { return reference::process4(x, seed); }, X) +
                       0.05 * noise(40, 200 + seed);
    FitOptions none;
    none.nugget_power = 0;
    if (fit(X, y, none).noise_variance() < std::pow(0.1 * 0.05, 2)) ++unseen;
    const double found = std::sqrt(fit(X, y).noise_variance());
    EXPECT_GT(found, 0.05 / 3) << "seed " << seed;
    EXPECT_LT(found, 0.05 * 3) << "seed " << seed;
  }
  EXPECT_GE(unseen, 6) << "the designs no longer show what this test is about";
}

namespace {

/// A random Latin hypercube on [0, 1]^d.
MatrixXd random_cube(int n, int d, doe::Seed seed) {
  doe::Problem box;
  for (int k = 0; k < d; ++k) box.variables.push_back({"x" + std::to_string(k), "1", 0.0, 1.0});
  box.responses = {{.name = "y", .unit = "1"}};
  return doe::latin_hypercube(box, n, {.seed = seed});
}

}  // namespace

// A robot's arm of four joints, rough in its angles, whose 120 exact runs pass for noisy ones. Told that there is no noise,
// the fit meets the runs, its 95 % intervals hold 90 to 97 % of 4000 places of eight designs (93; one design scatters by 2), and its error is that of the likeliest fit.
TEST(ExactRuns, AreMetAndLeaveIntervalsThatHold) {
  double of_exact = 0, of_likeliest = 0;
  int held = 0;
  for (doe::Seed seed = 1; seed <= 8; ++seed) {
    const MatrixXd X = reference::design(120, 8, seed), Z = reference::design(500, 8, 50 + seed);
    const VectorXd y = reference::values(reference::robot_arm, X),
                   truth = reference::values(reference::robot_arm, Z);
    FitOptions options;
    options.noise = Noise::none;
    const Model exact = fit(X, y, options);
    EXPECT_LE(exact.nugget(), 1e-6);
    EXPECT_LT((exact.mean(X) - y).cwiseAbs().maxCoeff(), 1e-3);
    const Prediction p = exact.predict(Z);
    of_exact += (p.mean - truth).squaredNorm();
    of_likeliest += (fit(X, y, likeliest()).mean(Z) - truth).squaredNorm();
    held += static_cast<int>(((p.mean - truth).array().abs() <= 1.96 * p.variance.array().sqrt()).count());
  }
  EXPECT_GE(held, 0.90 * 4000);
  EXPECT_LE(held, 0.97 * 4000);
  EXPECT_LT(of_exact, 1.05 * of_likeliest);
}

// The default finds that out by itself where the likelihood leaves no doubt: intervals of the arm hold 88 % of the places
// at least, 93 less three of the 2 that a design scatters by over √8, and less what is lost where one of eight designs is
// taken for noisy; its error is at most that of the likeliest fit.
TEST(ExactRuns, AreFoundByTheDefault) {
  double of_default = 0, of_likeliest = 0;
  int held = 0, exact = 0;
  for (doe::Seed seed = 1; seed <= 8; ++seed) {
    const MatrixXd X = random_cube(120, 8, seed);
    const MatrixXd Z = reference::design(500, 8, 50 + seed);
    const VectorXd y = reference::values(reference::robot_arm, X),
                   truth = reference::values(reference::robot_arm, Z);
    const Model model = fit(X, y);
    exact += model.nugget() <= 1e-6;
    const Prediction p = model.predict(Z);
    of_default += (p.mean - truth).squaredNorm();
    of_likeliest += (fit(X, y, likeliest()).mean(Z) - truth).squaredNorm();
    held += static_cast<int>(((p.mean - truth).array().abs() <= 1.96 * p.variance.array().sqrt()).count());
    if (model.nugget() <= 1e-6) {
      EXPECT_NE(model.message().find("times as likely without noise"), std::string::npos);
    }
  }
  EXPECT_GE(exact, 7);
  EXPECT_GE(held, 0.88 * 4000);
  EXPECT_LE(of_default, 1.02 * of_likeliest);
}

// The other side: of 60 responses of nothing but noise none passes for exact, nor do smooth ones with noise of a tenth.
// One of a thousand of the former is expected to.
TEST(ExactRuns, AreNotSeenInNoise) {
  for (doe::Seed seed = 1; seed <= 60; ++seed) {
    doe::RandomStream random(seed);
    const MatrixXd X = reference::design(40, 4, seed);
    VectorXd noise(40);
    for (double& value : noise) value = random.normal();
    EXPECT_GT(fit(X, noise).nugget(), 1e-6) << seed;
    if (seed > 20) continue;
    const VectorXd y = reference::values(reference::noisy4, X) / 5 + 0.1 * noise;
    EXPECT_GT(fit(X, y).nugget(), 1e-6) << seed;
  }
}
