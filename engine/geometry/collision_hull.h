// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cassert>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <span>
#include <vector>

/// A convex polyhedron laid out for collision: coordinates and planes as arrays for vectorised loops, edges
/// with their two faces, and the planes that stand on the sides of each face. Built once per shape, read only
/// afterwards. Shape's frame, metres.
namespace drawpoint::engine::detail {

/// Runs from start to end with the face `left` on its left, seen from outside.
struct HullEdge {
  int start, end, left, right;
  Eigen::Vector3d along;  ///< end - start
  Eigen::Vector3d beyond_left,
      beyond_right;  ///< unit, in the plane of the face and out of it across the edge
};

/// A corner of a face, and the plane that stands on the side from it to the next corner.
struct HullCorner {
  int vertex;
  Eigen::Vector3d outward;  ///< unit, in the plane of the face
  double offset;            ///< outward·x <= offset in the face's prism
};

struct CollisionHull {
  static constexpr int padding = 16;  ///< of single precision: the widest vector

  explicit CollisionHull(const ConvexPolyhedron& shape);

  int vertex_count() const { return static_cast<int>(vertices.size()); }
  int face_count() const { return static_cast<int>(normals.size()); }
  /// Counter-clockwise seen from outside.
  std::span<const HullCorner> corners(int face) const {
    assert(face >= 0 && face < face_count() && "a face of the hull");
    return std::span(corners_).subspan(face_begin_[face], face_begin_[face + 1] - face_begin_[face]);
  }
  std::span<const int> faces_around(int vertex) const {
    assert(vertex >= 0 && vertex < vertex_count() && "a vertex of the hull");
    return std::span(around_).subspan(around_begin_[vertex],
                                      around_begin_[vertex + 1] - around_begin_[vertex]);
  }
  std::span<const int> edges_of(int face) const {
    assert(face >= 0 && face < face_count() && "a face of the hull");
    return std::span(face_edges_).subspan(face_begin_[face], face_begin_[face + 1] - face_begin_[face]);
  }

  std::vector<Eigen::Vector3d> vertices, normals, middles;  ///< middle: mean of a face's vertices
  std::vector<double> offsets;                              ///< face plane: normal·x = offset
  std::vector<HullEdge> edges;
  Eigen::ArrayXd x, y, z;  ///< vertices, padded to a multiple of four by repeating the last
  /// For bounds (hull_extremes.h), a row per face or edge, padded by zeros to a multiple of `padding`. Faces:
  /// normal and offset. Edges: start, normals of left and right, beyond_left, beyond_right.
  Eigen::ArrayXXf face_planes, edge_frames;
  Eigen::Vector3d centre;    ///< mean of the vertices
  double radius;             ///< of the sphere about the centre
  double inner_radius;       ///< of the largest sphere about the centre inside
  double reach;              ///< of the vertex farthest from the frame's origin
  double equivalent_radius;  ///< of the sphere of the same volume

 private:
  void index(const std::vector<std::vector<int>>& faces);
  void lay_out();

  std::vector<HullCorner> corners_;
  std::vector<int> face_edges_, around_, face_begin_, around_begin_;
};

}  // namespace drawpoint::engine::detail
