// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/geometry/shape.hpp>
#include <optional>

/// Where a ray enters a shape.
///
/// Polyhedron: the interval of the ray inside all face planes (Cyrus and Beck 1978). Cylinder: that of the
/// tube and the two end planes. Half-space: its plane. A ray that starts inside a shape does not enter it. Exact but
/// for round-off; cost linear in the faces. World frame, metres.
namespace drawpoint::engine {

struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit
};

struct RayEntry {
  double distance = 0;                               ///< from the ray's origin [m], 0 or more
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, outward, of the surface there
};

/// Where the ray enters the shape that stands at X_WS, no farther than `most` [m]; nothing where it does not.
std::optional<RayEntry> intersect(const Ray& ray, const Shape& shape, const Eigen::Isometry3d& X_WS,
                                  double most);

}  // namespace drawpoint::engine
