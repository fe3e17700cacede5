// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The residual is zero at solutions, has the value that a known error gives it, and falls as iterations add
// up.
#include <gtest/gtest.h>

#include <drawpoint/engine/solver/residual.hpp>
#include <drawpoint/engine/solver/solution_distance.hpp>
#include <drawpoint/engine/solver/solver.hpp>
#include <drawpoint/tests/support/contact_problems.hpp>

using namespace drawpoint;
using namespace drawpoint::engine;
using Eigen::Vector3d;

namespace {

// Round-off of some dozens of operations on numbers of one size.
constexpr double round_off = 1e-13;
constexpr double mass = 50, inertia = 0.5, friction = 0.6, arm = 0.1;

// A body that meets the floor with a point at its own centre, so that the normal, the friction and the moment
// are three problems apart, each solved by one iteration. It sinks fast (an impact: no damping in its
// target), slides and spins fast enough to reach the limits of friction and of the moment.
ContactProblem landing() {
  ContactProblem problem;
  problem.step = 0.01;
  problem.bodies.resize(2);
  problem.bodies[1].inverse_mass = 1 / mass;
  problem.bodies[1].inverse_inertia = Eigen::Matrix3d::Identity() / inertia;
  problem.bodies[1].velocity = Vector3d(3, 4, -1);
  problem.bodies[1].angular_velocity = Vector3d(0, 0, 100);
  problem.bodies[1].external_velocity_change = Vector3d(0, 0, -0.0981);
  ContactPoint point;
  point.position = point.arm_a = point.arm_b = Vector3d::Zero();
  point.normal = Vector3d::UnitZ();
  point.gap = -1e-3;
  point.stiffness = 1e6;
  point.friction = friction;
  problem.points = {point};
  ContactPair pair;
  pair.b = pair.count = 1;
  pair.spinning_arm = arm;
  problem.pairs = {pair};
  return problem;
}

// Changes the point's impulse and what the body has of it.
void change_impulse(ContactProblem& problem, const Vector3d& delta) {
  problem.points[0].impulse += delta;
  problem.points[0].start += delta;
  problem.bodies[1].velocity += delta / mass;
  problem.bodies[1].displacement += problem.step * delta / mass;
}

SolverReport reference(ContactProblem& problem, int substeps, int iterations) {
  return solve(
      problem,
      {.method = Method::sequential, .substeps = substeps, .iterations = iterations, .iteration_budget = 0});
}

double contacts_after(ContactProblem problem, int substeps, int iterations) {
  const SolverReport report = reference(problem, substeps, iterations);
  return residual(problem, report.machine, substeps).contacts();
}

}  // namespace

TEST(Residual, IsZeroWhereAnIterationSolvesExactly) {
  for (const int substeps : {1, 2, 5}) {
    ContactProblem problem = landing();
    const SolverReport report = reference(problem, substeps, 2);
    ASSERT_GT(problem.points[0].start.z(), 0);
    const Residual r = residual(problem, report.machine, substeps);
    EXPECT_LT(r.complementarity, round_off);
    EXPECT_LT(r.cone, round_off);
    EXPECT_LT(r.moments, 1e-12);  // over an arm of 0.1 m, from 100 rad/s
  }
}

// All impulses missing: the natural map asks for the whole load.
TEST(Residual, IsOneWithoutImpulses) {
  ContactProblem problem = landing();
  EXPECT_DOUBLE_EQ(residual(problem, {}, 1).complementarity, 1);
}

TEST(Residual, IsZeroWithoutLoad) {
  ContactProblem problem = landing();
  problem.bodies[1] = SolverBody();
  problem.points[0].gap = 1;
  EXPECT_EQ(residual(problem, {}, 1).contacts(), 0);
}

// λ(1 + ε) with its velocity: the natural map leads back to λ, so the residual is ε / (1 + ε).
TEST(Residual, MeasuresAnErrorOfTheNormal) {
  constexpr double error = 0.01;
  ContactProblem problem = landing();
  problem.points[0].friction = problem.pairs[0].spinning_arm = 0;
  reference(problem, 1, 2);
  const double normal = problem.points[0].impulse.z();
  change_impulse(problem, {0, 0, error * normal});
  // The stepper's damping and compliance move the map's target by what they moved at first, and back.
  const double sigma = 4 / (0.01 * 0.01 * 1e6 * 9);
  EXPECT_GT(sigma * mass, 1e-3);
  EXPECT_NEAR(residual(problem, {}, 1).complementarity, error / (1 + error), round_off);
}

// Friction turned by φ on its cone, with its velocity: the map leads back to the true one, a chord of
// 2 μ λ_n sin(φ/2) away.
TEST(Residual, MeasuresATurnOfFriction) {
  for (const double turn : {0.05, 1.0, 3.0}) {
    ContactProblem problem = landing();
    reference(problem, 1, 2);
    const Vector3d impulse = problem.points[0].impulse;
    ASSERT_NEAR(impulse.head<2>().norm(), friction * impulse.z(), 1e-9);
    const Vector3d turned = Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * impulse;
    change_impulse(problem, turned - impulse);
    const Residual r = residual(problem, {}, 1);
    EXPECT_NEAR(r.cone, 2 * friction * std::sin(turn / 2), 1e-12);
    EXPECT_LT(r.complementarity, round_off);
  }
}

// A contact that pulls has no cone: whatever friction it has is wrong, μ λ of the load λ to which the map leads back.
TEST(Residual, LeavesNoFrictionToAContactThatPulls) {
  for (const double pull : {0.1, 2.0}) {
    ContactProblem problem = landing();
    reference(problem, 1, 2);
    change_impulse(problem, {0, 0, -(1 + pull) * problem.points[0].impulse.z()});
    ASSERT_LT(problem.points[0].impulse.z(), 0);
    const Residual r = residual(problem, {}, 1);
    EXPECT_NEAR(r.cone, friction, 1e-12);
    EXPECT_NEAR(r.complementarity, 1 + pull, 1e-12);
  }
}

// A spinning moment short of its limit by a share ε: ε Λ a over the arm a, relative to Λ.
TEST(Residual, MeasuresAnErrorOfTheMoment) {
  constexpr double error = 0.03;
  ContactProblem problem = landing();
  reference(problem, 1, 2);
  const Vector3d delta = -error * problem.pairs[0].impulse;
  problem.pairs[0].impulse += delta;
  problem.pairs[0].start += delta;
  problem.bodies[1].angular_velocity += delta / inertia;
  EXPECT_NEAR(residual(problem, {}, 1).moments, error, 1e-12);
}

// Gauss-Seidel converges linearly once sticking and sliding are settled, and slowly where boxes rest on
// several corners. The first few iterations may overshoot: they have momentum. From sixteen on the residual falls
// between rungs of four times the iterations; at the end it has fallen by five powers of ten and more. Below 1e-8 only
// the slowest modes are left, which need not show over one rung.
TEST(Residual, FallsWithIterations) {
  const ContactProblem unsolved = support::heap_of_boxes();
  ASSERT_GT(unsolved.points.size(), 20u);
  for (const int substeps : {1, 4}) {
    double last = contacts_after(unsolved, substeps, 1);
    const double first = last;
    EXPECT_GT(first, 1e-6);
    for (int iterations = 16; iterations <= 16384; iterations *= 4) {
      const double now = contacts_after(unsolved, substeps, iterations);
      EXPECT_LT(now, std::max(last, 1e-8)) << substeps << " substeps, " << iterations << " iterations";
      last = now;
    }
    EXPECT_LT(last, 1e-5 * first);
  }
}

TEST(Distance, FallsWithIterationsAndIsZeroToItself) {
  const ContactProblem unsolved = support::heap_of_boxes();
  ContactProblem converged = unsolved;
  const SolverReport best = reference(converged, 1, 10000);
  EXPECT_EQ(distance(converged, best.machine, converged, best.machine).impulses, 0);
  double last = 10;
  for (const int iterations : {1, 10, 100, 1000}) {
    ContactProblem problem = unsolved;
    const SolverReport report = reference(problem, 1, iterations);
    const Distance d = distance(problem, report.machine, converged, best.machine);
    EXPECT_LT(d.velocities, last);
    EXPECT_GE(d.velocities, 0);
    last = d.velocities;
  }
  EXPECT_LT(last, 1e-3);
}

// Double precision adds up a few hundred impulses per body.
TEST(MomentumDefect, IsRoundOffForTheReferenceAndSeesALostImpulse) {
  const ContactProblem unsolved = support::heap_of_boxes();
  ContactProblem problem = unsolved;
  const SolverReport report = reference(problem, 4, 20);
  EXPECT_LT(momentum_defect(unsolved, problem, report.machine), 1e-12);
  for (ContactPoint& point : problem.points) point.impulse *= 0.5;
  EXPECT_GT(momentum_defect(unsolved, problem, report.machine), 0.5);
}
