// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/round_contact.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <limits>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t line_group = 0x7e, side_group = 0xfe;
constexpr double most_along_axis = 0.99;  // of a face's normal: beyond, it meets a flat end
constexpr double least_facing =
    0.99;  // of a face that may give the normal: a prism's normals are off by 3.75°
constexpr double one_normal = 0.02;  // [rad] within which an edge's points share the normal of the nearest

// The polyhedron as the cylinder sees it, and how a point of each frame goes into the contact.
struct View {
  View(bool is_a, const HullPair& p)
      : cylinder_is_a(is_a), other(is_a ? p.b : p.a), X_CP(is_a ? p.X_AB : p.X_AB.inverse()) {}

  void add(const Vector3d& on_cylinder, const Vector3d& on_other, std::uint32_t feature,
           ConvexContact& contact) const {
    Anchors& p = contact.points[static_cast<std::size_t>(contact.count++)];
    p.on_a = cylinder_is_a ? on_cylinder : on_other;
    p.on_b = cylinder_is_a ? on_other : on_cylinder;
    p.feature = feature;
  }
  const Vector3d& on_other(const Anchors& p) const { return cylinder_is_a ? p.on_b : p.on_a; }

  bool cylinder_is_a;
  const CollisionHull& other;
  Eigen::Isometry3d X_CP;
};

// The part of a line of the cylinder, from share 0 to 1, that lies over a face.
struct Span {
  double from = 0, to = 1;
  bool empty() const { return from > to; }
};
Span over_face(const CollisionHull& hull, int face, const Vector3d& start, const Vector3d& end) {
  Span span;
  for (const HullCorner& corner : hull.corners(face)) {
    const double out = corner.outward.dot(start) - corner.offset, change = corner.outward.dot(end - start);
    if (change > 0)
      span.to = std::min(span.to, -out / change);
    else if (change < 0)
      span.from = std::max(span.from, -out / change);
    else if (out > 0)
      return {1, 0};
  }
  return span;
}

// The cylinder's line next to a face of the other. False when none of it is over the face.
bool line_on_face(const Cylinder& cylinder, const View& view, int face, double margin,
                  ConvexContact& contact) {
  const CollisionHull& hull = view.other;
  const Vector3d n = view.X_CP.linear() * hull.normals[face];
  const Vector3d across(n.x(), 0, n.z());
  const Vector3d down = -cylinder.radius * across.normalized();
  const Eigen::Isometry3d X_PC = view.X_CP.inverse();
  const Vector3d ends[2] = {X_PC * (down - cylinder.half_width * Vector3d::UnitY()),
                            X_PC * (down + cylinder.half_width * Vector3d::UnitY())};
  const Span span = over_face(hull, face, ends[0], ends[1]);
  if (span.empty()) return false;
  ConvexContact rounded = contact;
  rounded.count = 0;
  for (const double share : {span.from, span.to}) {
    const Vector3d at = ends[0] + share * (ends[1] - ends[0]);
    const double gap = hull.normals[face].dot(at) - hull.offsets[face];
    if (gap <= margin)
      view.add(view.X_CP * at, at - gap * hull.normals[face],
               feature_number(line_group, face, share == span.from ? 0 : 1), rounded);
  }
  if (rounded.count == 0) return false;
  contact = rounded;
  contact.normal = view.cylinder_is_a ? Vector3d(-hull.normals[face]) : hull.normals[face];
  contact.normal_of_b = view.cylinder_is_a;
  return true;
}

// The face that looks along the direction most.
int facing(const CollisionHull& hull, const Vector3d& direction) {
  int best = 0;
  for (int face = 1; face < hull.face_count(); ++face)
    if (hull.normals[face].dot(direction) > hull.normals[best].dot(direction)) best = face;
  return best;
}

// Points of the other shape's edges and corners against the round side.
void edges_on_side(const Cylinder& cylinder, const View& view, double margin, ConvexContact& contact) {
  std::array<Vector3d, 4> radial;
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < contact.count; ++k) {
    const Vector3d p = view.X_CP * view.on_other(contact.points[static_cast<std::size_t>(k)]);
    if (std::abs(p.y()) > cylinder.half_width + constants::touching) continue;
    radial[static_cast<std::size_t>(k)] = Vector3d(p.x(), 0, p.z());
    if (const double r = radial[static_cast<std::size_t>(k)].norm(); r > 0 && r < least)
      least = r, nearest = k;
  }
  if (nearest < 0 || least - cylinder.radius > margin) return;
  const Vector3d outward = radial[static_cast<std::size_t>(nearest)] / least;
  ConvexContact rounded = contact;
  rounded.count = 0;
  for (int k = 0; k < contact.count; ++k) {
    const Anchors& point = contact.points[static_cast<std::size_t>(k)];
    const Vector3d &on_other = view.on_other(point), p = view.X_CP * on_other, across(p.x(), 0, p.z());
    const double r = across.norm();
    if (std::abs(p.y()) > cylinder.half_width + constants::touching || r - cylinder.radius > margin ||
        (across / r - outward).norm() > one_normal)
      continue;
    const Vector3d on_cylinder = cylinder.radius * outward + p.y() * Vector3d::UnitY();
    view.add(on_cylinder, on_other, point.feature ^ side_group << 24, rounded);
  }
  contact = rounded;
  contact.normal = view.cylinder_is_a ? outward : Vector3d(view.X_CP.linear().transpose() * -outward);
  contact.normal_of_b = false;
}

}  // namespace

void round_contact(const Cylinder& cylinder, bool cylinder_is_a, const HullPair& pair, double margin,
                   ConvexContact& contact) {
  if (contact.count == 0) return;
  const View view(cylinder_is_a, pair);
  const Vector3d normal_in_a = contact.normal_of_b ? pair.X_AB.linear() * contact.normal : contact.normal;
  const Vector3d normal =
      cylinder_is_a ? normal_in_a : Vector3d(pair.X_AB.linear().transpose() * normal_in_a);
  if (std::abs(normal.y()) > most_along_axis) return;
  const Vector3d towards = view.X_CP.linear().transpose() * (cylinder_is_a ? Vector3d(-normal) : normal);
  const int face = facing(view.other, towards);
  if (view.other.normals[face].dot(towards) > least_facing &&
      line_on_face(cylinder, view, face, margin, contact))
    return;
  edges_on_side(cylinder, view, margin, contact);
}

}  // namespace drawpoint::engine::detail
