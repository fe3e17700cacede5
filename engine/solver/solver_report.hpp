// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/super_body.hpp>

/// What a solve did, and the machine's part of the solution; the rest is written into the problem.
namespace drawpoint::engine {

struct SolverReport {
  int iterations = 0;      ///< over all pairs, in the whole step; 1 where everything stands
  double last_change = 0;  ///< Σ|Δλ| of the last iteration over Σ λ_n (0 when there is no load)
  /// Residuals of the points' law in the last substep, relative to the load (residual.hpp); 0 where there is none.
  double complementarity = 0, cone = 0;
  SuperBodySolution machine;
};

}  // namespace drawpoint::engine
