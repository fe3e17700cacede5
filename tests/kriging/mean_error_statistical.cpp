// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// How often the interval of 95 % of the mean error holds the error of a model over the box, which is known
/// here: the model is that of 30 exact runs, and its validation runs are noisy.

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/kriging/fit.hpp>
#include <drawpoint/kriging/mean_error.hpp>
#include <drawpoint/kriging/validate.hpp>
#include <drawpoint/tests/kriging/test_functions.hpp>
#include <string>

using namespace drawpoint;
using namespace drawpoint::kriging;

namespace {

constexpr int sets = 250, samples = 5;

doe::Problem box(int d) {
  doe::Problem problem{.variables = {}, .responses = {{"y", "1", doe::Goal::minimize}}};
  for (int k = 0; k < d; ++k) problem.variables.push_back({"x" + std::to_string(k), "1", 0.0, 1.0});
  return problem;
}

Eigen::VectorXd values(const Eigen::MatrixXd& X) {
  Eigen::VectorXd y(X.rows());
  for (Eigen::Index i = 0; i < X.rows(); ++i) y[i] = reference::friedman5(X.row(i));
  return y;
}

struct Case {
  Model model;
  double truth;  ///< root mean square error of the model over the box
};

const Case& example() {
  static const Case made = [] {
    const Eigen::MatrixXd X = doe::latin_hypercube(box(5), 30, {.seed = 3});
    Model model = fit(X, values(X));
    const Eigen::MatrixXd U = doe::uniform_random(box(5), 20000, {.seed = 5});
    const double truth = std::sqrt((model.mean(U) - values(U)).squaredNorm() / 20000);
    return Case{std::move(model), truth};
  }();
  return made;
}

/// Mean of samples with noise, and the variance of that mean as they report it.
struct NoisyRuns {
  Eigen::VectorXd y, variance;
};

NoisyRuns noisy(Eigen::VectorXd y, double deviation, doe::RandomStream& random) {
  NoisyRuns runs{std::move(y), {}};
  runs.variance.resize(runs.y.size());
  for (Eigen::Index i = 0; i < runs.y.size(); ++i) {
    Eigen::VectorXd sample(samples);
    for (double& value : sample) value = deviation * std::sqrt(samples) * random.normal();
    runs.y[i] += sample.mean();
    runs.variance[i] = (sample.array() - sample.mean()).square().sum() / (samples - 1) / samples;
  }
  return runs;
}

/// Share of sets of n validation runs whose interval holds the truth.
double held(int n, double noise, bool reported) {
  const Case& known = example();
  int count = 0;
  for (doe::Seed set = 1; set <= sets; ++set) {
    const Eigen::MatrixXd X = doe::uniform_random(box(5), n, {.seed = 1000 + set});
    doe::RandomStream random(set);
    const double deviation = noise * known.truth;
    const NoisyRuns runs = noisy(values(X), deviation, random);
    const Validation v =
        validate(known.model, X, runs.y, Eigen::VectorXd::Constant(n, deviation * deviation));
    const MeanError error = mean_error(v, reported ? reported_noise(runs.variance) : modelled_noise(v, 1e6));
    count += error.lower <= known.truth && known.truth <= error.upper;
  }
  return count / static_cast<double>(sets);
}

}  // namespace

// Of 1000 sets per case another program of the same functions saw 0.936 to 0.987 hold here, 0.95 to 0.98 on
// borehole8 and 0.90 to 0.98 on saturating4, whose errors have the longest tails and whose noise is least. 250
// sets know 0.936 to 0.0155; three of that below it are 0.889. More than 0.99 would be an interval too wide to
// be of use only where noise is small: where it leads, the lower end is 0 and half of the misses are gone.
TEST(MeanErrorInterval, HoldsTheErrorOfTheMean) {
  for (const int n : {12, 40, 100})
    for (const double noise : {0.3, 1.0, 3.0})
      for (const bool reported : {false, true})
        EXPECT_GE(held(n, noise, reported), 0.889)
            << n << " runs, noise " << noise << " of the error" << (reported ? ", as runs report it" : "");
}

// Without noise to leave out the ends miss alike, and 95 % is what they hold.
TEST(MeanErrorInterval, IsNoWiderThanItMustBe) {
  for (const int n : {12, 40, 100}) EXPECT_LE(held(n, 0.3, true), 0.985) << n;
}
