// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/contact/contact_problem.hpp>

/// Projected Gauss-Seidel on a ContactProblem: the reference method.
///
/// A sweep visits machine rows (motors, stops), contact points and rolling rows one after another; each takes
/// the impulse that satisfies its own law given all others. A point is one 3 x 3 block W = J M⁻¹ Jᵀ: the
/// normal first, then friction with the velocity that the normal's change leaves. Friction takes the exact
/// sticking impulse if the cone allows it, else the step λ_t − u_t / ρ with ρ = λ_max(W_tt), projected
/// radially: its fixed points slide against the impulse even where W_tt is anisotropic, so the cone is
/// circular. Sweeps alternate direction. Impulses start from the values given.
///
/// Cost: about 70 ns a point a sweep between rocks, O(r) more on a machine part. Deterministic: fixed order,
/// no threads. Reference: M. Servin et al., "Examining the smooth and nonsmooth discrete element approaches
/// to granular matter", IJNME 97 (2014).
namespace drawpoint::engine::contact {

struct SolverOptions {
  int sweeps = 25;  ///< ≥ 1; warm started, in place of the thesis's 150
};

struct SolverReport {
  int sweeps = 0;
  double last_change =
      0;  ///< Σ|Δλ| of the last sweep over Σ λ_n: how far from converged (0 when there is no load)
  SuperBodySolution machine;
};

SolverReport solve(ContactProblem& problem, const SolverOptions& options = {});

}  // namespace drawpoint::engine::contact
