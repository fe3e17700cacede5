// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/calibration/plate_penetration.hpp>

/// Force of a bucket's edge that is driven along the floor into a bank of rock.
///
/// Rock is poured along the back wall of a box, so that it runs down to a foot on the rough floor as a pile
/// in a drift does, boulders first. A flat plate as wide as a bucket, level and a hundredth of a rock over
/// the floor, goes in at a set speed. It has neither the bucket's sides nor its back, so the force is that
/// of the edge alone; and it gives way nowhere, where a machine's edge is lifted off what it is caught at
/// and stands still at its thrust, so the force is higher than a machine's. Depth counts from the foot: with
/// A the area over which the surface stands higher than half a mean length, and W the width of the box, it
/// lies A/W before the back wall. With the defaults and the mine's largest rock of 0.8 m the box is a drift
/// of 5.6 m, the edge 4 m wide and 8 cm thick, and goes 1.6 m deep. World frame, x into the bank, z up, SI
/// units. Cost: 300 rocks of one size, 2000 of the mine's; some 3000 steps.
namespace drawpoint::engine::granular {

struct EdgeOptions : PushOptions {
  double width = 7;                             ///< of the box [largest rocks]
  double height = 5;                            ///< of the bank at the back wall, about [largest rocks]
  double edge_width = 5, edge_thickness = 0.1;  ///< [largest rocks]
  double depth = 2;                             ///< to which it goes [largest rocks]
  double edge_friction = 0.5;                   ///< of rock on the edge; the loading case's steel [1]
  bool rough_walls = false;                     ///< at the sides and behind: as rough as rock, or smooth
};

struct EdgeResult : PenetrationResult {
  double slope = 0;       ///< of the bank before [deg]
  double line_force = 0;  ///< mean_force over the edge's width [N/m]
};

/// Throws std::invalid_argument for an edge that comes nearer to a side wall than half a rock or to the back
/// wall than two rocks, and for lengths and speeds that are not finite and positive.
EdgeResult edge_penetration(const RockSample& sample, const EdgeOptions& options = {});

}  // namespace drawpoint::engine::granular
