// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/geometry/convex_polyhedron.hpp>
#include <limits>
#include <random>
#include <utility>
#include <vector>

/// Slow and plain answers about two convex polyhedra in the world, to test the contact finder against.
/// Nothing is pruned: all face normals and all edge pairs are axes, and the distance is the least over all
/// vertex-face and edge-edge pairs.
namespace drawpoint::support {

using Eigen::Vector3d;
using engine::ConvexPolyhedron;

/// min over B minus max over A along the unit direction n.
inline double separation_along(const ConvexPolyhedron& a, const ConvexPolyhedron& b, const Vector3d& n) {
  double top = -std::numeric_limits<double>::infinity(), bottom = -top;
  for (const Vector3d& p : a.vertices()) top = std::max(top, n.dot(p));
  for (const Vector3d& p : b.vertices()) bottom = std::min(bottom, n.dot(p));
  return bottom - top;
}

inline std::vector<std::pair<Vector3d, Vector3d>> edges_of(const ConvexPolyhedron& shape) {
  std::vector<std::pair<Vector3d, Vector3d>> edges;
  for (const auto& face : shape.faces())
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int from = face[k], to = face[(k + 1) % face.size()];
      if (from < to) edges.emplace_back(shape.vertices()[from], shape.vertices()[to]);
    }
  return edges;
}

/// The larger of the separations along n and -n.
inline double separation_either_way(const ConvexPolyhedron& a, const ConvexPolyhedron& b, const Vector3d& n) {
  const auto range = [&](const ConvexPolyhedron& shape) {
    std::pair<double, double> r(std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity());
    for (const Vector3d& p : shape.vertices()) {
      const double height = n.dot(p);
      r = {std::min(r.first, height), std::max(r.second, height)};
    }
    return r;
  };
  const auto [a_low, a_high] = range(a);
  const auto [b_low, b_high] = range(b);
  return std::max(b_low - a_high, a_low - b_high);
}

/// The largest separation over all axes of the separating-axis theorem: minus the penetration depth, if
/// negative.
inline double best_separation(const ConvexPolyhedron& a, const ConvexPolyhedron& b) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Vector3d& n : a.face_normals()) best = std::max(best, separation_along(a, b, n));
  for (const Vector3d& n : b.face_normals()) best = std::max(best, separation_along(a, b, -n));
  const auto edges_a = edges_of(a), edges_b = edges_of(b);
  for (const auto& [p, q] : edges_a)
    for (const auto& [r, s] : edges_b) {
      const Vector3d n = (q - p).normalized().cross((s - r).normalized());
      if (n.norm() > 1e-7) best = std::max(best, separation_either_way(a, b, n.normalized()));
    }
  return best;
}

inline double vertex_face_distance(const ConvexPolyhedron& vertices, const ConvexPolyhedron& faces) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < faces.faces().size(); ++f) {
    const auto& face = faces.faces()[f];
    const Vector3d& n = faces.face_normals()[f];
    for (const Vector3d& p : vertices.vertices()) {
      bool above = true;
      for (std::size_t k = 0; k < face.size(); ++k) {
        const Vector3d &from = faces.vertices()[face[k]], &to = faces.vertices()[face[(k + 1) % face.size()]];
        above = above && (to - from).cross(n).dot(p - from) <= 0;
      }
      const double height = n.dot(p - faces.vertices()[face[0]]);
      if (above && height > -1e-12)
        best = std::min(best, std::max(height, 0.0));  // in the plane, up to round-off
    }
  }
  return best;
}

/// Nearest distance of two segments, by the interior solution if there is one and the four end points
/// otherwise.
inline double segment_distance(const std::pair<Vector3d, Vector3d>& e,
                               const std::pair<Vector3d, Vector3d>& f) {
  const auto to_segment = [](const Vector3d& p, const std::pair<Vector3d, Vector3d>& s) {
    const Vector3d along = s.second - s.first;
    const double t = std::clamp((p - s.first).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - s.first - t * along).norm();
  };
  double best = std::min(
      {to_segment(e.first, f), to_segment(e.second, f), to_segment(f.first, e), to_segment(f.second, e)});
  // The interior solution: |x + s u - t v| least, by Cramer's rule; parallel segments have none of their own.
  const Vector3d u = e.second - e.first, v = f.second - f.first, x = e.first - f.first;
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm(), determinant = uu * vv - uv * uv;
  if (determinant <= 1e-14 * uu * vv) return best;
  const double s = (uv * v.dot(x) - vv * u.dot(x)) / determinant,
               t = (uu * v.dot(x) - uv * u.dot(x)) / determinant;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, (x + s * u - t * v).norm());
  return best;
}

/// Distance of two polyhedra that do not overlap; of two that do, however little, their features may be far
/// from each other and this is no answer.
inline double distance(const ConvexPolyhedron& a, const ConvexPolyhedron& b) {
  double best = std::min(vertex_face_distance(a, b), vertex_face_distance(b, a));
  const auto edges_a = edges_of(a), edges_b = edges_of(b);
  for (const auto& e : edges_a)
    for (const auto& f : edges_b) best = std::min(best, segment_distance(e, f));
  return best;
}

/// Distance of two polyhedra whose best separation is known: 0 when they overlap.
inline double distance(const ConvexPolyhedron& a, const ConvexPolyhedron& b, double separation) {
  return separation > 0 ? std::max(separation, distance(a, b)) : 0;
}

/// One candidate of the separating-axis theorem.
struct ScoredAxis {
  Vector3d normal;  ///< unit, from A to B
  double separation;
};

/// All candidates, nothing pruned: face normals and all edge pairs both ways. The same answer as
/// best_separation(), fast enough for a million pairs: extents are taken over plain arrays.
inline void all_axes(const ConvexPolyhedron& a, const ConvexPolyhedron& b, std::vector<ScoredAxis>& axes) {
  const auto flat = [](const ConvexPolyhedron& shape) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> points(shape.vertices().size(), 3);
    for (std::size_t k = 0; k < shape.vertices().size(); ++k)
      points.row(static_cast<Eigen::Index>(k)) = shape.vertices()[k].transpose();
    return points;
  };
  const auto points_a = flat(a), points_b = flat(b);
  Eigen::ArrayXd along_a(points_a.rows()), along_b(points_b.rows());
  const auto project = [&](const Vector3d& n) {
    along_a =
        points_a.col(0).array() * n.x() + points_a.col(1).array() * n.y() + points_a.col(2).array() * n.z();
    along_b =
        points_b.col(0).array() * n.x() + points_b.col(1).array() * n.y() + points_b.col(2).array() * n.z();
  };
  axes.clear();
  for (const Vector3d& n : a.face_normals()) {
    project(n);
    axes.push_back({n, along_b.minCoeff() - along_a.maxCoeff()});
  }
  for (const Vector3d& n : b.face_normals()) {
    project(n);
    axes.push_back({-n, along_a.minCoeff() - along_b.maxCoeff()});
  }
  const auto edges_a = edges_of(a), edges_b = edges_of(b);
  for (const auto& [p, q] : edges_a)
    for (const auto& [r, s] : edges_b) {
      const Vector3d across = (q - p).cross(s - r);
      const double square = across.squaredNorm();
      if (square <= 1e-14 * (q - p).squaredNorm() * (s - r).squaredNorm()) continue;
      const Vector3d n = across / std::sqrt(square);
      project(n);
      const double there = along_b.minCoeff() - along_a.maxCoeff(),
                   back = along_a.minCoeff() - along_b.maxCoeff();
      axes.push_back(there >= back ? ScoredAxis{n, there} : ScoredAxis{-n, back});
    }
}

inline Eigen::Quaterniond random_rotation(std::mt19937& rng) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q;
  do q.coeffs() = Eigen::Vector4d::NullaryExpr([&] { return normal(rng); });
  while (q.norm() < 1e-3);
  return q.normalized();
}

}  // namespace drawpoint::support
