// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/kriging/detail/likelihood.hpp>
#include <drawpoint/tests/kriging/reference_cases.hpp>

using namespace drawpoint::kriging;
using Eigen::VectorXd;

namespace {

// β = 1 and 2, λ = 0.5.
VectorXd parameters() { return Eigen::Vector3d(std::log(0.25), 0.0, std::log(0.5)); }

}  // namespace

// 16 runs in two inputs lie c = 1/4 apart, b = 2.2/4: t = (1 + 2)/4 + 0.5. A handful of operations: 1e-14.
TEST(JointlyRobustPrior, IsThePublishedOne) {
  const detail::JointlyRobustPrior prior(16, {true, true}, true, 0), known(16, {true, true}, false, 0);
  EXPECT_NEAR(prior.value(parameters()), 0.2 * std::log(1.25) - 0.55 * 1.25, 1e-14);
  EXPECT_NEAR(known.value(parameters()), 0.2 * std::log(0.75) - 0.55 * 0.75, 1e-14);
}

// e ln λ on top, where λ is estimated.
TEST(JointlyRobustPrior, ExpectsNoise) {
  const detail::JointlyRobustPrior plain(16, {true, true}, true, 0), half(16, {true, true}, true, 0.5),
      known(16, {true, true}, false, 0.5), known_plain(16, {true, true}, false, 0);
  EXPECT_NEAR(half.value(parameters()), plain.value(parameters()) + 0.5 * std::log(0.5), 1e-14);
  EXPECT_EQ(known.value(parameters()), known_plain.value(parameters()));
}

// Beside it an input that never varies: neither the runs' distance nor the rate knows of it.
TEST(JointlyRobustPrior, CountsInputsThatVary) {
  const detail::JointlyRobustPrior two(16, {true, true, false}, true, 0);
  const VectorXd p = Eigen::Vector4d(std::log(0.25), 0.0, 2.0, std::log(0.5));
  EXPECT_NEAR(two.value(p), 0.2 * std::log(1.25) - 0.55 * 1.25, 1e-14);
}

// The value of a likelihood with the prior is the sum; the estimates keep the likelihood itself.
TEST(JointlyRobustPrior, IsAddedToTheLikelihood) {
  LikelihoodProblem problem;
  problem.X = 2.0 * reference::design(16, 2, 3).array() - 1.0;
  problem.y = problem.X.col(0).array().sin() + problem.X.col(1).array().square();
  Likelihood plain(problem);
  problem.prior = true;
  Likelihood with(problem);
  const detail::JointlyRobustPrior prior(16, {true, true}, true, 0);
  EXPECT_EQ(with.value(parameters()), plain.value(parameters()) + prior.value(parameters()));
  EXPECT_EQ(with.estimates().log_likelihood, plain.value(parameters()));
}

// One θ of both inputs: 16 runs lie √2/4 apart, b = 1.2/4; β = 1: t = √2/4 + 0.5. Beside an input that never
// varies the same.
TEST(JointlyRobustPrior, OfOneThetaIsThatOfOneNumber) {
  CorrelationFunction f;
  f.structure = Structure::isotropic;
  const double t = std::sqrt(2.0) / 4.0 + 0.5;
  for (const bool third : {false, true}) {
    const std::vector<bool> inputs =
        third ? std::vector<bool>{true, true, false} : std::vector<bool>{true, true};
    const auto d = static_cast<Eigen::Index>(inputs.size());
    const detail::ParameterPlaces places = detail::parameter_places(f, d, false);
    const detail::JointlyRobustPrior prior(detail::spacing_of(f, places, 16, inputs), true, 0);
    EXPECT_NEAR(prior.value(Eigen::Vector2d(std::log(0.25), std::log(0.5))), 0.2 * std::log(t) - 0.3 * t,
                1e-14);
  }
}

// Two functions share 16 runs: c² = 2/16, b = 2.2c, t = 3c + 0.5.
TEST(JointlyRobustPrior, OfASumSharesTheRuns) {
  CorrelationFunction f;
  f.structure = Structure::additive;
  const detail::ParameterPlaces places = detail::parameter_places(f, 2, false);
  const detail::JointlyRobustPrior prior(detail::spacing_of(f, places, 16, {true, true}), true, 0);
  VectorXd p(5);
  p << std::log(0.25), 0.0, 0.3, -0.3, std::log(0.5);
  const double c = std::sqrt(2.0 / 16.0), t = 3.0 * c + 0.5;
  EXPECT_NEAR(prior.value(p), 0.2 * std::log(t) - 2.2 * c * t, 1e-14);
}

// v = (1, 2, unused, −2): −½ · 9/4, and −½ · (1/3)/4 of Σv alone; both slopes by hand.
TEST(WeightPrior, IsNormalOrHoldsTheSumAlone) {
  const std::vector<bool> inputs{true, true, false, true};
  const detail::WeightPrior whole(1, inputs, true), held(1, inputs, false);
  VectorXd p(6), g = VectorXd::Zero(6), h = VectorXd::Zero(6);
  p << 9, 1, 2, 9, -2, 9;
  EXPECT_NEAR(whole.value(p), -9.0 / 8.0, 1e-15);
  EXPECT_NEAR(held.value(p), -1.0 / 24.0, 1e-15);
  whole.add_gradient(p, g);
  held.add_gradient(p, h);
  EXPECT_LT((g - (VectorXd(6) << 0, -0.25, -0.5, 0, 0.5, 0).finished()).norm(), 1e-15);
  EXPECT_LT((h - (VectorXd(6) << 0, -1, -1, 0, -1, 0).finished() / 12.0).norm(), 1e-15);
}
