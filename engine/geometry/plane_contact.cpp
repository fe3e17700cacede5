// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/plane_contact.h>
#include <drawpoint/engine/base/constants.hpp>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

void keep(const Plane& plane, const Vector3d& p, std::uint32_t feature, double margin,
          std::vector<ClipPoint>& points) {
  const double gap = plane.normal.dot(p) - plane.offset;
  if (gap <= margin) points.push_back({p, gap, feature});
}

void reduce(const Plane& plane, const KeptPoints& kept, std::vector<ClipPoint>& points) {
  points.resize(static_cast<std::size_t>(reduce_to_four(points, plane.normal, kept)));
}

}  // namespace

void plane_contact(const Plane& plane, const CollisionHull& hull, const Eigen::Isometry3d& X_WC,
                   double margin, const KeptPoints& kept, std::vector<ClipPoint>& points) {
  points.clear();
  const Vector3d n = X_WC.linear().transpose() * plane.normal;
  const double offset = plane.offset - plane.normal.dot(X_WC.translation());
  for (int v = 0; v < hull.vertex_count(); ++v) {
    const Vector3d& p = hull.vertices[static_cast<std::size_t>(v)];
    const double gap = n.dot(p) - offset;
    if (gap <= margin) points.push_back({X_WC * p, gap, static_cast<std::uint32_t>(v)});
  }
  reduce(plane, kept, points);
}

void plane_contact(const Plane& plane, const Cylinder& cylinder, const Eigen::Isometry3d& X_WC, double margin,
                   const KeptPoints& kept, std::vector<ClipPoint>& points) {
  points.clear();
  const Vector3d axis = X_WC.linear().col(1);
  Vector3d down = -(plane.normal - plane.normal.dot(axis) * axis);
  down = down.norm() > constants::upright ? Vector3d(down.normalized()) : Vector3d(X_WC.linear().col(2));
  const Vector3d aside = axis.cross(down);
  const double lower = plane.normal.dot(axis) > 0 ? -1 : 1;  // the face at the lower end of the axis
  const Vector3d low_face = X_WC.translation() + lower * cylinder.half_width * axis;
  const Vector3d high_face = X_WC.translation() - lower * cylinder.half_width * axis;
  const std::uint32_t low = lower < 0 ? 0 : 1;
  keep(plane, low_face + cylinder.radius * down, low, margin, points);
  keep(plane, high_face + cylinder.radius * down, 1 - low, margin, points);
  keep(plane, low_face + cylinder.radius * aside, 2 + low, margin, points);
  keep(plane, low_face - cylinder.radius * aside, 4 + low, margin, points);
  keep(plane, low_face - cylinder.radius * down, 6 + low, margin, points);
  reduce(plane, kept, points);
}

}  // namespace drawpoint::engine::detail
