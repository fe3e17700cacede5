// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>

/// Exact mass properties of a homogeneous polyhedron.
///
/// The solid is cut into tetrahedra from one point to the triangles of its faces; for a tetrahedron (0, a, b,
/// c) with d = a·(b×c):  V = d/6,  ∫x = d/24 (a+b+c),  ∫x xᵀ = d/120 [(a+b+c)(a+b+c)ᵀ + aaᵀ + bbᵀ + ccᵀ].
/// Then I = ρ (tr C · 1 − C), C the second moment about the centre. Exact but for round-off. Cost: a few ns
/// per triangle. Source: Tonon (2004), Explicit exact formulas for the 3-D tetrahedron inertia tensor;
/// Mirtich (1996).
namespace drawpoint::engine {

struct MassProperties {
  double mass = 0;                                    ///< [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< of mass, in the shape's frame [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre, in the shape's axes [kg m²]
};

/// density [kg/m³]; throws std::invalid_argument unless it is positive and finite.
MassProperties mass_properties(const ConvexPolyhedron& shape, double density);

/// X_SP: the frame at the centre of mass along the principal axes. Where the shape's own axes are principal (products
/// of inertia below 1e-9 of its moments) they are kept, so that a box stays as it stands. Else by rising moment of
/// inertia, right-handed, the largest component of the first two axes positive; where moments are equal, their axes are
/// any.
Eigen::Isometry3d principal_frame(const MassProperties& properties);

}  // namespace drawpoint::engine
