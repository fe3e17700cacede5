// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <drawpoint/engine/solver/residual.hpp>
#include <drawpoint/engine/solver/solution_distance.hpp>

/// One method on one problem: how true, how far from the converged solution, how long.
///
/// The converged solution is the sequential method's after up to 10 000 iterations of the whole step (S = 1),
/// or when an iteration changes less than 1e-14 of the load. Times are of the processor for one thread, of
/// the clock for several; repeats are at least as many as asked for, short ones go on for 0.4 s. The time of
/// a solve is the least. The time per contact point and iteration is the median difference between a long
/// solve and a short one just before, so that making the problem ready, which `milliseconds` contains, is not
/// in it.
namespace drawpoint::benchmarks {

struct Solved {
  engine::ContactProblem problem;
  engine::SolverReport report;
};

Solved converged_solution(const engine::ContactProblem& problem);

struct Evaluation {
  engine::Residual residual;
  engine::Distance distance;
  double momentum_defect = 0;
  double milliseconds = 0;  ///< of the whole solve
};

/// Throws std::invalid_argument for options that the method does not take.
Evaluation evaluate(const engine::ContactProblem& problem, const ContactMethod& method,
                    const MethodOptions& options, int repeats, const Solved& converged);

/// [ns]; points x substeps x iterations are the work.
double nanoseconds_per_point_and_iteration(const engine::ContactProblem& problem, const ContactMethod& method,
                                           const MethodOptions& options, int repeats);

}  // namespace drawpoint::benchmarks
