// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/clipping.h>
#include <drawpoint/engine/geometry/collision_hull.h>
#include <Eigen/Dense>
#include <drawpoint/engine/geometry/shape.hpp>
#include <vector>

/// Contact with a half-space, in closed form. The points lie on the shape; their gaps are heights over the
/// plane.
///
/// Polyhedron: its vertices within the margin. Cylinder: the ends of its lowest line and, for one that lies
/// on its face, the points of that face's rim a quarter and half a turn on. Reduced to four, those of last time before
/// others (clipping.h). World frame, metres.
namespace drawpoint::engine::detail {

/// The plane normal·x = offset in the world.
struct Plane {
  Eigen::Vector3d normal;
  double offset;
};

void plane_contact(const Plane& plane, const CollisionHull& hull, const Eigen::Isometry3d& X_WC,
                   double margin, const KeptPoints& kept, std::vector<ClipPoint>& points);
void plane_contact(const Plane& plane, const Cylinder& cylinder, const Eigen::Isometry3d& X_WC, double margin,
                   const KeptPoints& kept, std::vector<ClipPoint>& points);

}  // namespace drawpoint::engine::detail
