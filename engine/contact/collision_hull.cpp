// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/contact/collision_hull.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace drawpoint::engine::contact::detail {
namespace {

std::vector<HullEdge> edges_of(const std::vector<std::vector<int>>& faces) {
  std::map<std::pair<int, int>, int> left;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < faces[f].size(); ++k)
      left[{faces[f][k], faces[f][(k + 1) % faces[f].size()]}] = static_cast<int>(f);
  std::vector<HullEdge> edges;
  for (const auto& [ends, face] : left)
    if (ends.first < ends.second)
      edges.push_back({ends.first, ends.second, face, left.at({ends.second, ends.first})});
  return edges;
}

}  // namespace

CollisionHull::CollisionHull(const ConvexPolyhedron& shape)
    : vertices(shape.vertices()),
      normals(shape.face_normals()),
      faces(shape.faces()),
      faces_at(vertices.size()),
      edges(edges_of(faces)),
      centre(Eigen::Vector3d::Zero()),
      radius(0),
      equivalent_radius(std::cbrt(3 * shape.volume() / (4 * std::numbers::pi))) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    // The outermost vertex, not the first: all vertices lie below every plane whatever the round-off.
    double offset = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& p : vertices) offset = std::max(offset, normals[f].dot(p));
    offsets.push_back(offset);
    for (int v : faces[f]) faces_at[v].push_back(static_cast<int>(f));
  }
  for (const Eigen::Vector3d& p : vertices) centre += p / vertex_count();
  for (const Eigen::Vector3d& p : vertices) radius = std::max(radius, (p - centre).norm());
  const Eigen::Index padded = (vertex_count() + 3) / 4 * 4;
  x.resize(padded), y.resize(padded), z.resize(padded);
  for (Eigen::Index k = 0; k < padded; ++k) {
    const Eigen::Vector3d& p = vertices[std::min<Eigen::Index>(k, vertex_count() - 1)];
    x[k] = p.x(), y[k] = p.y(), z[k] = p.z();
  }
}

}  // namespace drawpoint::engine::contact::detail
