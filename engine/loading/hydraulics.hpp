// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

/// The hydraulic circuit of an arm: its pressure gives the cylinders' forces, its pump their speeds.
///
/// A cylinder pushes with the area of its piston and pulls with what the rod leaves of it, at most with the
/// relief pressure; driven against, it holds as much and gives way beyond, as a relief valve lets it. All
/// cylinders hang on one pump: where their set speeds take more than its flow, all are slowed by one factor,
/// as flow-sharing valves do, and the arm keeps the direction of its path. Simplified: oil does not compress
/// or leak, valves open at once, the pump has its flow at any pressure (what power that takes from the wheels
/// is drive_line.hpp), and a cylinder that stands against its relief valve keeps its share of the flow.
namespace drawpoint::engine::loading {

struct Cylinder {
  double bore = 0;  ///< [m]
  double rod = 0;   ///< [m]; 0: it pulls as hard as it pushes
};

struct Hydraulics {
  double pressure = 28e6;                                      ///< at which the relief valves open [Pa]
  double pump_flow = std::numeric_limits<double>::infinity();  ///< [m³/s]
  Cylinder lift = {.bore = 0.180};                             ///< each of two
  Cylinder tilt = {.bore = 0.200};
};

/// An LH621-class machine's: 485 l/min, which lifts in 8 s and lowers in 5.5 s, rods of 100 and 110 mm.
/// Estimates, as no manufacturer publishes them (the Epiroc ST14, of 14 t: 7.6 and 4.0 s).
Hydraulics lh621_hydraulics();

double pushing_force(const Cylinder& cylinder, double pressure);  ///< [N]
double pulling_force(const Cylinder& cylinder, double pressure);  ///< [N]

/// What a cylinder takes of the pump's flow at a speed of its rod [m/s], positive: out. [m³/s]
double flow(const Cylinder& cylinder, double speed);

/// The factor, above 0 and at most 1, on the speeds of both lift cylinders and the tilt cylinder [m/s] that
/// the pump can feed.
double flow_share(const Hydraulics& hydraulics, double lift_speed, double tilt_speed);

/// Throws std::invalid_argument naming value and allowed range.
void check(const Hydraulics& hydraulics);

}  // namespace drawpoint::engine::loading
