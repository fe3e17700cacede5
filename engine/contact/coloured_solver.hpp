// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/contact/solver.hpp>

/// The fast method: colours of pairs that share no body, eight pairs at a time, single precision.
///
/// Pairs that touch the machine are swept one after another in double precision before the colours, on the
/// same velocities. Velocities and impulses have 24 bits: a residual below about 1e-6 of the load is
/// round-off. Positions stay in double precision outside. Cost and figures: docs/contact-solving.md.
namespace drawpoint::engine::contact {

SolverReport solve_coloured(ContactProblem& problem, const SolverOptions& options);

}  // namespace drawpoint::engine::contact
