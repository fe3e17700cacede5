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
