// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <variant>

/// What can touch: a convex polyhedron, a cylinder (a wheel), or a half-space (ground, wall). Each lives in
/// its own frame; metres.
namespace drawpoint::engine {

/// Solid where normal·x ≤ offset; the normal has unit length.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;  ///< [m]
};

/// A right circular cylinder about the origin with its axis along y.
struct Cylinder {
  double radius = 0, half_width = 0;  ///< [m], both above 0
};

using Shape = std::variant<ConvexPolyhedron, Cylinder, HalfSpace>;

}  // namespace drawpoint::engine
