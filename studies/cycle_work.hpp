// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run loaded and how long that took, cycle by cycle, for a response that is the mean over the cycles of
/// load / (seconds + haul). From this the report says what the response would be with another haul, without new
/// runs.

#include <string>
#include <vector>

namespace drawpoint::studies {

struct CycleWork {
  std::string rate;  ///< name of the response
  double haul = 0;   ///< [s] per cycle away from the place of loading, as the response counts it
  std::vector<double> loads, seconds;  ///< per cycle: unit of the response times s, and [s]
};

}  // namespace drawpoint::studies
