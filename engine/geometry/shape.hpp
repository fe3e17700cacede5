// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <variant>

/// What can touch: a convex polyhedron, a cylinder (a wheel), or a half-space (ground, wall). Each lives in
/// its own frame; metres.
namespace drawpoint::engine {

/// Solid where normal·x ≤ offset; the normal has unit length.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset;
};

/// A right circular cylinder about the origin with its axis along y.
struct Cylinder {
  double radius, half_width;
};

using Shape = std::variant<ConvexPolyhedron, Cylinder, HalfSpace>;

}  // namespace drawpoint::engine
