// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/collision/swept_contact.h>

#include <drawpoint/engine/base/cross_matrix.h>
#include <drawpoint/engine/geometry/hull_extremes.h>
#include <drawpoint/engine/geometry/round_contact.h>
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <limits>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

constexpr double short_share = 0.1;  // of the inner radii: a way in which shapes can only cut a corner off

// The turn by 2 atan(|v|/2) about v: that by |v| but for |v|³/12, without a sine. A turn of more than 0.2, where that
// is above 7e-4, takes one.
Eigen::Matrix3d turn_of(const Vector3d& v) {
  if (const double angle = v.norm(); angle > 0.2)
    return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
  const Eigen::Matrix3d half = cross_matrix(0.5 * v);
  return Eigen::Matrix3d::Identity() + 2 / (1 + 0.25 * v.squaredNorm()) * (half + half * half);
}

// The hull after a time t.
Placement moved(const MovingHull& hull, double t) {
  const RigidMotion& motion = hull.motion;
  Placement placement = hull.placement;
  const Vector3d shift = motion.shift(t), origin = motion.origin + shift;
  if (motion.angular_velocity.isZero(0)) {
    placement.p += shift, placement.centre += shift;
    return placement;
  }
  const Eigen::Matrix3d turn = turn_of(t * motion.angular_velocity);
  placement.R = turn * hull.placement.R;
  placement.p = origin + turn * (hull.placement.p - motion.origin);
  placement.centre = origin + turn * (hull.placement.centre - motion.origin);
  return placement;
}

// By how much the shapes are apart along the unit vector n.
double separation(const Placement& a, const Placement& b, const Vector3d& n) {
  return lowest(*b.hull, b.R.transpose() * n).height + lowest(*a.hull, -(a.R.transpose() * n)).height +
         n.dot(b.p - a.p);
}

// By how much the way of a point of the hull is off straight at most in the step.
double bend(const MovingHull& hull, double h) {
  const RigidMotion& motion = hull.motion;
  const double reach = (hull.placement.centre - motion.origin).norm() + hull.placement.hull->radius;
  return 0.125 * h * h * (motion.angular_velocity.squaredNorm() * reach + motion.acceleration.norm());
}

// How far the bodies can go into each other.
double most_way(const MovingHull& a, const MovingHull& b, double h) {
  const RigidMotion &u = a.motion, &v = b.motion;
  const double size = std::min(a.placement.hull->radius, b.placement.hull->radius);
  const Vector3d& at =
      a.placement.hull->radius < b.placement.hull->radius ? a.placement.centre : b.placement.centre;
  return h * ((v.at(at) - u.at(at)).norm() + size * (v.angular_velocity - u.angular_velocity).norm() +
              0.5 * h * (v.acceleration - u.acceleration).norm());
}

// The share of an interval, from 0, up to which a distance stays above 0 that is `now` > 0 and `then` at its
// ends and below the straight line between them by no more than a parabola of this height; above 1 when it
// always does.
double first_share(double now, double then, double height) {
  const double slope = then - now - 4 * height, square = slope * slope - 16 * height * now;
  if (slope >= 0 || square < 0) return 2;
  return 2 * now / (-slope + std::sqrt(square));
}

}  // namespace

// The last axis as long as it separates; most pairs that pass each other need no other.
Axis SweptContact::next_axis(const HullPair& pair, const Feature& hint) {
  const Axis axis = axes_.axis_of(pair, hint);
  if (axis.feature.kind != FeatureKind::none && axis.separation > constants::touching) return axis;
  return axes_.find(pair, {std::numeric_limits<double>::infinity(), 0, hint});
}

bool SweptContact::find(const MovingHull& a, const MovingHull& b, double h, const Feature& hint,
                        FirstTouch& touch) {
  const Placement end_a = moved(a, h), end_b = moved(b, h);
  const bool short_way =
      most_way(a, b, h) < short_share * (a.placement.hull->inner_radius + b.placement.hull->inner_radius);
  if (short_way && apart(end_a, end_b, hint)) return false;
  const double bends = bend(a, h) + bend(b, h);
  const int most_advances = short_way ? 3 : 1024;  // shapes that spin past each other closely need hundreds
  Feature feature = hint;
  double t = 0;
  for (int advances = 0;; ++advances) {
    const Placement at_a = moved(a, t), at_b = moved(b, t);
    const HullPair pair{*at_a.hull, *at_b.hull, pose_against(at_a, at_b)};
    const Axis axis = next_axis(pair, feature);
    const double at_end = separation(end_a, end_b, at_a.R * axis.normal);
    if (axis.separation > constants::touching && advances < most_advances) {
      const double left = 1 - t / h;
      const double share = first_share(axis.separation - 0.5 * constants::touching,
                                       at_end - 0.5 * constants::touching, left * left * bends);
      if (share > 1) return false;
      t += share * (h - t);
      feature = axis.feature;
      continue;
    }
    // Points that may come to bear in what is left of the step belong to the contact too.
    const double reach =
        constants::resting_margin + std::max(0.0, axis.separation) + std::max(0.0, axis.separation - at_end);
    contacts_.find_along(pair, {reach, 0, {}, reach}, axis, contact_);
    round_off(a.cylinder, b.cylinder, pair, reach, contact_);
    Manifold& m = touch.manifold;
    m.normal = (contact_.normal_of_b ? at_b : at_a).R * contact_.normal;
    m.count = contact_.count;
    for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
      const Anchors& p = contact_.points[k];
      touch.on_a[k] = a.placement.at(p.on_a), touch.on_b[k] = b.placement.at(p.on_b);
      m.points[k] = {0.5 * (touch.on_a[k] + touch.on_b[k]), m.normal.dot(touch.on_b[k] - touch.on_a[k]),
                     p.feature};
    }
    return m.count > 0;
  }
}

bool SweptContact::apart(const Placement& a, const Placement& b, const Feature& hint) {
  const AxisQuery query{constants::touching, 0, hint};
  return axes_.find({*a.hull, *b.hull, pose_against(a, b)}, query).separation > constants::touching;
}

bool meets_face(const Manifold& m, const MovingHull& a, const MovingHull& b, double h,
                const ConvexContact& contact, int point, const Vector3d& shift) {
  const bool on_a = contact.feature.kind == FeatureKind::face_a;
  if (!on_a && contact.feature.kind != FeatureKind::face_b) return false;
  const Placement& reference = on_a ? a.placement : b.placement;
  const int face = on_a ? contact.feature.a : contact.feature.b;
  const Vector3d outward = on_a ? m.normal : Vector3d(-m.normal);
  if ((reference.R * reference.hull->normals[face] - outward).norm() > constants::same_face) return false;
  const ManifoldPoint& p = m.points[static_cast<std::size_t>(point)];
  const double closing = -m.normal.dot(shift);
  if (closing < p.gap) return false;
  // Turning takes the point off its straight way, and a face that turns comes nearer to a point that goes along it.
  const auto angle = [&](const MovingHull& hull) { return h * hull.motion.angular_velocity.norm(); };
  const auto arm = [&](const MovingHull& hull) { return (p.position - hull.motion.origin).norm(); };
  const double turn_a = angle(a), turn_b = angle(b), along = (shift + closing * m.normal).norm(),
               bend = 0.5 * (turn_a * turn_a * arm(a) + turn_b * turn_b * arm(b)) +
                      (on_a ? turn_a : turn_b) * along;
  if (closing - bend < p.gap) return false;
  const Vector3d other =
      p.position + 0.5 * p.gap * outward + p.gap / closing * (on_a ? shift : Vector3d(-shift));
  const Vector3d local = reference.R.transpose() * (other - reference.p);
  const double off = bend * (1 + along / closing);  // beside the way, and by another time
  for (const HullCorner& corner : reference.hull->corners(face))
    if (corner.outward.dot(local) + off > corner.offset) return false;
  return true;
}

}  // namespace drawpoint::engine::detail
