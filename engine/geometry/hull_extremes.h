// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/collision_hull.h>
#include <span>

/// The loops over a hull on which the search for axes spends its time, in the widest vector instructions that
/// the machine has.
///
/// Products and sums are taken in one order, x first and z last, and none is fused; the least is exact. Bounds
/// are of single precision, eased by its round-off. So all machines give the same bits. Cost: linear in
/// vertices, faces or edges: 10, 20 and 100 ns for rocks of a dozen vertices.
namespace drawpoint::engine::detail {

struct Support {
  double height;  ///< least direction·x
  int vertex;     ///< the first that has it
};

/// The vertex of the hull that lies lowest along the direction; all in the hull's frame.
Support lowest(const CollisionHull& hull, const Eigen::Vector3d& direction);

/// A face or an edge, and what no separation along a normal that it allows exceeds [m].
struct HullBound {
  int feature;
  double most;
};

constexpr std::size_t most_points = 6;

/// A face or edge query in single precision, over the rows of CollisionHull::face_planes or edge_frames.
struct BoundQuery {
  const float* columns;
  std::size_t stride, count;  ///< of the columns; of the rows that are no padding
  const float* points;        ///< x, y, z of each
  std::size_t points_count;
  float least, ease;  ///< [m]
};

/// The faces over whose planes the point lies by more than `least`, and maybe others that miss it by round-off. In
/// ascending order into `found`, which has room for all; returns their number.
int faces_over(const CollisionHull& hull, const Eigen::Vector3d& point, double least, HullBound* found);

/// The same for edges and up to `most_points` points of the other shape: the most that the lowest of them lies over an
/// edge, along directions between the normals of its two faces (separation_bounds.h).
int edges_over(const CollisionHull& hull, std::span<const Eigen::Vector3d> points, double least,
               HullBound* found);

}  // namespace drawpoint::engine::detail
