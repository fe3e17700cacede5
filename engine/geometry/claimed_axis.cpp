// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/claimed_axis.h>

#include <drawpoint/engine/geometry/hull_extremes.h>
#include <cmath>
#include <drawpoint/engine/base/checks.hpp>
#include <drawpoint/engine/base/constants.hpp>
#include <limits>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

struct Supports {
  Axis axis;               // without features
  int vertex_a, vertex_b;  // that carry it
};

Supports supports_along(const HullPair& pair, const Vector3d& n) {
  const Support high = lowest(pair.a, -n), low = lowest(pair.b, pair.X_AB.linear().transpose() * n);
  Supports result{{}, high.vertex, low.vertex};
  result.axis.normal = n;
  result.axis.support = -high.height;
  result.axis.separation = low.height + n.dot(pair.X_AB.translation()) - result.axis.support;
  return result;
}

// Calls use(edge) for every edge at the vertex, once.
template <class Use>
void for_edges_at(const CollisionHull& hull, int vertex, const Use& use) {
  for (const int f : hull.faces_around(vertex))
    for (const int e : hull.edges_of(f)) {
      const HullEdge& edge = hull.edges[e];
      if (edge.left == f && (edge.start == vertex || edge.end == vertex)) use(e);
    }
}

// The best axis of the faces and edges at the two vertices; as in AxisSearch, edges must beat a face by
// constants::face_preference.
Axis best_beside(const HullPair& pair, const Supports& at) {
  static const AxisSearch axes{};
  Axis best;
  best.separation = -std::numeric_limits<double>::infinity();
  const auto note = [&](const Feature& feature, double by) {
    const Axis axis = axes.axis_of(pair, feature);
    if (axis.feature.kind != FeatureKind::none && axis.separation > best.separation + by) best = axis;
  };
  for (const int f : pair.a.faces_around(at.vertex_a)) note({FeatureKind::face_a, f, -1}, 0);
  for (const int f : pair.b.faces_around(at.vertex_b)) note({FeatureKind::face_b, -1, f}, 0);
  for_edges_at(pair.a, at.vertex_a, [&](int ea) {
    for_edges_at(pair.b, at.vertex_b, [&](int eb) {
      const bool after_face = best.feature.kind != FeatureKind::edges;
      note({FeatureKind::edges, ea, eb}, after_face ? constants::face_preference : 0);
    });
  });
  return best;
}

bool is_best(const HullPair& pair, const Axis& axis, double margin) {
  AxisSearch axes;
  return axes.find(pair, {margin, 0, axis.feature}).separation <=
         axis.separation + constants::claim_tolerance;
}

Axis with_hysteresis(const HullPair& pair, const Axis& best, const AxisQuery& query) {
  static const AxisSearch axes{};
  if (query.hint.kind == FeatureKind::none) return best;
  const Axis last = axes.axis_of(pair, query.hint);
  const bool kept =
      last.feature.kind != FeatureKind::none && last.separation >= best.separation - query.hysteresis;
  return kept ? last : best;
}

}  // namespace

std::optional<Axis> confirmed_axis(const HullPair& pair, const AxisClaim& claim, const AxisQuery& query) {
  if (!is_unit(claim.normal) || !std::isfinite(claim.separation)) return {};
  const Supports supports = supports_along(pair, claim.normal);
  const Axis& along = supports.axis;
  if (along.separation > query.margin) return along;
  if (std::abs(along.separation - claim.separation) > constants::claim_tolerance) return {};
  const Axis best = best_beside(pair, supports);
  const bool apart = along.separation > 0;
  if (apart && best.separation <= 0) return AxisSearch().find(pair, query);
  if (!apart && best.separation < along.separation - constants::claim_tolerance) return {};
  if (!apart && !claim.bounded && !is_best(pair, best, query.margin)) return {};
  return with_hysteresis(pair, best, query);
}

}  // namespace drawpoint::engine::detail
