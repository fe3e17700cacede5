// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <span>
#include <vector>

/// Convex polyhedra: rocks, plates, boxes, prisms.
///
/// A polyhedron is the convex hull of its vertices. Its faces are planar polygons, counter-clockwise seen
/// from outside; coplanar triangles are merged into one face and vertices inside a face or an edge are
/// dropped, so that a box has 8 vertices and 6 faces. Two points nearer than the tolerance are one
/// point, and corners nearer than that to a plane may lie in one face: 1e-5 of the extent, or 1e-3 of the least width
/// where that is less. So meshes in single precision or text of six digits give the faces that were meant, and volume
/// and inertia are off by no more than their rounding, or by the tolerance times the surface for what was finer. Any
/// frame, metres. A polyhedron is an immutable value. Cost of hull_of: O(n log n) and, for the length, O(n²) in the
/// vertices; 5000 points on a sphere take about 50 ms.
namespace drawpoint::engine {

class ConvexPolyhedron {
 public:
  /// The hull of at least four points, at least 1e-6 of their extent wide; throws std::invalid_argument otherwise.
  static ConvexPolyhedron hull_of(std::span<const Eigen::Vector3d> points);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<std::vector<int>>& faces() const { return faces_; }
  /// Unit outward normals, in the order of faces().
  const std::vector<Eigen::Vector3d>& face_normals() const { return normals_; }

  double volume() const { return volume_; }  ///< [m³]
  double length() const { return length_; }  ///< longest distance between two vertices [m]
  double radius() const { return radius_; }  ///< of the sphere about the origin that holds all vertices [m]

  /// [m] Of p over the plane of a face.
  double height_over(std::size_t face, const Eigen::Vector3d& p) const {
    return normals_[face].dot(p - vertices_[static_cast<std::size_t>(faces_[face].front())]);
  }
  /// [m] Of p under the nearest face's plane: the distance from the surface, or less than 0 outside.
  double depth(const Eigen::Vector3d& p) const;

  ConvexPolyhedron transformed(const Eigen::Isometry3d& pose) const;
  /// Scaled about the origin; throws std::invalid_argument unless factor > 0.
  ConvexPolyhedron scaled(double factor) const;

 private:
  ConvexPolyhedron(std::vector<Eigen::Vector3d> vertices, std::vector<std::vector<int>> faces);

  std::vector<Eigen::Vector3d> vertices_, normals_;
  std::vector<std::vector<int>> faces_;
  double volume_ = 0, length_ = 0, radius_ = 0;
};

/// An axis-parallel box about the origin.
ConvexPolyhedron box(const Eigen::Vector3d& half_extents);

/// A regular prism about the origin with its axis along y and its vertices on the cylinder of `radius`; a
/// flat side, not an edge, points along -z when `sides` is even.
ConvexPolyhedron prism(double radius, double half_width, int sides);

}  // namespace drawpoint::engine
