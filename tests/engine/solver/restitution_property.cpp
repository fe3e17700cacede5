// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Restitution gives back no more energy than it took, and all of Newton's law where friction lets it.
#include <gtest/gtest.h>

#include <cmath>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/engine/solver/solver.hpp>

using namespace drawpoint::engine;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

Vector3d any(CounterRandom& random, double size) {
  return size * (2 * Vector3d(random.uniform(), random.uniform(), random.uniform()) - Vector3d::Ones());
}

// A chain of bodies of any inertia, each in contact with the next at one point, the first with the world.
ContactProblem chain(CounterRandom& random, int bodies, double friction, double restitution) {
  ContactProblem problem;
  problem.step = 0.01;
  problem.bodies.resize(static_cast<std::size_t>(bodies) + 1);
  for (std::size_t k = 1; k < problem.bodies.size(); ++k) {
    SolverBody& body = problem.bodies[k];
    body.inverse_mass = std::pow(10.0, -2 * random.uniform());
    const Matrix3d R = random.rotation().toRotationMatrix();
    const Vector3d inertia =
        Vector3d(1, 1 + random.uniform(), 1 + random.uniform()) * 0.1 / body.inverse_mass;
    body.inverse_inertia = R * inertia.cwiseInverse().asDiagonal() * R.transpose();
    body.velocity = any(random, 3);
    body.angular_velocity = any(random, 3);
  }
  for (int k = 1; k <= bodies; ++k) {
    ContactPair pair;
    pair.a = k - 1, pair.b = k;
    pair.collider_a = k - 1, pair.collider_b = k;
    pair.first = k - 1, pair.count = 1;
    problem.pairs.push_back(pair);
    ContactPoint point;
    point.normal = any(random, 1).normalized();
    point.arm_a = k == 1 ? Vector3d::Zero().eval() : any(random, 0.5);
    point.arm_b = any(random, 0.5);
    point.stiffness = 1e9;
    point.friction = friction;
    point.restitution = restitution;
    problem.points.push_back(point);
  }
  return problem;
}

double energy(const ContactProblem& problem) {
  double sum = 0;
  for (const SolverBody& body : problem.bodies)
    if (body.inverse_mass > 0)
      sum += 0.5 * body.velocity.squaredNorm() / body.inverse_mass +
             0.5 * body.angular_velocity.dot(body.inverse_inertia.inverse() * body.angular_velocity);
  return sum;
}

Vector3d relative_velocity(const ContactProblem& problem, const ContactPair& pair, const ContactPoint& p) {
  const auto at = [&](int body, const Vector3d& arm) {
    const SolverBody& b = problem.bodies[static_cast<std::size_t>(body)];
    return Vector3d(b.velocity + b.angular_velocity.cross(arm));
  };
  return at(pair.b, p.arm_b) - at(pair.a, p.arm_a);
}

class RestitutionBy : public testing::TestWithParam<Method> {
 protected:
  SolverOptions options() const {
    SolverOptions o;
    o.method = GetParam();
    return o;
  }
};

}  // namespace

// Any chain, friction and restitution. The stage of impacts solves to 1e-12 and lets 1e-9 of what it turns
// over pass. The step that follows has contacts that open or rest: 1e-6; in single precision it rounds a
// velocity three times in each of 16 substeps by 6e-8 of the fastest, which may be ten times what carries the
// energy, as masses are 1 to 100: 1e-4.
TEST_P(RestitutionBy, MakesNoEnergy) {
  CounterRandom random(7);
  const double rounded = GetParam() == Method::batched ? 1e-4 : 1e-6;
  for (int trial = 0; trial < 2000; ++trial) {
    const double e = trial % 2 ? 1 : random.uniform();
    ContactProblem problem = chain(random, 1 + trial % 4, 2 * random.uniform(), e);
    const double before = energy(problem);
    solve(problem, options());
    ASSERT_LE(energy(problem), before * (1 + rounded)) << "trial " << trial << ", e " << e;
  }
}

// Without friction Newton's law makes none, so it holds whole: a single impact comes back with e of its approach.
TEST_P(RestitutionBy, IsNewtonsWithoutFriction) {
  CounterRandom random(8);
  for (int trial = 0; trial < 300; ++trial) {
    const double e = random.uniform();
    ContactProblem problem = chain(random, 1, 0, e);
    const double approach =
        problem.points[0].normal.dot(relative_velocity(problem, problem.pairs[0], problem.points[0]));
    solve(problem, options());
    const double after =
        problem.points[0].normal.dot(relative_velocity(problem, problem.pairs[0], problem.points[0]));
    if (approach >= -0.05) continue;
    EXPECT_NEAR(after, -e * approach, 1e-6 * std::abs(approach)) << "trial " << trial;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, RestitutionBy, testing::Values(Method::sequential, Method::batched),
                         [](const auto& info) { return std::string(to_string(info.param)); });
