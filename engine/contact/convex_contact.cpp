// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/contact/convex_contact.hpp>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/contact/segments.hpp>

namespace drawpoint::engine::contact::detail {
namespace {

using Eigen::Vector3d;

constexpr double coincident = 1e-9;  // [m] nearer points than this give no direction
constexpr std::uint32_t edge_group = 0x7f, nearest_group = 0xff;

// Of the faces around a vertex, the one that faces the direction n most (its normal along -n).
int facing(const CollisionHull& hull, int vertex, const Vector3d& n) {
  int best = -1;
  double least = 2;
  for (int f : hull.faces_at[static_cast<std::size_t>(vertex)])
    if (const double d = hull.normals[static_cast<std::size_t>(f)].dot(n); d < least) best = f, least = d;
  return best;
}

void add_anchors(const HullPair& pair, const Vector3d& on_a, const Vector3d& on_b, std::uint32_t feature,
                 ConvexContact& contact) {
  const Vector3d local = pair.X_AB.linear().transpose() * (on_b - pair.X_AB.translation());
  contact.points[static_cast<std::size_t>(contact.count++)] = {on_a, local, feature};
}

}  // namespace

void ConvexContactSearch::face_contact(const HullPair& pair, const Axis& axis, double margin,
                                       ConvexContact& contact) {
  const bool on_a = axis.feature.kind == FeatureKind::face_a;
  const int face = on_a ? axis.feature.a : axis.feature.b;
  const auto add_a = [&](int f, auto add) {
    for (int v : pair.a.faces[static_cast<std::size_t>(f)])
      add({pair.a.vertices[static_cast<std::size_t>(v)], v});
  };
  const auto add_b = [&](int f, auto add) {
    for (int v : pair.b.faces[static_cast<std::size_t>(f)]) add({axes_.vertex_b(v), v});
  };
  const auto reference = [this](const Clipper::Corner& c) { clipper_.add_reference(c); };
  const auto incident = [this](const Clipper::Corner& c) { clipper_.add_incident(c); };
  clipper_.clear();
  if (on_a) {
    add_a(face, reference);
    add_b(facing(pair.b, axis.support, pair.X_AB.linear().transpose() * axis.normal), incident);
  } else {
    add_b(face, reference);
    add_a(facing(pair.a, axis.support, -axis.normal), incident);
  }
  const Vector3d outward = on_a ? axis.normal : Vector3d(-axis.normal);
  const std::uint32_t group = (on_a ? 0u : 0x80u) | (static_cast<std::uint32_t>(face) % 0x7f);
  for (const ClipPoint& p : clipper_.clip(outward, margin, group)) {
    const Vector3d on_reference = p.position - p.gap * outward;
    if (on_a)
      add_anchors(pair, on_reference, p.position, p.feature, contact);
    else
      add_anchors(pair, p.position, on_reference, p.feature, contact);
  }
}

void ConvexContactSearch::edge_contact(const HullPair& pair, const Axis& axis, ConvexContact& contact) const {
  const HullEdge& a = pair.a.edges[static_cast<std::size_t>(axis.feature.a)];
  const HullEdge& b = pair.b.edges[static_cast<std::size_t>(axis.feature.b)];
  const auto [p, q] = nearest_points(
      {pair.a.vertices[static_cast<std::size_t>(a.start)], pair.a.vertices[static_cast<std::size_t>(a.end)]},
      {axes_.vertex_b(b.start), axes_.vertex_b(b.end)});
  // Nearest points at an end of an edge: another direction separates the shapes more.
  if ((q - p).norm() > std::abs(axis.separation) + coincident) return;
  add_anchors(pair, p, q,
              feature_number(edge_group, axis.feature.a, static_cast<std::uint32_t>(axis.feature.b)),
              contact);
}

void ConvexContactSearch::nearest_contact(const HullPair& pair, double margin, ConvexContact& contact) const {
  AxisSearch::Nearest nearest;
  if (!axes_.nearest_edges(pair, margin, nearest)) {
    contact.separation = std::max(contact.separation, margin);
    return;
  }
  if (nearest.distance > coincident) {
    contact.normal = (nearest.on_b - nearest.on_a) / nearest.distance;  // in A's frame
    contact.normal_of_b = false;
    contact.separation = nearest.distance;
  }
  add_anchors(pair, nearest.on_a, nearest.on_b,
              feature_number(nearest_group, nearest.edge_a, static_cast<std::uint32_t>(nearest.edge_b)),
              contact);
}

// Overlapping by round-off, with no polygon left to clip: the deepest vertex alone.
void ConvexContactSearch::support_contact(const HullPair& pair, const Axis& axis,
                                          ConvexContact& contact) const {
  if (axis.support < 0) return;
  const bool on_a = axis.feature.kind == FeatureKind::face_a;
  const Vector3d vertex =
      on_a ? axes_.vertex_b(axis.support) : pair.a.vertices[static_cast<std::size_t>(axis.support)];
  const Vector3d other = vertex + (on_a ? -1 : 1) * axis.separation * axis.normal;
  const std::uint32_t feature = feature_number(on_a ? 0u : 0x80u, axis.support, vertex_mark);
  add_anchors(pair, on_a ? other : vertex, on_a ? vertex : other, feature, contact);
}

// The contact that goes with an axis, if the features of the axis face each other.
void ConvexContactSearch::touch(const HullPair& pair, const Axis& axis, double margin,
                                ConvexContact& contact) {
  contact.separation = axis.separation;
  contact.feature = axis.feature;
  if (axis.separation > margin) return;
  contact.normal = axis.normal;
  contact.normal_of_b = axis.feature.kind == FeatureKind::face_b;
  if (axis.feature.kind == FeatureKind::edges)
    edge_contact(pair, axis, contact);
  else
    face_contact(pair, axis, margin, contact);
}

ConvexContact ConvexContactSearch::find(const HullPair& pair, const AxisQuery& query) {
  ConvexContact contact;
  Axis axis = axes_.find(pair, query);
  touch(pair, axis, query.margin, contact);
  if (contact.count == 0 && axis.separation <= 0) {  // apart along a pruned pair of edges, or a stale hint
    axis = axes_.find_exhaustively(pair);
    touch(pair, axis, query.margin, contact);
  }
  if (contact.count == 0 && axis.separation <= query.margin) {
    if (axis.separation > -coincident)  // apart, or in one plane side by side
      nearest_contact(pair, query.margin, contact);
    else
      support_contact(pair, axis, contact);
  }
  if (contact.normal_of_b) contact.normal = pair.X_AB.linear().transpose() * contact.normal;
  return contact;
}

}  // namespace drawpoint::engine::contact::detail
