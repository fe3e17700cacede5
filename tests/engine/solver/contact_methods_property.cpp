// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Every method of the benchmarks' table solves the same law: given enough iterations, its residual goes away
// and its velocities are those of the reference. The example of docs/explanation/contact-solving.md is one of them.
#include <gtest/gtest.h>

#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/solver/residual.hpp>
#include <drawpoint/engine/solver/solution_distance.hpp>
#include <drawpoint/tests/support/contact_problems.hpp>

using namespace drawpoint;
using namespace drawpoint::engine;

namespace {

// Double precision methods get far below; single precision ends at about 1e-6 of the load per point (24
// bits), which a chain of contacts multiplies.
constexpr double converged = 1e-4;
constexpr int enough = 20000;
// Single precision rounds each velocity that an iteration writes by 6e-8 of it: 1 m/s where contacts change
// 0.05 m/s, some four times per body and iteration. As a random walk over the iterations: 6e-8 · 20 · sqrt(4
// · 20000) = 3.4e-4, times three.
constexpr double rounded_momentum = 1e-3;

// The heap with a sled of one freedom behind it, its motor set to push with less than it would take to keep
// its speed: the machine's rows take part, at a limit.
class Heap {
 public:
  Heap() : problem(support::heap_of_boxes()) {
    sled_.velocity = sled_.velocity_before = Eigen::VectorXd::Constant(1, 10);
    SpatialMap map = SpatialMap::Zero(6, 1);
    map(3, 0) = 0.05;
    sled_.part_maps = {map};
    sled_.origins = {Eigen::Vector3d::Zero()};
    SuperBodyRow motor;
    motor.jacobian = Eigen::VectorXd::Constant(1, 0.05);
    motor.target = 0.6;
    motor.lower = -5;
    motor.upper = 5;
    sled_.rows.push_back(motor);
    ContactPair pair;
    pair.a = machine_part(0);
    pair.b = 1;
    pair.first = static_cast<int>(problem.points.size());
    pair.count = 1;
    problem.pairs.push_back(pair);
    ContactPoint point;
    point.position = point.arm_a = Eigen::Vector3d(-0.2, 0, 0.15);
    point.arm_b = Eigen::Vector3d(-0.15, 0.01, 0.02);
    point.normal = Eigen::Vector3d::UnitX();
    point.stiffness = 1e8;
    point.friction = 0.4;
    problem.points.push_back(point);
    problem.machine = &sled_;
  }

  ContactProblem problem;

 private:
  SuperBody sled_;
};

}  // namespace

TEST(ContactMethods, AreNamedOnceAndIncludeTheEngines) {
  std::vector<std::string> names;
  for (const auto& method : benchmarks::contact_methods()) names.push_back(method.name);
  EXPECT_EQ(names, (std::vector<std::string>{"anderson", "apgd", "batched", "jacobi", "nncg", "sequential",
                                             "symmetric_gauss_seidel"}));
  EXPECT_THROW(benchmarks::contact_method("newton"), std::invalid_argument);
}

namespace {

// Relative velocity of the point along its normal in the solved problem, between two bodies [m/s].
double parting_speed(const ContactProblem& solved, const ContactPair& pair, const ContactPoint& p) {
  const SolverBody &a = solved.bodies[pair.a], &b = solved.bodies[pair.b];
  return p.normal.dot(b.velocity + b.angular_velocity.cross(p.arm_b) - a.velocity -
                      a.angular_velocity.cross(p.arm_a));
}

void expect_one_solution(const Heap& heap) {
  ContactProblem reference = heap.problem;
  const SolverReport best =
      benchmarks::contact_method("sequential").solve(reference, benchmarks::fixed_work(1, enough));
  ASSERT_LT(residual(reference, best.machine, 1).contacts(), 0.1 * converged);
  ASSERT_GT(reference.points.back().impulse.norm(), 1);  // the sled pushes
  for (const auto& method : benchmarks::contact_methods()) {
    SCOPED_TRACE(method.name);
    ContactProblem problem = heap.problem;
    const SolverReport report = method.solve(problem, benchmarks::fixed_work(1, enough));
    const Residual r = residual(problem, report.machine, 1);
    EXPECT_LT(r.contacts(), converged);
    EXPECT_LT(r.rows, converged);
    EXPECT_LT(distance(problem, report.machine, reference, best.machine).velocities, converged);
    EXPECT_LT(momentum_defect(heap.problem, problem, report.machine), rounded_momentum);
    EXPECT_LT((report.machine.part_impulses[0] - best.machine.part_impulses[0]).norm(),
              converged * best.machine.part_impulses[0].norm());
  }
}

}  // namespace

TEST(ContactMethods, ReachOneSolution) { expect_one_solution(Heap()); }

// 0.1 m of overlap would be taken back at 4 · 0.1 m / 5 ms · 1/9 = 9 m/s; the law allows `push_out_speed`.
// The bound is reached where the reference's deepest points press at all.
TEST(ContactMethods, ReachOneSolutionWhereOverlapsAreDeep) {
  Heap heap;
  const ContactPair& deep = heap.problem.pairs[heap.problem.pairs.size() - 2];  // the last two boxes
  for (int k = deep.first; k < deep.first + deep.count; ++k) heap.problem.points[k].gap = -0.1;
  ContactProblem reference = heap.problem;
  benchmarks::contact_method("sequential").solve(reference, benchmarks::fixed_work(1, enough));
  int bounded = 0;
  for (int k = deep.first; k < deep.first + deep.count; ++k)
    bounded +=
        reference.points[k].impulse.norm() > 1 &&
        std::abs(parting_speed(reference, deep, reference.points[k]) - constants::push_out_speed) < 1e-6;
  ASSERT_GT(bounded, 0);
  expect_one_solution(heap);
}
