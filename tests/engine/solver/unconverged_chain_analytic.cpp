// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What too few iterations do to a chain of contacts: a warm-started iteration is a spring without damping.
// The derivation is in docs/explanation/contact-solving.md.
#include <gtest/gtest.h>

#include <drawpoint/engine/solver/momentum.h>
#include <cmath>
#include <drawpoint/engine/solver/solver.hpp>

using namespace drawpoint::engine;
using Eigen::Vector3d;

namespace {

constexpr double light = 1, heavy = 1000, g = 9.81, kick = -0.01;

// The heavy body on the light one on the floor, carried by their start impulses; the heavy one sinks at
// 0.01 m/s. The damping time takes position and stiffness out of the law: it only asks for u_n ≥ 0.
ContactProblem chain(double time) {
  ContactProblem problem;
  problem.step = time;
  problem.bodies.resize(3);
  for (int k = 1; k <= 2; ++k) {
    problem.bodies[k].inverse_mass = 1 / (k == 1 ? light : heavy);
    problem.bodies[k].inverse_inertia = Eigen::Matrix3d::Identity();
    problem.bodies[k].external_velocity_change = Vector3d(0, 0, -g * time);
    ContactPair pair;
    pair.a = k - 1;
    pair.b = k;
    pair.first = k - 1;
    pair.count = 1;
    problem.pairs.push_back(pair);
    ContactPoint point;
    point.position = point.arm_a = point.arm_b = Vector3d::Zero();
    point.normal = Vector3d::UnitZ();
    point.gap = -0.1;
    point.damping_time = 1e12;
    point.start = Vector3d(0, 0, (k == 1 ? light + heavy : heavy) * g * time);  // S times a substep's share
    problem.points.push_back(point);
  }
  problem.bodies[2].velocity.z() = kick;
  return problem;
}

}  // namespace

// What the iterations of a substep do, in units of a lone one, where each does so little that the next finds the same
// to do: every iteration adds 1, and momentum β of what was added since the last iteration that had it.
double work_of(int iterations) {
  double done = 0, then = 0;
  for (int k = 0; k < iterations; ++k) {
    if (detail::remembers(k)) {
      const double momentum = detail::momentum_of(k) * (done - then);
      then = done;
      done += momentum;
    }
    done += 1;
  }
  return done;
}

// The heavy body swings on the spring k = N m_eff / h_s², N the work of a substep of h_s, m_eff = m M / (m + M): after
// a quarter of its period it has sunk by v / ω, ω² = k / M, and stands. Substeps resolve the swing to ω h_s, and the
// light body takes m / M of the motion; so much less, relatively, is also left to do for each iteration that follows.
TEST(UnconvergedChain, IsASpringWithoutDamping) {
  const double effective = light * heavy / (light + heavy);
  for (const double h : {1e-2 / 4, 1e-2 / 16})
    for (const int iterations : {1, 2, 4}) {
      const double omega = std::sqrt(work_of(iterations) * effective / heavy) / h;
      const int substeps = static_cast<int>(std::lround(M_PI / 2 / omega / h));
      ContactProblem problem = chain(substeps * h);
      solve(problem, {.method = Method::sequential,
                      .substeps = substeps,
                      .iterations = iterations,
                      .iteration_budget = 0});
      const double tolerance = omega * h + light / heavy;
      EXPECT_NEAR(problem.bodies[2].displacement.z() / (kick / omega), 1, tolerance)
          << h << " s, " << iterations;
      EXPECT_LT(std::abs(problem.bodies[2].velocity.z() / kick), 2 * tolerance);
    }
}

// Enough iterations hold the chain: the error falls by m_eff / m per iteration, 1/1001 of it
// left over, so some 5000 iterations stop the heavy body within a substep, however few.
TEST(UnconvergedChain, StandsWithEnoughIterations) {
  ContactProblem problem = chain(0.02);
  solve(problem, {.method = Method::sequential, .substeps = 2, .iterations = 20000, .iteration_budget = 0});
  EXPECT_LT(std::abs(problem.bodies[2].velocity.z()), 1e-6);
}
