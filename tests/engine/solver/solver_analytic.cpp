// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/solver/residual.hpp>
#include <drawpoint/engine/solver/solver.hpp>
#include <drawpoint/tests/support/told.hpp>
#include <functional>
#include <limits>

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

namespace {

// A body on the floor, pressed down and sliding along y, with a point on either side of its centre.
ContactProblem sliding_on_two_points() {
  ContactProblem problem;
  problem.step = 0.01;
  problem.bodies.resize(2);
  problem.bodies[1].inverse_mass = 1 / rock_mass;
  problem.bodies[1].inverse_inertia = Eigen::Matrix3d::Identity() / 5;
  problem.bodies[1].velocity = Vector3d(0, 20, -1);
  ContactPair pair;
  pair.b = 1;
  pair.count = 2;
  problem.pairs = {pair};
  for (const double x : {-0.1, 0.1}) {
    ContactPoint point;
    point.position = point.arm_a = point.arm_b = Vector3d(x, 0, 0);
    point.normal = Vector3d::UnitZ();
    point.stiffness = rigid;
    problem.points.push_back(point);
  }
  return problem;
}

SolverOptions by(Method method) {
  return {.method = method, .substeps = 1, .iterations = 200, .iteration_budget = 0};
}

}  // namespace

// A pair of bodies has one friction, its first point's, whatever the others say: what the points carry across
// is μ times what they carry along, in both methods and in the residual. Single precision: 1e-5 of the load.
TEST(Friction, BelongsToThePairInEveryMethod) {
  for (const Method method : {Method::sequential, Method::batched}) {
    ContactProblem problem = sliding_on_two_points();
    problem.points[0].friction = 0.5;
    problem.points[1].friction = 0.1;
    problem.points[1].start = Vector3d(0, -100, 100);  // admissible with neither
    const SolverReport report = solve(problem, by(method));
    const double load = problem.points[0].impulse.z() + problem.points[1].impulse.z();
    ASSERT_NEAR(load, rock_mass, 1e-3 * rock_mass) << to_string(method);
    for (const ContactPoint& point : problem.points)
      EXPECT_NEAR(point.impulse.y(), -0.5 * point.impulse.z(), 1e-5 * load) << to_string(method);
    EXPECT_LT(residual(problem, report.machine, 1).cone, 1e-5) << to_string(method);
  }
}

// A pair without points carries nothing: no force, and so no moment, whatever it started from. Everything
// else is solved to the same bits as without it. The sled's pair goes another way through the batched method.
TEST(PairWithoutPoints, CarriesNothingAndChangesNothing) {
  const SuperBody machine = sled(2);
  for (const Method method : {Method::sequential, Method::batched})
    for (const double restitution : {0.0, 0.5}) {
      ContactProblem bare = sliding_on_two_points();
      for (ContactPoint& point : bare.points) point.friction = 0.5, point.restitution = restitution;
      bare.machine = &machine;
      ContactProblem problem = bare;
      for (const int a : {0, machine_part(0)}) {
        ContactPair empty;
        empty.a = a;
        empty.b = 1;
        empty.first = static_cast<int>(problem.points.size());
        empty.rolling_arm = empty.spinning_arm = 0.1;
        empty.start = empty.impulse = Vector3d(1, 2, 3);
        problem.pairs.push_back(empty);
      }
      const SolverReport expected = solve(bare, by(method)), report = solve(problem, by(method));
      for (std::size_t k = 1; k < problem.pairs.size(); ++k) {
        EXPECT_EQ(problem.pairs[k].impulse, Vector3d(Vector3d::Zero())) << to_string(method);
        EXPECT_EQ(problem.pairs[k].start, Vector3d(Vector3d::Zero())) << to_string(method);
      }
      EXPECT_EQ(problem.bodies[1].velocity, bare.bodies[1].velocity) << to_string(method);
      EXPECT_EQ(problem.bodies[1].angular_velocity, bare.bodies[1].angular_velocity) << to_string(method);
      EXPECT_EQ(report.machine.velocity, expected.machine.velocity) << to_string(method);
      const Residual r = residual(problem, report.machine, 1), without = residual(bare, expected.machine, 1);
      EXPECT_EQ(r.contacts(), without.contacts()) << to_string(method);
    }
}

TEST(SolverOptions, AreRefusedByNameWhereverASolveBegins) {
  struct Case {
    const char* name;
    std::function<void(SolverOptions&)> spoil;
  };
  std::vector<Case> cases;
  for (const int count : {0, -1, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
    cases.push_back({"substeps", [=](SolverOptions& o) { o.substeps = count; }});
    cases.push_back({"iterations", [=](SolverOptions& o) { o.iterations = count; }});
  }
  for (const int budget : {-1, std::numeric_limits<int>::max()})
    cases.push_back({"iteration_budget", [=](SolverOptions& o) { o.iteration_budget = budget; }});
  for (const double tolerance : {std::numeric_limits<double>::quiet_NaN(), -1e-9, 1.5})
    cases.push_back({"tolerance", [=](SolverOptions& o) { o.tolerance = tolerance; }});
  cases.push_back({"method", [](SolverOptions& o) { o.method = static_cast<Method>(2); }});
  for (const Case& c : cases) {
    SolverOptions options;
    c.spoil(options);
    ContactProblem problem = sliding_on_two_points();
    drawpoint::support::expect_told([&] { solve(problem, options); }, {"ContactSolver", c.name, "allowed"});
    drawpoint::support::expect_told([&] { ContactSolver solver(options); },
                                    {"ContactSolver", c.name, "allowed"});
  }
  for (const int substeps : {0, -1}) {
    const ContactProblem problem = sliding_on_two_points();
    drawpoint::support::expect_told([&] { residual(problem, {}, substeps); },
                                    {"residual", "substeps", "allowed"});
  }
}

// A step that is no time would divide by zero.
TEST(Solve, RefusesAStepThatIsNoTime) {
  for (const double step :
       {0.0, -0.01, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    ContactProblem problem = sliding_on_two_points();
    problem.step = step;
    drawpoint::support::expect_told([&] { solve(problem, plain(1)); }, {"solve", "step", "above 0"});
  }
}
