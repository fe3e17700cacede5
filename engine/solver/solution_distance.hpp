// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>

/// How far two solutions of one contact problem are apart, and a solution from its own momentum balance.
///
/// Impulses are those of the whole step, so methods with and without substeps can be compared; they differ by
/// what the substeps resolve, too. Velocities are measured by kinetic energy, ‖Δv‖² = Δvᵀ M Δv, with the
/// machine's w of unit mass: no choice of units between translation and rotation. Cost: linear.
namespace drawpoint::engine {

/// Relative 2-norms; absolute where the other solution has no impulses.
struct Distance {
  double impulses = 0;    ///< of the points, over the step. Friction need not be unique where bodies stick.
  double velocities = 0;  ///< in the norm of kinetic energy, relative to what the contacts of `to` changed
};
Distance distance(const ContactProblem& from, const SuperBodySolution& from_machine, const ContactProblem& to,
                  const SuperBodySolution& to_machine);

/// How far a solution's velocities are from what its impulses give, v⁻ + push + M⁻¹ Jᵀ λ, in the norm of
/// kinetic energy, relative to the change by the impulses (absolute where they change nothing).
double momentum_defect(const ContactProblem& unsolved, const ContactProblem& solved,
                       const SuperBodySolution& machine);

}  // namespace drawpoint::engine
