// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/collision_hull.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

constexpr double unbounded = std::numeric_limits<double>::infinity();

std::vector<HullEdge> edges_of(const std::vector<std::vector<int>>& faces, const CollisionHull& hull) {
  std::map<std::pair<int, int>, int> left;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < faces[f].size(); ++k)
      left[{faces[f][k], faces[f][(k + 1) % faces[f].size()]}] = static_cast<int>(f);
  std::vector<HullEdge> edges;
  for (const auto& [ends, face] : left) {
    const auto [start, end] = ends;
    if (start > end) continue;
    const int right = left.at({end, start});
    const Vector3d along = hull.vertices[end] - hull.vertices[start];
    edges.push_back({start, end, face, right, along, along.cross(hull.normals[face]).normalized(),
                     hull.normals[right].cross(along).normalized()});
  }
  return edges;
}

}  // namespace

CollisionHull::CollisionHull(const ConvexPolyhedron& shape)
    : vertices(shape.vertices()),
      normals(shape.face_normals()),
      edges(detail::edges_of(shape.faces(), *this)),
      centre(Vector3d::Zero()),
      radius(0),
      inner_radius(0),
      reach(0),
      equivalent_radius(std::cbrt(3 * shape.volume() / (4 * std::numbers::pi))) {
  for (const Vector3d& normal : normals) {
    // The outermost vertex, not the first: all vertices lie below every plane whatever the round-off.
    double offset = -unbounded;
    for (const Vector3d& p : vertices) offset = std::max(offset, normal.dot(p));
    offsets.push_back(offset);
  }
  for (const Vector3d& p : vertices) centre += p / vertex_count();
  for (const Vector3d& p : vertices) {
    radius = std::max(radius, (p - centre).norm());
    reach = std::max(reach, p.norm());
  }
  inner_radius = shape.depth(centre);
  index(shape.faces());
  lay_out();
  assert(vertex_count() + face_count() == static_cast<int>(edges.size()) + 2 && "a closed hull (Euler)");
}

void CollisionHull::index(const std::vector<std::vector<int>>& faces) {
  std::map<std::pair<int, int>, int> edge_at;
  for (std::size_t e = 0; e < edges.size(); ++e)
    edge_at[{edges[e].start, edges[e].end}] = edge_at[{edges[e].end, edges[e].start}] = static_cast<int>(e);
  std::vector<std::vector<int>> around(vertices.size());
  face_begin_.push_back(0), around_begin_.push_back(0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    middles.push_back(Vector3d::Zero());
    for (std::size_t k = 0; k < faces[f].size(); ++k) {
      const int from = faces[f][k], to = faces[f][(k + 1) % faces[f].size()], edge = edge_at.at({from, to});
      const Vector3d& outward =
          edges[edge].left == static_cast<int>(f) ? edges[edge].beyond_left : edges[edge].beyond_right;
      corners_.push_back({from, outward, outward.dot(vertices[from])});
      face_edges_.push_back(edge);
      middles[f] += vertices[from] / static_cast<double>(faces[f].size());
      around[from].push_back(static_cast<int>(f));
    }
    face_begin_.push_back(static_cast<int>(corners_.size()));
  }
  for (const auto& at : around) {
    around_.insert(around_.end(), at.begin(), at.end());
    around_begin_.push_back(static_cast<int>(around_.size()));
  }
}

void CollisionHull::lay_out() {
  const auto padded = [](std::size_t count, int to) { return (static_cast<int>(count) + to - 1) / to * to; };
  for (auto* array : {&x, &y, &z}) array->resize(padded(vertices.size(), 4));
  for (int k = 0; k < x.size(); ++k) {
    const Vector3d& p = vertices[std::min(k, vertex_count() - 1)];
    x[k] = p.x(), y[k] = p.y(), z[k] = p.z();
  }
  face_planes.setZero(padded(normals.size(), padding), 4);
  for (int f = 0; f < face_count(); ++f) {
    face_planes.row(f).head<3>() = normals[f].cast<float>();
    face_planes(f, 3) = static_cast<float>(offsets[f]);
  }
  edge_frames.setZero(padded(edges.size(), padding), 15);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const HullEdge& edge = edges[e];
    const Vector3d* const frame[] = {&vertices[edge.start], &normals[edge.left], &normals[edge.right],
                                     &edge.beyond_left, &edge.beyond_right};
    for (int k = 0; k < 5; ++k) edge_frames.row(e).segment<3>(3 * k) = frame[k]->cast<float>();
  }
}

}  // namespace drawpoint::engine::detail
