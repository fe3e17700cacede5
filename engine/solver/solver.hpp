// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/solver/solver_options.hpp>
#include <drawpoint/engine/solver/solver_report.hpp>
#include <memory>

/// Solves a ContactProblem: substeps of projected Gauss-Seidel iterations, by one of the methods below.
///
/// A substep adds its share of the outer forces, starts from the last substep's impulses, iterations over
/// machine rows, points and pairs, and moves the gaps. One step with many iterations is the textbook method;
/// many substeps with one iteration each converge far better for the same work, because the error of a
/// substep shrinks with (h/S)² (M. Macklin et al., "Small steps in physics simulation", 2019). A point is one
/// 3 x 3 block W = J M⁻¹ Jᵀ: the normal first, then friction with the velocity that the normal's change
/// leaves. Friction takes the exact sticking impulse if the cone allows it, else the step λ_t − u_t / ρ with
/// ρ = λ_max(W_tt), projected radially: its fixed points slide against the impulse even where W_tt is
/// anisotropic, so the cone is circular.
///
/// Every second iteration of a substep starts with momentum (momentum.h): chains of rocks need a third to a quarter of
/// the iterations.
///
/// `sequential` visits pairs in their order, in double precision: the reference.
/// `batched` visits sets of pairs that share no body, sixteen pairs at a time, in single precision on
/// velocities and impulses: the fast method. Both give the same bits for any number of threads.
///
/// Small groups of bodies whose masses differ by more than 3000 : 1 are solved by Newton's method, whichever it is.
namespace drawpoint::engine {

namespace detail {
class BatchedSolver;
class HeavyIslands;
class ImpactStage;
}  // namespace detail

class ThreadPool;

/// Keeps its buffers from solve to solve; not for concurrent use.
class ContactSolver {
 public:
  /// On the threads of `pool`, which it may share with a finder, one of them at a time; without one, on the
  /// caller's. Throws std::invalid_argument for options out of range.
  explicit ContactSolver(const SolverOptions& options = {}, std::shared_ptr<const ThreadPool> pool = nullptr);
  ~ContactSolver();
  ContactSolver(ContactSolver&&) noexcept;
  ContactSolver& operator=(ContactSolver&&) noexcept;

  /// Throws std::invalid_argument for a step that is not above 0.
  SolverReport solve(ContactProblem& problem);

 private:
  SolverOptions options_;
  std::shared_ptr<const ThreadPool> pool_;
  std::unique_ptr<detail::BatchedSolver> batched_;
  std::unique_ptr<detail::ImpactStage> impacts_;
  std::unique_ptr<detail::HeavyIslands> islands_;
};

/// One solve, on its own. Throws std::invalid_argument for options out of range and a step that is not above
/// 0.
SolverReport solve(ContactProblem& problem, const SolverOptions& options = {},
                   std::shared_ptr<const ThreadPool> pool = nullptr);

}  // namespace drawpoint::engine
