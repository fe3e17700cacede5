// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/solver/residual.hpp>
#include <drawpoint/engine/solver/solver.hpp>
#include <drawpoint/tests/support/rocks.hpp>

using namespace drawpoint;
using namespace drawpoint::engine;

namespace {

// The contact problem of rocks that fall into a corner of floor and wall, after `steps`, as it is solved.
ContactProblem falling_rocks(int steps) {
  World world({}, support::one_material({0.9, 0, 1e9, 0}));
  support::add_floor(world);
  world.add_static(support::shared(HalfSpace{Eigen::Vector3d::UnitX(), -0.4}), Eigen::Isometry3d::Identity(),
                   0);
  for (int k = 0; k < 60; ++k)
    world.add_rock(support::rock_body(k % 6, 0.4),
                   support::at(0.45 * (k % 4), 0.45 * (k / 4 % 4), 0.3 + 0.5 * (k / 16)));
  ContactProblem unsolved;
  world.before_solve([&](const ContactProblem& problem) { unsolved = problem; });
  for (int k = 0; k < steps; ++k) world.step();
  return unsolved;
}

}  // namespace

// The report of a solve says what residual() finds afterwards, for both methods. residual() works out the
// start of the last substep from its end, v⁻ = v − push/S − M⁻¹Jᵀλ, where single precision has rounded: 6e-8
// of the speeds, which W⁻¹ turns into impulses. Speeds of some m/s against the g h/S = 6e-3 m/s that the load
// of a substep stands for make 1e-4 of the load.
TEST(SolverReport, SaysWhatTheResidualIs) {
  for (const int steps : {20, 60, 200}) {
    for (const Method method : {Method::sequential, Method::batched}) {
      ContactProblem problem = falling_rocks(steps);
      SolverOptions options;
      options.method = method;
      options.iteration_budget = 0;
      const SolverReport report = solve(problem, options);
      const Residual found = residual(problem, report.machine, options.substeps);
      EXPECT_GT(found.contacts(), 0);
      EXPECT_NEAR(report.complementarity, found.complementarity, 1e-4 + 1e-3 * found.complementarity);
      EXPECT_NEAR(report.cone, found.cone, 1e-4 + 1e-3 * found.cone);
    }
  }
}
