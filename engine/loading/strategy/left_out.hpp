// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/strategy/executor.hpp>

/// The parts of a cycle in which the machine drives alone, by the executor's law: what they take where they are not
/// simulated.
///
/// Approach, from rest at A over `distance` L: the set speed rises by a, the largest acceleration of the drive, up to
/// the drive-in's v, so that it arrives at min(v, √(2 a L)). Return, from where the bucket is clear to above A: stage
/// 4's law, v_b max(1 − s², ε), s the share of the way back that is done, eased by a. The machine is taken to have its
/// set speed, as it has on a level floor within a few per cent. Deterministic.
namespace drawpoint::engine::loading {

struct LeftOut {
  double time = 0;   ///< [s]
  double speed = 0;  ///< approach: on arrival; return: the largest on the way [m/s]
};

/// What the approach takes over `distance` ≥ 0 [m].
LeftOut approach(double distance, const SpeedPreset& speeds);

/// What is left of stage 4, whose whole way is `whole` [m], from `done` [m] on, where the machine backs at `speed`
/// [m/s] ≥ 0 and `elapsed` [s] of the stage's time have passed. It ends as the stage does, by its goal or by its time
/// limit.
LeftOut way_back(double whole, double done, double speed, double elapsed, const ExecutorOptions& options);

}  // namespace drawpoint::engine::loading
