// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <drawpoint/benchmarks/micro/converged_solution.hpp>
#include <drawpoint/engine/solver/residual.hpp>
#include <drawpoint/engine/solver/solution_distance.hpp>

/// One method on one problem: how true, how far from the converged solution, how long.
///
/// The converged solution is that of as many substeps (converged_solution.hpp). Times are of the processor for one
/// thread, of the clock for several; repeats are at least as many as asked for, short ones go on for 0.4 s. The time
/// of a solve is the least, threads and buffers being there (contact_methods.hpp). The time per contact point and
/// iteration is the median difference between a long solve and a short one just before, so that making the problem
/// ready, which `milliseconds` contains, is not in it.
namespace drawpoint::benchmarks {

struct Evaluation {
  engine::Residual residual;
  engine::Distance distance;
  double momentum_defect = 0;
  double milliseconds = 0;  ///< of the whole solve, without what is set up once
};

/// `converged`: of options.substeps. Throws std::invalid_argument for options that the method does not take.
Evaluation evaluate(const engine::ContactProblem& problem, const ContactMethod& method,
                    const MethodOptions& options, int repeats, const Converged& converged);

/// [ns]; points x substeps x iterations are the work.
double nanoseconds_per_point_and_iteration(const engine::ContactProblem& problem, const ContactMethod& method,
                                           const MethodOptions& options, int repeats);

}  // namespace drawpoint::benchmarks
