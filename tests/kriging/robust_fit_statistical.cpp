// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// Where the highest likelihood is not the best predictor: designs with many corners, and pure noise.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/polynomial.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/corner_design.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <drawpoint/tests/support/median.hpp>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::kriging;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using support::median;

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
