// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <drawpoint/engine/contact/convex_polyhedron.hpp>
#include <vector>

/// A convex polyhedron laid out for collision: coordinates as arrays for vectorised sweeps, edges with their
/// two faces, and the faces around each vertex. Built once a shape, read only afterwards. Shape's frame,
/// metres.
namespace drawpoint::engine::contact::detail {

/// Runs from start to end with the face `left` on its left, seen from outside.
struct HullEdge {
  int start, end, left, right;
};

struct CollisionHull {
  explicit CollisionHull(const ConvexPolyhedron& shape);

  int vertex_count() const { return static_cast<int>(vertices.size()); }
  int face_count() const { return static_cast<int>(normals.size()); }

  std::vector<Eigen::Vector3d> vertices, normals;
  std::vector<double> offsets;  ///< face plane: normal·x = offset
  std::vector<std::vector<int>> faces, faces_at;
  std::vector<HullEdge> edges;
  Eigen::ArrayXd x, y, z;    ///< vertices, padded to a multiple of four by repeating the last
  Eigen::Vector3d centre;    ///< mean of the vertices
  double radius;             ///< of the sphere about the centre
  double equivalent_radius;  ///< of the sphere of the same volume
};

}  // namespace drawpoint::engine::contact::detail
