// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the runs of a study have reached so far, response by response: single runs, as simulated.

#include <drawpoint/studies/say/live/follower.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace drawpoint::studies {

/// A run that was better in its objective than all that had ended before it.
struct Improvement {
  std::size_t run = 0;    ///< place in Contents::runs
  std::size_t ended = 0;  ///< how many runs had ended with it
};

struct Reached {
  /// The improvements of an objective by runs that keep all limits, the best last; empty for other responses.
  std::vector<Improvement> improvements;
  double lowest = std::numeric_limits<double>::quiet_NaN();  ///< NaN while no run is done
  double highest = std::numeric_limits<double>::quiet_NaN();
  int done = 0;
  int within = 0;  ///< runs that keep this response's own limit
};

/// One per response, in order.
std::vector<Reached> reached(const Contents& contents);

}  // namespace drawpoint::studies
