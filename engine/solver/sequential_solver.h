// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/solver/solver_options.hpp>
#include <drawpoint/engine/solver/solver_report.hpp>

/// The reference method: pairs one after another in their order, double precision.
///
/// Cost: about 70 ns per point and iteration between rocks, O(r) more on a machine part. No threads.
namespace drawpoint::engine {

SolverReport solve_sequentially(ContactProblem& problem, const SolverOptions& options);

/// The same, with each substep's law solved by Newton's method after its iterations; without a machine.
SolverReport solve_directly(ContactProblem& problem, const SolverOptions& options);

}  // namespace drawpoint::engine
