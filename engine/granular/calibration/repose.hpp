// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/calibration/rock_sample.hpp>

/// Angle of repose two ways: of a heap poured on a floor, and of the bank that is left over a ledge.
///
/// Poured: rocks are set down over the middle of a rough floor until a given number lies. A fan under a raise
/// comes to lie so. Drained: a bin with smooth sides is filled, its end is taken away, and what slides off
/// the ledge is gone. A drained bank stands steeper than a poured heap of the same rock, because no rock that
/// arrives shakes it: iron-ore pellets 41° against 26° (Lommen et al., 2019). A coefficient that is right
/// gives both. The angles are those of heap_surface.hpp, with the mean length by mass as the size of a rock:
/// flanks without toe and tip. The smallest of all heaps that mean something are some six rocks high. Cost:
/// 300 rocks of one size take some 4000 steps.
namespace drawpoint::engine::granular {

struct PouredHeapOptions : RunOptions {
  int rocks = 300;      ///< in the mean, by number; more where sizes differ much
  double radius = 1.1;  ///< of the places where they are let go [largest rocks]
};

struct PouredHeap {
  RunStatus status = RunStatus::completed;
  double angle = 0;   ///< of repose [deg]
  double height = 0;  ///< of the highest place within a largest rock of the middle, along x and y [m]
  int rocks = 0;
};

/// Throws std::invalid_argument for fewer than 20 rocks and a radius that is not finite and positive.
PouredHeap poured_heap(const RockSample& sample, const PouredHeapOptions& options = {});

struct DrainedBankOptions : RunOptions {
  double length = 8, width = 3;  ///< of the bin [largest rocks]
  double height = 6;             ///< to which it is filled, about [largest rocks]
  double opening_speed = 4;      ///< of its end [m/s]
};

struct DrainedBank {
  RunStatus status = RunStatus::completed;
  double angle = 0;  ///< of repose [deg]
  double crest = 0;  ///< mean height of the third of the bank that is farthest from the ledge [m]
  int rocks = 0;     ///< that were filled in
};

/// Throws std::invalid_argument for a length, width or height that is not finite and at least 2 largest
/// rocks, and for a speed that is not finite and positive.
DrainedBank drained_bank(const RockSample& sample, const DrainedBankOptions& options = {});

}  // namespace drawpoint::engine::granular
