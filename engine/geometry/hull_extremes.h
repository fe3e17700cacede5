// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/collision_hull.h>

/// The two loops over a hull on which the search for axes spends its time, in the widest vector instructions
/// that the machine has.
///
/// Products and sums are taken in one order, x first and z last, and none is fused; the least is exact. So
/// all machines give the same bits. Cost: linear in vertices or faces.
namespace drawpoint::engine::detail {

struct Support {
  double height;  ///< least direction·x
  int vertex;     ///< the first that has it
};

/// The vertex of the hull that lies lowest along the direction; all in the hull's frame.
Support lowest(const CollisionHull& hull, const Eigen::Vector3d& direction);

/// Heights of the point over all face planes, into an array of hull.nx.size() numbers; the padding gets -∞.
void heights(const CollisionHull& hull, const Eigen::Vector3d& point, double* result);

}  // namespace drawpoint::engine::detail
