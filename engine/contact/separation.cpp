// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/contact/separation.hpp>

#include <algorithm>
#include <drawpoint/engine/contact/segments.hpp>
#include <limits>
#include <numeric>

namespace drawpoint::engine::contact::detail {
namespace {

using Eigen::Array4d;
using Eigen::Vector3d;

// Faces beat edge pairs that are better by less: where they tie, a face gives the richer manifold. Below the
// 1e-6 m to which depths are promised.
constexpr double face_preference = 1e-7;
// Squared sine below which two edges are parallel and some face normal stands in for their axis.
constexpr double parallel = 1e-14;

void transform(const Eigen::Isometry3d& X, const CollisionHull& hull, Eigen::ArrayXd& x, Eigen::ArrayXd& y,
               Eigen::ArrayXd& z) {
  const Eigen::Matrix3d R = X.linear();
  const Vector3d p = X.translation();
  x = R(0, 0) * hull.x + R(0, 1) * hull.y + R(0, 2) * hull.z + p.x();
  y = R(1, 0) * hull.x + R(1, 1) * hull.y + R(1, 2) * hull.z + p.y();
  z = R(2, 0) * hull.x + R(2, 1) * hull.y + R(2, 2) * hull.z + p.z();
}

int nearest_vertex(const double* distances, int count) {
  return static_cast<int>(std::min_element(distances, distances + count) - distances);
}

}  // namespace

void AxisSearch::place(const HullPair& pair) {
  transform(pair.X_AB, pair.b, bx_, by_, bz_);
  transform(pair.X_AB.inverse(), pair.a, ax_, ay_, az_);
  const auto grow = [](auto& buffer, std::size_t size) {
    if (buffer.size() < size) buffer.resize(size);
  };
  grow(to_a_, static_cast<std::size_t>(pair.a.face_count() * bx_.size()));
  grow(to_b_, static_cast<std::size_t>(pair.b.face_count() * ax_.size()));
  grow(outside_, static_cast<std::size_t>(std::max(ax_.size(), bx_.size())));
}

void AxisSearch::note_face(FeatureKind kind, int face, double separation) {
  const Feature feature = kind == FeatureKind::face_a ? Feature{kind, face, -1} : Feature{kind, -1, face};
  if (separation > best_.separation) best_.feature = feature, best_.separation = separation;
  if (feature == query_.hint) hinted_.feature = feature, hinted_.separation = separation;
}

// False as soon as a face separates the shapes by more than the margin.
bool AxisSearch::sweep_faces(const CollisionHull& hull, const Vertices& v, double margin, FeatureKind kind) {
  std::vector<double>& distances = kind == FeatureKind::face_a ? to_a_ : to_b_;
  for (int f = 0; f < hull.face_count(); ++f) {
    const Vector3d& n = hull.normals[f];
    double* row = distances.data() + f * v.count;
    Array4d least = Array4d::Constant(std::numeric_limits<double>::infinity());
    for (Eigen::Index k = 0; k < v.count; k += 4) {
      const Array4d d = n.x() * Array4d::Map(v.x + k) + n.y() * Array4d::Map(v.y + k) +
                        n.z() * Array4d::Map(v.z + k) - hull.offsets[f];
      Array4d::Map(row + k) = d;
      least = least.min(d);
    }
    note_face(kind, f, least.minCoeff());
    if (best_.separation > margin) return false;
  }
  return true;
}

// Edges of one shape that are not wholly outside one plane of the other moved out by the bound.
void AxisSearch::near_edges(const CollisionHull& hull, const CollisionHull& other,
                            const std::vector<double>& distances, std::vector<int>& result) {
  const std::size_t padded = static_cast<std::size_t>(hull.x.size());
  std::fill_n(outside_.begin(), padded, 0);
  const int planes =
      std::min(other.face_count(), 64);  // one bit a plane; planes beyond prune nothing, which is safe
  for (int f = 0; f < planes; ++f) {
    const double* row = distances.data() + f * padded;
    const std::uint64_t bit = std::uint64_t{1} << f;
    for (std::size_t k = 0; k < padded; ++k) outside_[k] |= row[k] > bound_ ? bit : 0;
  }
  const auto reaches = [&](const HullEdge& edge) {
    const std::uint64_t start = outside_[edge.start], end = outside_[edge.end];
    if (start & end) return false;
    double from = 0, to = 1;
    for (std::uint64_t cut = start | end; cut != 0; cut &= cut - 1) {
      const double* row = distances.data() + static_cast<std::size_t>(__builtin_ctzll(cut)) * padded;
      const double d0 = row[edge.start] - bound_, d1 = row[edge.end] - bound_, t = d0 / (d0 - d1);
      if (d0 > 0)
        from = std::max(from, t);
      else
        to = std::min(to, t);
    }
    return from <= to + 1e-9;  // slack for round-off: keeping an edge too many costs time only
  };
  result.clear();
  for (std::size_t e = 0; e < hull.edges.size(); ++e)
    if (reaches(hull.edges[e])) result.push_back(static_cast<int>(e));
}

// The axis of two edges, if their arcs on the Gauss map cross.
bool AxisSearch::edge_axis(const HullPair& pair, int edge_a, int edge_b, Axis& axis) const {
  const HullEdge &ea = pair.a.edges[edge_a], &eb = pair.b.edges[edge_b];
  const Vector3d along_a = pair.a.vertices[ea.end] - pair.a.vertices[ea.start];
  const Vector3d along_b = vertex_b(eb.end) - vertex_b(eb.start);
  const Vector3d b_along_a = pair.X_AB.linear().transpose() * along_a;
  const double cba = pair.b.normals[eb.left].dot(b_along_a), dba = pair.b.normals[eb.right].dot(b_along_a);
  if (cba * dba >= 0) return false;
  const double adc = pair.a.normals[ea.left].dot(along_b), bdc = pair.a.normals[ea.right].dot(along_b);
  if (adc * bdc >= 0 || cba * bdc >= 0) return false;
  Vector3d n = along_a.cross(along_b);
  const double square = n.squaredNorm();
  if (square < parallel * along_a.squaredNorm() * along_b.squaredNorm()) return false;
  n /= std::sqrt(square);
  if (n.dot(pair.a.normals[ea.left] + pair.a.normals[ea.right]) < 0) n = -n;
  axis.feature = {FeatureKind::edges, edge_a, edge_b};
  axis.normal = n;
  axis.separation = n.dot(vertex_b(eb.start) - pair.a.vertices[ea.start]);
  return true;
}

void AxisSearch::sweep_edges(const HullPair& pair) {
  Axis axis;
  Axis best_edges;
  best_edges.separation = best_.separation + face_preference;
  for (int ea : edges_a_)
    for (int eb : edges_b_) {
      if (!edge_axis(pair, ea, eb, axis)) continue;
      if (axis.separation > best_edges.separation) best_edges = axis;
      if (axis.feature == query_.hint) hinted_ = axis;
    }
  if (best_edges.feature.kind == FeatureKind::edges) best_ = best_edges;
}

// Fills in what the sweeps did not need.
void AxisSearch::complete(const HullPair& pair, Axis& axis) const {
  if (axis.feature.kind == FeatureKind::face_a) {
    axis.normal = pair.a.normals[axis.feature.a];
    axis.support = nearest_vertex(to_a_.data() + axis.feature.a * bx_.size(), pair.b.vertex_count());
  } else if (axis.feature.kind == FeatureKind::face_b) {
    axis.normal = -(pair.X_AB.linear() * pair.b.normals[axis.feature.b]);
    axis.support = nearest_vertex(to_b_.data() + axis.feature.b * ax_.size(), pair.a.vertex_count());
  }
}

Axis AxisSearch::find(const HullPair& pair, const AxisQuery& query) {
  query_ = query;
  best_ = hinted_ = Axis{};
  best_.separation = -std::numeric_limits<double>::infinity();
  place(pair);
  const Vertices of_b{bx_.data(), by_.data(), bz_.data(), bx_.size()};
  const Vertices of_a{ax_.data(), ay_.data(), az_.data(), ax_.size()};
  if (!sweep_faces(pair.a, of_b, query.margin, FeatureKind::face_a)) return best_;
  if (!sweep_faces(pair.b, of_a, query.margin, FeatureKind::face_b)) return best_;
  best_face_ = best_;
  bound_ = std::max(query.margin, -best_.separation) + face_preference;
  near_edges(pair.a, pair.b, to_b_, edges_a_);
  near_edges(pair.b, pair.a, to_a_, edges_b_);
  return finish(pair);
}

Axis AxisSearch::find_exhaustively(const HullPair& pair) {
  query_.hint = Feature{};
  hinted_ = Axis{};
  best_ = best_face_;
  const auto all = [](const CollisionHull& hull, std::vector<int>& edges) {
    edges.resize(hull.edges.size());
    std::iota(edges.begin(), edges.end(), 0);
  };
  all(pair.a, edges_a_);
  all(pair.b, edges_b_);
  return finish(pair);
}

// The edge pairs on top of the faces, and the choice between the best axis and the hint.
Axis AxisSearch::finish(const HullPair& pair) {
  sweep_edges(pair);
  if (best_.separation > query_.margin) return best_;
  const bool keep_hint =
      hinted_.feature.kind != FeatureKind::none && hinted_.separation >= best_.separation - query_.hysteresis;
  Axis& chosen = keep_hint ? hinted_ : best_;
  complete(pair, chosen);
  return chosen;
}

bool AxisSearch::nearest_edges(const HullPair& pair, double margin, Nearest& nearest) const {
  nearest.distance = std::numeric_limits<double>::infinity();
  for (int ea : edges_a_)
    for (int eb : edges_b_) {
      const HullEdge &a = pair.a.edges[ea], &b = pair.b.edges[eb];
      const auto [p, q] = nearest_points({pair.a.vertices[a.start], pair.a.vertices[a.end]},
                                         {vertex_b(b.start), vertex_b(b.end)});
      const double distance = (q - p).norm();
      if (distance < nearest.distance) nearest = {p, q, ea, eb, distance};
    }
  return nearest.distance <= margin;
}

}  // namespace drawpoint::engine::contact::detail
