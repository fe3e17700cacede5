// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/separation.h>

#include <drawpoint/engine/geometry/hull_extremes.h>
#include <drawpoint/engine/geometry/segments.h>
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <limits>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

// The point of a face's polygon that lies next to a point of its plane, on the line to the face's middle.
Vector3d within(const CollisionHull& hull, int face, const Vector3d& p) {
  const Vector3d &middle = hull.middles[face], out = p - middle;
  double share = 1;
  for (const HullCorner& corner : hull.corners(face)) {
    const double across = corner.outward.dot(out), room = corner.offset - corner.outward.dot(middle);
    if (across * share > room) share = room / across;
  }
  return middle + share * out;
}

// Descending by `most`; short lists.
template <class Edge>
void sort_by_most(std::vector<Edge>& edges) {
  for (std::size_t k = 1; k < edges.size(); ++k)
    for (std::size_t j = k; j > 0 && edges[j].most > edges[j - 1].most; --j)
      std::swap(edges[j], edges[j - 1]);
}

}  // namespace

Axis AxisSearch::face_of_a(const HullPair& pair, int face) const {
  Axis axis;
  axis.feature = {FeatureKind::face_a, face, -1};
  axis.normal = pair.a.normals[face];
  axis.support = pair.a.offsets[face];
  const Support low = lowest(pair.b, pair.X_AB.linear().transpose() * axis.normal);
  axis.separation = low.height + axis.normal.dot(pair.X_AB.translation()) - axis.support;
  axis.vertex = low.vertex;
  return axis;
}

Axis AxisSearch::face_of_b(const HullPair& pair, int face) const {
  Axis axis;
  axis.feature = {FeatureKind::face_b, -1, face};
  const Vector3d inward = pair.X_AB.linear() * pair.b.normals[face];
  axis.normal = -inward;
  const Support low = lowest(pair.a, inward);
  axis.support = -low.height;
  axis.separation = low.height - inward.dot(pair.X_AB.translation()) - pair.b.offsets[face];
  axis.vertex = low.vertex;
  return axis;
}

// The axis of two edges, if their arcs on the Gauss map cross.
bool AxisSearch::edge_axis(const HullPair& pair, const EdgeOfA& first, const EdgeOfB& second,
                           Axis& axis) const {
  const HullEdge &ea = pair.a.edges[first.edge], &eb = pair.b.edges[second.edge];
  const double cba = pair.b.normals[eb.left].dot(first.along_in_b),
               dba = pair.b.normals[eb.right].dot(first.along_in_b);
  if (cba * dba >= 0) return false;
  const double adc = pair.a.normals[ea.left].dot(second.along),
               bdc = pair.a.normals[ea.right].dot(second.along);
  if (adc * bdc >= 0 || cba * bdc >= 0) return false;
  Vector3d n = ea.along.cross(second.along);
  const double square = n.squaredNorm();
  if (square < constants::parallel_edges * ea.along.squaredNorm() * second.along.squaredNorm()) return false;
  n /= std::sqrt(square);
  if (n.dot(pair.a.normals[ea.left] + pair.a.normals[ea.right]) < 0) n = -n;
  axis.feature = {FeatureKind::edges, first.edge, second.edge};
  axis.normal = n;
  axis.support = n.dot(pair.a.vertices[ea.start]);
  axis.separation = n.dot(second.start) - axis.support;
  return true;
}

Axis AxisSearch::axis_of(const HullPair& pair, const Feature& feature) const {
  if (feature.kind == FeatureKind::face_a) return face_of_a(pair, feature.a);
  if (feature.kind == FeatureKind::face_b) return face_of_b(pair, feature.b);
  Axis axis;
  if (feature.kind == FeatureKind::edges) {
    const Eigen::Matrix3d R = pair.X_AB.linear();
    const HullEdge& eb = pair.b.edges[feature.b];
    edge_axis(pair, {feature.a, 0, R.transpose() * pair.a.edges[feature.a].along},
              {feature.b, 0, R * eb.along, pair.vertex_b(eb.start)}, axis);
  }
  return axis;
}

AxisSearch::Witness AxisSearch::witness_of(const HullPair& pair, const Axis& axis) const {
  if (axis.feature.kind == FeatureKind::face_a) {
    const Vector3d on_b = pair.vertex_b(axis.vertex);
    return {within(pair.a, axis.feature.a, on_b - axis.separation * axis.normal), on_b};
  }
  if (axis.feature.kind == FeatureKind::face_b) {
    const Vector3d on_a = pair.a.vertices[axis.vertex];
    const Vector3d in_b =
        pair.X_AB.linear().transpose() * (on_a + axis.separation * axis.normal - pair.X_AB.translation());
    return {on_a, pair.X_AB * within(pair.b, axis.feature.b, in_b)};
  }
  const HullEdge &ea = pair.a.edges[axis.feature.a], &eb = pair.b.edges[axis.feature.b];
  const auto [on_a, on_b] = nearest_points({pair.a.vertices[ea.start], pair.a.vertices[ea.end]},
                                           {pair.vertex_b(eb.start), pair.vertex_b(eb.end)});
  return {on_a, on_b};
}

// The hint, or the line of centres, which has no features but bounds what can win: shapes that overlap do so
// by no more along the best axis, and some axis does not overlap when they are apart.
Axis AxisSearch::guess(const HullPair& pair, Witness& witness) {
  Axis axis = axis_of(pair, query_.hint);
  floor_ = axis.separation;
  if (axis.feature.kind != FeatureKind::none) {
    witness = witness_of(pair, axis);
    return axis;
  }
  const Vector3d line = pair.X_AB * pair.b.centre - pair.a.centre;
  const double length = line.norm();
  axis.normal = length > constants::coincident ? Vector3d(line / length) : Vector3d::UnitZ();
  const Support high = lowest(pair.a, -axis.normal),
                low = lowest(pair.b, pair.X_AB.linear().transpose() * axis.normal);
  axis.support = -high.height;
  axis.separation = low.height + axis.normal.dot(pair.X_AB.translation()) - axis.support;
  floor_ = std::min(axis.separation, 0.0) - constants::face_preference;
  witness = {pair.a.vertices[high.vertex], pair.vertex_b(low.vertex)};
  return axis;
}

// False as soon as a face separates the shapes by more than the margin.
bool AxisSearch::search_faces(const HullPair& pair, const Witness& witness) {
  const auto note = [this](const Axis& axis) {
    if (axis.separation > best_.separation) {
      best_ = axis;
      floor_ = std::max(floor_, axis.separation);
    }
    return axis.separation <= query_.margin;
  };
  // The first guess is not looked at twice.
  const auto see_a = [&](int f) {
    const bool known = best_.feature.kind == FeatureKind::face_a && best_.feature.a == f;
    const Axis axis = known ? best_ : face_of_a(pair, f);
    bounds_a_.see(pair.vertex_b(axis.vertex));
    return note(axis);
  };
  const auto see_b = [&](int f) {
    const bool known = best_.feature.kind == FeatureKind::face_b && best_.feature.b == f;
    const Axis axis = known ? best_ : face_of_b(pair, f);
    bounds_b_.see(pair.in_b(pair.a.vertices[axis.vertex]));
    return note(axis);
  };
  bounds_a_.measure(pair.a, witness.on_b);
  bounds_b_.measure(pair.b, pair.in_b(witness.on_a));
  // The floor rises while faces are looked at.
  const auto may_win = [this](const HullBound& face) {
    return face.most > floor_ - constants::height_round_off;
  };
  for (const HullBound& face : bounds_a_.faces(pair.a, floor_ - constants::height_round_off))
    if (may_win(face) && !see_a(face.feature)) return false;
  for (const HullBound& face : bounds_b_.faces(pair.b, floor_ - constants::height_round_off))
    if (may_win(face) && !see_b(face.feature)) return false;
  return true;
}

// The best pair of edges, if one separates by more than `best_edges` already does.
void AxisSearch::search_edges(const HullPair& pair, Axis& best_edges) {
  const Eigen::Matrix3d R = pair.X_AB.linear();
  const double least = best_edges.separation;
  edges_a_.clear();
  edges_b_.clear();
  for (const auto& [e, most] : bounds_a_.edges(pair.a, least))
    edges_a_.push_back({e, most, R.transpose() * pair.a.edges[e].along});
  if (edges_a_.empty()) return;
  for (const auto& [e, most] : bounds_b_.edges(pair.b, least))
    edges_b_.push_back({e, most, R * pair.b.edges[e].along, pair.vertex_b(pair.b.edges[e].start)});
  sort_by_most(edges_a_);
  sort_by_most(edges_b_);
  Axis axis;
  for (const EdgeOfA& ea : edges_a_)
    for (const EdgeOfB& eb : edges_b_) {
      if (std::min(ea.most, eb.most) <= best_edges.separation) break;
      if (edge_axis(pair, ea, eb, axis) && axis.separation > best_edges.separation) best_edges = axis;
    }
}

Axis AxisSearch::find(const HullPair& pair, const AxisQuery& query) {
  query_ = query;
  Witness witness;
  const Axis first = guess(pair, witness);
  if (first.separation > query.margin) return first;
  const bool hinted = first.feature.kind != FeatureKind::none,
             by_edges = first.feature.kind == FeatureKind::edges;
  best_ = hinted && !by_edges ? first : Axis{};
  if (hinted == by_edges) best_.separation = -infinity;  // no face yet
  if (by_edges) floor_ -= constants::face_preference;    // a face may win that is worse by less
  if (!search_faces(pair, witness)) return best_;
  const bool edges_lead = by_edges && first.separation > best_.separation + constants::face_preference;
  Axis best_edges = edges_lead ? first : Axis{};
  if (!edges_lead) best_edges.separation = best_.separation + constants::face_preference;
  search_edges(pair, best_edges);
  if (best_edges.feature.kind == FeatureKind::edges) best_ = best_edges;
  if (best_.separation > query.margin) return best_;
  return hinted && first.separation >= best_.separation - query.hysteresis ? first : best_;
}

bool AxisSearch::nearest_edges(const HullPair& pair, const Axis& axis, double margin, Nearest& nearest) {
  // Only points in the slab between the shapes, widened to the margin, can be that near.
  const Vector3d n_b = pair.X_AB.linear().transpose() * axis.normal;
  const double over = axis.normal.dot(pair.X_AB.translation());
  const auto high = [&](int v) {
    return axis.normal.dot(pair.a.vertices[v]) >=
           axis.support + axis.separation - margin - constants::height_round_off;
  };
  const auto low = [&](int v) {
    return n_b.dot(pair.b.vertices[v]) + over <= axis.support + margin + constants::height_round_off;
  };
  edges_b_.clear();
  for (std::size_t e = 0; e < pair.b.edges.size(); ++e) {
    const HullEdge& edge = pair.b.edges[e];
    if (low(edge.start) || low(edge.end))
      edges_b_.push_back(
          {static_cast<int>(e), 0, pair.X_AB.linear() * edge.along, pair.vertex_b(edge.start)});
  }
  nearest.distance = infinity;
  for (std::size_t e = 0; e < pair.a.edges.size(); ++e) {
    const HullEdge& a = pair.a.edges[e];
    if (!high(a.start) && !high(a.end)) continue;
    for (const EdgeOfB& b : edges_b_) {
      const auto [p, q] =
          nearest_points({pair.a.vertices[a.start], pair.a.vertices[a.end]}, {b.start, b.start + b.along});
      const double distance = (q - p).norm();
      if (distance < nearest.distance) nearest = {p, q, static_cast<int>(e), b.edge, distance};
    }
  }
  return nearest.distance <= margin;
}

}  // namespace drawpoint::engine::detail
