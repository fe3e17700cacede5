// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <vector>

/// Rock that lies where it should not at the end of each cycle, by the scene of a log: recorded beside the responses.
///
/// in_lane: rock on the floor before the pile's toe, within the breadth of the bucket that has just dug: what the
/// machine runs over next, and a grader clears. before_front: rock on the vehicle's side of the source's front read
/// literally, in each strip from the back wall outward the first empty column; a gap of one column in the toe makes
/// spill of all that lies before it, so this measures how ragged the toe is. Rock in the bucket counts for neither.
/// Poses of a scene are true to 2.5 cm. Source: Lindmark 2016, equations 38 and 56.
namespace drawpoint::engine::loading {

struct RockLeft {
  double in_lane = 0, before_front = 0;  ///< [kg]
};

/// In order of the cycles. Throws std::invalid_argument if the log was read without its scene, or has none with masses.
/// Cost: some ms per cycle and 1000 rocks.
std::vector<RockLeft> rock_left_by_cycle(const LoadingLog& log);

RockLeft rock_left(const LoadingLog& log);  ///< mean over the cycles

}  // namespace drawpoint::engine::loading
