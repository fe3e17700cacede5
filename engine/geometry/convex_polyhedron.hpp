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
/// dropped, so that a box has 8 vertices and 6 faces. Two points nearer than 1e-9 of the extent are one
/// point, and a point nearer than that to a plane lies in it; faces are at least 1e-6 of it wide and high.
/// Any frame, metres. A polyhedron is an immutable value. Cost of hull_of: every triple of the n points is
/// tried as a plane, O(n³) to O(n⁴); 50 points take about 1 ms.
namespace drawpoint::engine {

class ConvexPolyhedron {
 public:
  /// The hull of at least four points that are not in one plane; throws std::invalid_argument otherwise.
  static ConvexPolyhedron hull_of(std::span<const Eigen::Vector3d> points);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<std::vector<int>>& faces() const { return faces_; }
  /// Unit outward normals, in the order of faces().
  const std::vector<Eigen::Vector3d>& face_normals() const { return normals_; }

  double volume() const { return volume_; }  ///< [m³]
  double length() const { return length_; }  ///< longest distance between two vertices [m]
  double radius() const { return radius_; }  ///< of the sphere about the origin that holds all vertices [m]

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
