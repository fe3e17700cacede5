// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/convex_contact.h>
#include <drawpoint/engine/geometry/shape.hpp>

/// The contact of a cylinder's round side with a polyhedron, from that of the prism which stands for it in
/// the search.
///
/// A prism's corners step by 7.5°: a wheel of prisms climbs over each, and stops. Where a face of the
/// polyhedron gives the normal, the points are the ends of the cylinder's line that is nearest to the face,
/// clipped to the face. Where an edge or a corner of it meets the round side, they are its points, and the
/// normal is that from the axis through the nearest of them. Exact for a cylinder, so gaps and normals follow
/// a wheel that rolls. Contacts of its flat ends stay those of the prism, whose faces are 0.2 % of the radius
/// within.
namespace drawpoint::engine::detail {

/// Rewrites the contact of `pair`, one of whose hulls is the prism of this cylinder: A's or B's. Points
/// beyond the margin [m] go; a contact without any keeps those of the prism.
void round_contact(const Cylinder& cylinder, bool cylinder_is_a, const HullPair& pair, double margin,
                   ConvexContact& contact);

/// The same where either, both or none stands for a cylinder. Two cylinders meet as prisms.
inline void round_off(const Cylinder* a, const Cylinder* b, const HullPair& pair, double margin,
                      ConvexContact& contact) {
  if (static_cast<bool>(a) != static_cast<bool>(b))
    round_contact(a ? *a : *b, a != nullptr, pair, margin, contact);
}

}  // namespace drawpoint::engine::detail
