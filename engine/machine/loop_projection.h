// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/machine/simbody_types.h>
#include <vector>

/// Puts a Simbody state's coordinates on to its loops, in Eigen's arithmetic alone.
///
/// Newton's method on the loop errors e(q): each step moves the joints by the least δu, in the measure of the mass
/// matrix, with P δu = −e; quaternions are brought back to unit length. Redundant loops and singular poses are met by
/// the pseudo-inverse. No joint is moved by more than 0.5 rad or m in all, so that a linkage keeps the way in which it
/// closes. Simbody's own projection does as much through LAPACK, whose last bits depend on which library the system has
/// chosen.
namespace drawpoint::engine::machine {

struct LoopTolerance {
  double aim = 1e-11;     ///< [m]
  double allowed = 1e-9;  ///< [m], where round-off lets a step gain no more: far from the origin
};

/// `held`: speed indices of joints that stay where they are. Leaves the state realised to positions. Throws
/// std::runtime_error with the error left when it is not allowed; the coordinates are then undefined.
void project_on_loops(const SimTK::MultibodySystem& system, const SimTK::SimbodyMatterSubsystem& matter,
                      const std::vector<int>& held, const LoopTolerance& tolerance, SimTK::State& state);

}  // namespace drawpoint::engine::machine
