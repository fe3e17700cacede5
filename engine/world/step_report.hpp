// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

/// What a step of a world did and where its time went.
namespace drawpoint::engine {

struct StepReport {
  int manifolds = 0, points = 0;         ///< of the problem that was solved
  int iterations = 0;                    ///< of the solver, in the last solve; 1 where everything stands
  double last_change = 0;                ///< of the solver's last iteration, relative to the normal load
  double complementarity = 0, cone = 0;  ///< residual of the contact law, relative to the normal load
  double max_overlap = 0;                ///< [m]
  /// 1, and one more for each time that a rock was carried farther from its way than contacts had been looked for.
  int solves = 0;
  int computed = 0;  ///< pairs of shapes whose contact was computed anew, in all searches of the step
  int refused = 0;   ///< of these, answers of FCL that were wrong (FinderTimes::refused)
  double broad_s = 0, narrow_s = 0, machine_s = 0, solver_s = 0, rest_s = 0;  ///< wall time [s]
};

/// The solution of a step came out not finite or absurdly fast.
class SolutionBroken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace drawpoint::engine
