// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>

/// How far a solved ContactProblem is from its law, whatever method solved it.
///
/// The natural map of the law in the last substep of h/S, with the impulses λ of that substep, the velocities
/// u at its end and W = J M⁻¹ Jᵀ of the point alone:
///     r_n = |λ_n − max(0, λ_n − (u_n + Σ λ_n − b) / (W_nn + Σ))|,
///     r_t = |λ_t − P(λ_t − u_t / ρ)|,  P the projection on the disc of radius μ λ_n,  ρ = λ_max(W_tt),
/// and the same for the pairs' moments, divided by their arm. All are in N s, zero at a solution and nowhere
/// else, and are given as sums over the points divided by the load Σ max(λ_n, max(0, ...)), which is Σ λ_n at
/// a solution and stays positive where all impulses are missing.
///
/// Nothing need be kept while solving: what the substep started from follows from what it ended with,
/// v⁻ = v − push/S − M⁻¹ Jᵀ λ and displacement⁻ = displacement − v h/S, to round-off (single precision for a
/// method that works in it). S = 1 is the textbook solve. Impulse stages for restitution are not evaluated.
/// The law jumps where an approach passes the speed of an impact and where a gap closes; a point within
/// round-off of a jump may be evaluated by the other side. Cost: linear, about two iterations of the
/// sequential method.
namespace drawpoint::engine {

/// Relative to the contact load; 0 when there is no load.
struct Residual {
  double complementarity = 0;  ///< of the normals, 0 to 1
  double cone = 0;             ///< of friction
  double moments = 0;          ///< of rolling and spinning resistance
  /// Residual of the machine's own rows relative to their impulses, both in the norm of w.
  double rows = 0;

  double contacts() const { return complementarity + cone + moments; }
};

/// `solved`: as a method left it; `machine`: what it gave back, not read without a machine; `substeps`: the
/// S ≥ 1 that it used. Throws std::invalid_argument for S < 1.
Residual residual(const ContactProblem& solved, const SuperBodySolution& machine, int substeps);

}  // namespace drawpoint::engine
