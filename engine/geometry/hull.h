// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

/// Convex hull of points with what is one face merged into one.
///
/// Meshes come as single precision or as text of six digits, so corners of one face are not quite in one plane. Points
/// nearer than the tolerance (constants::hull_thickness of the extent, less for flat bodies) count as one. Qhull's
/// facets, largest first, gather neighbours whose corners all lie within the tolerance of their plane (merged_faces.h);
/// corners that are then within a face or along an edge are dropped. Where that would not close the surface the
/// tolerance is a tenth, down to Qhull's own facets. The surface lies within the tolerance of the hull.
namespace drawpoint::engine::detail {

struct Hull {
  std::vector<Eigen::Vector3d> vertices;  ///< in the order of the points
  std::vector<std::vector<int>> faces;    ///< counter-clockwise seen from outside
};

/// Throws std::invalid_argument for fewer than four points, points that are not finite, and points in one plane.
Hull hull(std::span<const Eigen::Vector3d> points);

}  // namespace drawpoint::engine::detail
