// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/convex_contact.h>

#include <drawpoint/engine/geometry/hull_extremes.h>
#include <drawpoint/engine/geometry/segments.h>
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <limits>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t edge_group = 0x7f, nearest_group = 0xff;

// The face around a vertex whose normal points most against the direction n.
int facing(const CollisionHull& hull, int vertex, const Vector3d& n) {
  int best = -1;
  double least = 2;
  for (int f : hull.faces_around(vertex))
    if (const double d = hull.normals[f].dot(n); d < least) best = f, least = d;
  return best;
}

// The one of the two faces at an edge whose normal points more against the direction n.
int facing(const CollisionHull& hull, const HullEdge& edge, const Vector3d& n) {
  return hull.normals[edge.left].dot(n) < hull.normals[edge.right].dot(n) ? edge.left : edge.right;
}

void add_anchors(const Vector3d& on_a, const Vector3d& on_b, std::uint32_t feature, ConvexContact& contact) {
  contact.points[static_cast<std::size_t>(contact.count++)] = {on_a, on_b, feature};
}

// The least gap of a contact's points, while the normal is still in A's frame.
double least_gap(const HullPair& pair, const ConvexContact& contact) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < contact.count; ++k) {
    const Anchors& point = contact.points[static_cast<std::size_t>(k)];
    least = std::min(least, contact.normal.dot(pair.X_AB * point.on_b - point.on_a));
  }
  return least;
}

// Overlapping, but by round-off no polygon is left to clip or the edges pass each other: the deepest vertex
// alone.
void support_contact(const HullPair& pair, const Axis& axis, ConvexContact& contact) {
  const int vertex = lowest(pair.b, pair.X_AB.linear().transpose() * axis.normal).vertex;
  const Vector3d other = pair.vertex_b(vertex) - axis.separation * axis.normal;
  add_anchors(other, pair.b.vertices[vertex], feature_number(0, vertex, vertex_mark), contact);
}

}  // namespace

// The reference face with the polygon of face `other` of the other shape.
void ConvexContactSearch::clip_against(const HullPair& pair, const Feature& reference, int other,
                                       double margin, ConvexContact& contact) {
  const bool on_a = reference.kind == FeatureKind::face_a;
  const int face = on_a ? reference.a : reference.b;
  const std::uint32_t group = (on_a ? 0u : 0x80u) | (static_cast<std::uint32_t>(face) % 0x7f);
  contact.count = 0;
  clipper_.clear();
  if (on_a) {
    for (const HullCorner& c : pair.b.corners(other))
      clipper_.add_incident(pair.vertex_b(c.vertex), c.vertex, group);
    for (const ClipPoint& p : clipper_.clip(pair.a, face, margin, group))
      add_anchors(p.position - p.gap * pair.a.normals[face], pair.in_b(p.position), p.feature, contact);
  } else {
    for (const HullCorner& c : pair.a.corners(other))
      clipper_.add_incident(pair.in_b(pair.a.vertices[c.vertex]), c.vertex, group);
    for (const ClipPoint& p : clipper_.clip(pair.b, face, margin, group))
      add_anchors(pair.X_AB * p.position, p.position - p.gap * pair.b.normals[face], p.feature, contact);
  }
}

void ConvexContactSearch::face_contact(const HullPair& pair, const Axis& axis, double margin,
                                       ConvexContact& contact) {
  const bool on_a = axis.feature.kind == FeatureKind::face_a;
  const CollisionHull& incident = on_a ? pair.b : pair.a;
  const Vector3d n = on_a ? Vector3d(pair.X_AB.linear().transpose() * axis.normal) : Vector3d(-axis.normal);
  const int other = facing(incident, axis.vertex, n);
  clip_against(pair, axis.feature, other, margin, contact);
  if (axis.separation > 0 || least_gap(pair, contact) <= axis.separation + constants::coincident) return;
  // An edge or a face parallel to the reference face is lowest, and the lowest vertex lies beside the
  // reference face: the polygon that goes down deepest is that of another face around the vertex.
  for (int f : incident.faces_around(axis.vertex)) {
    if (f == other) continue;
    spare_ = contact;
    clip_against(pair, axis.feature, f, margin, spare_);
    if (least_gap(pair, spare_) < least_gap(pair, contact)) contact = spare_;
  }
}

void ConvexContactSearch::edge_contact(const HullPair& pair, const Axis& axis, double margin,
                                       ConvexContact& contact) {
  const HullEdge &a = pair.a.edges[axis.feature.a], &b = pair.b.edges[axis.feature.b];
  const auto [p, q] = nearest_points({pair.a.vertices[a.start], pair.a.vertices[a.end]},
                                     {pair.vertex_b(b.start), pair.vertex_b(b.end)});
  // Nearest points at an end of an edge: another direction separates the shapes more.
  if ((q - p).norm() > std::abs(axis.separation) + constants::coincident) return;
  add_anchors(p, pair.in_b(q),
              feature_number(edge_group, axis.feature.a, static_cast<std::uint32_t>(axis.feature.b)),
              contact);
  add_flat_points(pair, axis, margin, contact);
}

// Beside the crossing of two edges, where a face lies nearly across the axis: the shapes touch along a line or an
// area there, of which the crossing is only the deepest point. Without the others the contact would jump between the
// ends of what carries a rock at rest, and rock it.
void ConvexContactSearch::add_flat_points(const HullPair& pair, const Axis& axis, double margin,
                                          ConvexContact& contact) {
  const Vector3d n_b = pair.X_AB.linear().transpose() * axis.normal;
  const int face_a = facing(pair.a, pair.a.edges[axis.feature.a], -axis.normal),
            face_b = facing(pair.b, pair.b.edges[axis.feature.b], n_b);
  const double along_a = pair.a.normals[face_a].dot(axis.normal), along_b = -pair.b.normals[face_b].dot(n_b);
  if (std::max(along_a, along_b) < constants::flat_cosine) return;
  if (along_a >= along_b)
    clip_against(pair, {FeatureKind::face_a, face_a, -1}, face_b, margin, spare_);
  else
    clip_against(pair, {FeatureKind::face_b, -1, face_b}, face_a, margin, spare_);
  const auto middle = [&](const Anchors& p) -> Vector3d { return 0.5 * (p.on_a + pair.X_AB * p.on_b); };
  const Vector3d crossing = middle(contact.points[0]);
  for (int k = 0; k < spare_.count; ++k) {
    const Anchors& point = spare_.points[static_cast<std::size_t>(k)];
    if ((middle(point) - crossing).norm() < constants::match_distance)
      contact.points[0].feature = point.feature;  // the same point, told from the face
    else if (contact.count < 4)
      contact.points[static_cast<std::size_t>(contact.count++)] = point;
  }
}

void ConvexContactSearch::nearest_contact(const HullPair& pair, const Axis& axis, double margin,
                                          ConvexContact& contact) {
  AxisSearch::Nearest nearest;
  if (!axes_.nearest_edges(pair, axis, margin, nearest)) {
    contact.separation = std::max(contact.separation, margin);
    return;
  }
  if (nearest.distance > constants::coincident) {
    contact.normal = (nearest.on_b - nearest.on_a) / nearest.distance;
    contact.normal_of_b = false;
    contact.separation = nearest.distance;
  }
  add_anchors(nearest.on_a, pair.in_b(nearest.on_b),
              feature_number(nearest_group, nearest.edge_a, static_cast<std::uint32_t>(nearest.edge_b)),
              contact);
}

// The contact that goes with an axis, if the features of the axis face each other.
void ConvexContactSearch::touch(const HullPair& pair, const Axis& axis, double margin,
                                ConvexContact& contact) {
  contact.normal = axis.normal;
  contact.normal_of_b = axis.feature.kind == FeatureKind::face_b;
  contact.separation = axis.separation;
  contact.support = axis.support;
  contact.feature = axis.feature;
  if (axis.separation > margin) return;
  if (axis.feature.kind == FeatureKind::edges)
    edge_contact(pair, axis, margin, contact);
  else
    face_contact(pair, axis, margin, contact);
}

void ConvexContactSearch::find(const HullPair& pair, const AxisQuery& query, ConvexContact& contact) {
  contact.count = 0;
  Axis axis = axes_.find(pair, query);
  touch(pair, axis, query.margin, contact);
  if (contact.count == 0 && axis.separation <= 0 && axis.feature == query.hint) {  // a stale hint
    axis = axes_.find(pair, {query.margin, 0, {}});
    touch(pair, axis, query.margin, contact);
  }
  complete(pair, query, axis, contact);
}

void ConvexContactSearch::find_along(const HullPair& pair, const AxisQuery& query, const Axis& axis,
                                     ConvexContact& contact) {
  contact.count = 0;
  touch(pair, axis, query.margin, contact);
  if (contact.count == 0 && axis.separation <= 0)
    find(pair, {query.margin, 0, {}, query.report}, contact);
  else
    complete(pair, query, axis, contact);
}

// Where the features of the axis do not face each other, or too far out: the nearest points.
void ConvexContactSearch::complete(const HullPair& pair, const AxisQuery& query, const Axis& axis,
                                   ConvexContact& contact) {
  if (contact.count > 0 && least_gap(pair, contact) > query.report) {
    contact.count = 0;  // edges beside the facing polygons may be nearer
    nearest_contact(pair, axis, query.margin, contact);
  } else if (contact.count == 0 && axis.separation <= query.margin) {
    if (axis.separation > -constants::coincident)  // apart, or in one plane side by side
      nearest_contact(pair, axis, query.margin, contact);
    else
      support_contact(pair, axis, contact);
  }
  if (contact.count > 0 && contact.normal_of_b)
    contact.normal = pair.X_AB.linear().transpose() * contact.normal;
}

}  // namespace drawpoint::engine::detail
