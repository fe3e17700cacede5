// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>

#include <drawpoint/engine/geometry/hull.h>
#include <drawpoint/engine/geometry/merged_faces.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace drawpoint::engine {
namespace {

using Eigen::Vector3d;

double volume_of(const std::vector<Vector3d>& vertices, const std::vector<std::vector<int>>& faces) {
  const Vector3d apex = vertices[0];
  double six_volumes = 0;
  for (const auto& face : faces)
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      six_volumes +=
          (vertices[face[0]] - apex).dot((vertices[face[k]] - apex).cross(vertices[face[k + 1]] - apex));
  return six_volumes / 6;
}

void require_positive(const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw std::invalid_argument(std::string("engine::") + what + ": " + std::to_string(value) +
                                " is not a positive finite number; give a size above zero");
}

}  // namespace

ConvexPolyhedron ConvexPolyhedron::hull_of(std::span<const Vector3d> points) {
  detail::Hull hull = detail::hull(points);
  return {std::move(hull.vertices), std::move(hull.faces)};
}

ConvexPolyhedron::ConvexPolyhedron(std::vector<Vector3d> vertices, std::vector<std::vector<int>> faces)
    : vertices_(std::move(vertices)), faces_(std::move(faces)), volume_(volume_of(vertices_, faces_)) {
  for (const auto& face : faces_) normals_.push_back(detail::twice_area(vertices_, face).normalized());
  for (const Vector3d& p : vertices_) {
    radius_ = std::max(radius_, p.norm());
  }
  double squared = 0;
  for (std::size_t k = 0; k < vertices_.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      squared = std::max(squared, (vertices_[k] - vertices_[j]).squaredNorm());
  length_ = std::sqrt(squared);
}

double ConvexPolyhedron::depth(const Vector3d& p) const {
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t face = 0; face < faces_.size(); ++face) highest = std::max(highest, height_over(face, p));
  return -highest;
}

ConvexPolyhedron ConvexPolyhedron::transformed(const Eigen::Isometry3d& pose) const {
  std::vector<Vector3d> moved;
  for (const Vector3d& p : vertices_) moved.push_back(pose * p);
  return {std::move(moved), faces_};
}

ConvexPolyhedron ConvexPolyhedron::scaled(double factor) const {
  require_positive("ConvexPolyhedron::scaled: factor [1]", factor);
  std::vector<Vector3d> grown;
  for (const Vector3d& p : vertices_) grown.push_back(factor * p);
  return {std::move(grown), faces_};
}

ConvexPolyhedron box(const Vector3d& half_extents) {
  std::vector<Vector3d> corners;
  for (double extent : half_extents) require_positive("box: half extent [m]", extent);
  for (int k = 0; k < 8; ++k)
    corners.emplace_back(half_extents.cwiseProduct(Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return ConvexPolyhedron::hull_of(corners);
}

ConvexPolyhedron prism(double radius, double half_width, int sides) {
  require_positive("prism: radius [m]", radius);
  require_positive("prism: half width [m]", half_width);
  if (sides < 3)
    throw std::invalid_argument("engine::prism: " + std::to_string(sides) + " sides; give at least 3");
  std::vector<Vector3d> corners;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / sides - std::numbers::pi / 2;
    for (double y : {-half_width, half_width})
      corners.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
  }
  return ConvexPolyhedron::hull_of(corners);
}

}  // namespace drawpoint::engine
