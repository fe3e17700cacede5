// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <drawpoint/benchmarks/micro/matrix_form.hpp>
#include <drawpoint/benchmarks/micro/row_iteration.hpp>

/// Symmetric projected Gauss-Seidel, double precision, S = 1: iterations go through the pairs forth and back in turn.
///
/// Such an order makes the iteration matrix of a linear problem symmetric, which accelerations by conjugate
/// gradients want, and was the engine's own until one direction proved to need fewer iterations
/// (docs/measurements/contact-solving.md). No momentum.
namespace drawpoint::benchmarks {
namespace {

engine::SolverReport solve_symmetric(engine::ContactProblem& problem, const MethodOptions& options) {
  const MatrixForm form(problem);
  RowIteration iteration(problem, form);
  for (int k = 0; k < options.iterations; ++k) iteration.iterate(k % 2 == 0);
  return form.store(problem, iteration.impulses, iteration.velocities);
}

const RegisteredMethod symmetric_gauss_seidel{{"symmetric_gauss_seidel", solve_symmetric}};

}  // namespace
}  // namespace drawpoint::benchmarks
