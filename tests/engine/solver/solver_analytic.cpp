// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/solver/solver.hpp>

using namespace drawpoint::engine;
using Eigen::Vector3d;

namespace {

constexpr double rigid = 1e30;  // [N/m]
constexpr double machine_mass = 57e3, rock_mass = 50;

// A machine that can only slide along x: one coordinate w = sqrt(M) v, one part at the origin.
SuperBody sled(double speed) {
  SuperBody sled;
  sled.velocity = sled.velocity_before = Eigen::VectorXd::Constant(1, std::sqrt(machine_mass) * speed);
  SpatialMap map = SpatialMap::Zero(6, 1);
  map(3, 0) = 1 / std::sqrt(machine_mass);
  sled.part_maps = {map};
  sled.origins = {Vector3d::Zero()};
  return sled;
}

// The sled's front touches a rock at rest, rigidly and head on.
ContactProblem push(const SuperBody& machine) {
  ContactProblem problem;
  problem.bodies.resize(2);
  problem.bodies[1].inverse_mass = 1 / rock_mass;
  problem.bodies[1].inverse_inertia = Eigen::Matrix3d::Identity();
  problem.step = 0.01;
  ContactPair pair;
  pair.a = machine_part(0);
  pair.b = 1;
  pair.count = 1;
  problem.pairs = {pair};
  ContactPoint point;
  point.stiffness = rigid;
  point.position = Vector3d(1, 0, 0);
  point.arm_a = Vector3d(1, 0, 0);
  point.arm_b = Vector3d(-0.2, 0, 0);
  point.normal = Vector3d::UnitX();
  problem.points = {point};
  problem.machine = &machine;
  return problem;
}

SuperBodyRow motor(double speed, double limit) {
  SuperBodyRow row;
  row.jacobian = Eigen::VectorXd::Constant(1, 1 / std::sqrt(machine_mass));
  row.target = speed;
  row.lower = -limit;
  row.upper = limit;
  return row;
}

// One step, so many plain iterations in double precision: what the bounds below count.
SolverOptions plain(int iterations) {
  SolverOptions options;
  options.method = Method::sequential;
  options.substeps = 1;
  options.iterations = iterations;
  options.iteration_budget = 0;
  return options;
}

}  // namespace

// One contact row between 57 t and 50 kg: Gauss-Seidel solves a single row at once, v = M/(M + m). A later
// iteration changes nothing but round-off: 1e-12.
TEST(SuperBody, PushesARockAtAMassRatioOfAThousandInOneIteration) {
  const SuperBody machine = sled(1);
  ContactProblem problem = push(machine);
  const SolverReport report = solve(problem, plain(2));
  const double v = machine_mass / (machine_mass + rock_mass);
  EXPECT_NEAR(problem.bodies[1].velocity.x(), v, 1e-12);
  EXPECT_NEAR(report.machine.velocity[0] / std::sqrt(machine_mass), v, 1e-12);
  EXPECT_NEAR(problem.points[0].impulse.x(), rock_mass * v, 1e-10);
  EXPECT_NEAR(report.machine.part_impulses[0][3], -rock_mass * v, 1e-10);
}

// A motor that may push as hard as it likes keeps the speed and pays the rock's momentum, 50 N s. Motor and
// contact are two rows on one coordinate: an iteration reduces the error by m/(M + m) = 9e-4, and one with momentum
// brings back 0.6 of the error before the last, so two iterations reduce it by 6e-4 and ten leave less than 1e-15.
TEST(SuperBody, MotorKeepsItsSpeedAndPaysForIt) {
  SuperBody machine = sled(1);
  machine.rows = {motor(1, 1e9)};
  ContactProblem problem = push(machine);
  const SolverReport report = solve(problem, plain(11));
  EXPECT_NEAR(problem.bodies[1].velocity.x(), 1, 1e-12);
  EXPECT_NEAR(report.machine.row_impulses[0], rock_mass, 1e-9);
}

// Limited to 30 N s it falls back: momentum M + 30 = (M + m) v.
TEST(SuperBody, MotorStopsAtItsForceLimit) {
  SuperBody machine = sled(1);
  machine.rows = {motor(1, 30)};
  ContactProblem problem = push(machine);
  const SolverReport report = solve(problem, plain(6));
  EXPECT_DOUBLE_EQ(report.machine.row_impulses[0], 30);
  EXPECT_NEAR(problem.bodies[1].velocity.x(), (machine_mass + 30) / (machine_mass + rock_mass), 1e-12);
}

// A sled that slides along x only, pressed on fixed ground: it answers neither upward nor sideways, yet
// everything stays finite and friction along x, the one way it can give, stops at μ times the (zero) normal
// impulse.
TEST(SuperBody, StaysFiniteWhereItCannotAnswer) {
  const SuperBody machine = sled(1);
  ContactProblem problem = push(machine);
  problem.pairs[0].b = 0;
  problem.points[0].normal = -Vector3d::UnitZ();
  problem.points[0].friction = 0.8;
  problem.pairs[0].rolling_arm = problem.pairs[0].spinning_arm = 0.1;
  const SolverReport report = solve(problem, plain(5));
  EXPECT_TRUE(problem.points[0].impulse.allFinite());
  EXPECT_TRUE(problem.pairs[0].impulse.allFinite());
  EXPECT_NEAR(report.machine.velocity[0] / std::sqrt(machine_mass), 1, 1e-12);
}

// Rolling resistance: a spinning ball pressed on the floor by the impulse P loses at most arm · P of angular
// momentum a step, and exactly that while it keeps turning.
TEST(RollingResistance, TakesItsLimitFromASpinningBody) {
  for (const double spin : {10.0, 0.05}) {
    ContactProblem problem;
    problem.bodies.resize(2);
    problem.bodies[1].inverse_mass = 1 / rock_mass;
    problem.bodies[1].inverse_inertia = 0.5 * Eigen::Matrix3d::Identity();
    problem.bodies[1].velocity = Vector3d(0, 0, -0.1);
    problem.bodies[1].angular_velocity = Vector3d(0, 0, spin);
    problem.step = 0.01;
    ContactPoint point;
    point.stiffness = rigid;
    point.position = point.arm_a = Vector3d::Zero();
    point.arm_b = Vector3d(0, 0, -0.3);
    point.normal = Vector3d::UnitZ();
    problem.points = {point};
    ContactPair pair;
    pair.b = 1;
    pair.count = 1;
    pair.spinning_arm = 0.1;
    problem.pairs = {pair};
    solve(problem, plain(10));
    const double press = rock_mass * 0.1, loss = std::min(0.5 * pair.spinning_arm * press, spin);
    EXPECT_NEAR(problem.points[0].impulse.z(), press, 1e-12);
    EXPECT_NEAR(problem.bodies[1].angular_velocity.z(), spin - loss, 1e-12);
  }
}
