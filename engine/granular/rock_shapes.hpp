// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>

/// Six shapes of blasted rock: blocks bounded by 10 to 12 fracture planes, 16 to 20 vertices.
///
/// Each is the intersection of half-spaces n·x ≤ d with literal coefficients: six tilted sides of a block and
/// four to six cuts through its corners, as blasted rock shows. Extents along the principal axes are about 1
/// : 0.62-0.87 : 0.52-0.83. The centre of mass is at the origin, the principal axes are the coordinate axes,
/// the longest extent (least moment of inertia) along x; the longest distance of two vertices is 1 m. Volumes
/// 0.18 to 0.24 m³, mean 0.21: a rock of length L weighs 0.21 ρ L³ on average. Scale with
/// ConvexPolyhedron::scaled(L).
namespace drawpoint::engine::granular {

/// Built on the first call, the same objects ever after.
const std::array<engine::ConvexPolyhedron, 6>& rock_shapes();

/// Checksum of the coefficients that make the shapes: other shapes have another one. Files that name a shape by its
/// number store it.
std::uint64_t rock_shapes_checksum();

}  // namespace drawpoint::engine::granular
