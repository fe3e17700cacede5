// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

/// What one engine leaves for the wheels of a machine whose arm it moves too.
///
/// Engine, pumps and a torque converter as three numbers: the pumps take what the cylinders do over their
/// efficiency, the rest reaches the wheels times the converter's and the axles'; near standstill the
/// converter's own torque is the limit. Simplified: one efficiency for all speeds, no gears (first gear), no inertia of
/// the engine, and a drive line that brakes no harder than it drives.
namespace drawpoint::engine::loading {

struct DriveLine {
  double engine_power =
      std::numeric_limits<double>::infinity();  ///< [W]; infinite: wheel torque is the only limit
  double wheel_efficiency = 0.73;               ///< flywheel to tyre [1]: 200 kN at 1.4 m/s of 382 kW
  double pump_efficiency = 0.85;                ///< flywheel to cylinder [1]
};

/// Largest torque of each wheel [N m], one limit for all: `near_stall` [N m], or less
/// where the engine's power does not suffice for it. `wheel_speeds`: sum over the wheels of their turning,
/// without sign [rad/s]; `arm_power`: what the cylinders do [W], below 0 as nothing. At least a thousandth of
/// `near_stall` is left when the arm takes all.
double wheel_torque_limit(const DriveLine& line, double near_stall, double wheel_speeds, double arm_power);

/// Throws std::invalid_argument naming value and allowed range.
void check(const DriveLine& line);

}  // namespace drawpoint::engine::loading
