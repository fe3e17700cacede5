// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/solver/solver_options.hpp>
#include <drawpoint/engine/solver/solver_report.hpp>
#include <memory>

/// Solves a ContactProblem: substeps of projected Gauss-Seidel sweeps, by one of the methods below.
///
/// A substep adds its share of the outer forces, starts from the last substep's impulses, sweeps over machine
/// rows, points and pairs, and moves the gaps. One step with many sweeps is the textbook method; many
/// substeps with one sweep each converge far better for the same work, because the error of a substep shrinks
/// with (h/S)² (M. Macklin et al., "Small steps in physics simulation", 2019). A point is one 3 x 3 block W =
/// J M⁻¹ Jᵀ: the normal first, then friction with the velocity that the normal's change leaves. Friction
/// takes the exact sticking impulse if the cone allows it, else the step λ_t − u_t / ρ with ρ = λ_max(W_tt),
/// projected radially: its fixed points slide against the impulse even where W_tt is anisotropic, so the cone
/// is circular.
///
/// `sequential` visits pairs in their order, alternating direction, in double precision: the reference.
/// `coloured` visits sets of pairs that share no body, sixteen pairs at a time, in single precision on
/// velocities and impulses: the fast method. Both give the same bits for any number of threads.
namespace drawpoint::engine {

namespace detail {
class ColouredSolver;
class ImpactStage;
class Parallel;
}  // namespace detail

/// Keeps its buffers from solve to solve; not for concurrent use.
class ContactSolver {
 public:
  explicit ContactSolver(const SolverOptions& options = {});
  /// On threads that it shares with others, in place of the options' own; one of them at a time.
  ContactSolver(const SolverOptions& options, std::shared_ptr<const detail::Parallel> parallel);
  ~ContactSolver();
  ContactSolver(ContactSolver&&) noexcept;
  ContactSolver& operator=(ContactSolver&&) noexcept;

  SolverReport solve(ContactProblem& problem);

 private:
  SolverOptions options_;
  std::shared_ptr<const detail::Parallel> parallel_;
  std::unique_ptr<detail::ColouredSolver> coloured_;
  std::unique_ptr<detail::ImpactStage> impacts_;
};

/// One solve, on its own.
SolverReport solve(ContactProblem& problem, const SolverOptions& options = {});

}  // namespace drawpoint::engine
