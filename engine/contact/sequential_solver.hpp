// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/contact/solver.hpp>

/// The reference method: pairs one after another in their order, forth and back, double precision.
///
/// Cost: about 70 ns a point a sweep between rocks, O(r) more on a machine part. No threads.
namespace drawpoint::engine::contact {

SolverReport solve_sequentially(ContactProblem& problem, const SolverOptions& options);

}  // namespace drawpoint::engine::contact
