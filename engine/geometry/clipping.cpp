// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/geometry/clipping.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

constexpr int reference_mark =
    0x800;  // tells the edges of the reference polygon from those of the incident one

// Moves to `place` the point of largest score among those from `place` on; false when none scores above zero.
template <class Score>
bool promote(std::vector<ClipPoint>& points, std::size_t place, const Score& score) {
  std::size_t best = place;
  double best_score = 0;
  for (std::size_t k = place; k < points.size(); ++k)
    if (const double s = score(points[k]); s > best_score) best = k, best_score = s;
  std::swap(points[place], points[best]);
  return best_score > 0;
}

}  // namespace

int reduce_to_four(std::vector<ClipPoint>& points, const Vector3d& along, const KeptPoints& kept) {
  const int count = static_cast<int>(points.size());
  if (count <= 4) return count;
  const auto depth = [&](const ClipPoint& p) { return p.gap - (kept.has(p.feature) ? kept.within : 0.0); };
  const auto deeper = [&](const ClipPoint& p, const ClipPoint& q) { return depth(p) < depth(q); };
  std::swap(points[0], *std::min_element(points.begin(), points.end(), deeper));
  double deepest = points[0].gap;
  for (const ClipPoint& p : points) deepest = std::min(deepest, p.gap);
  const auto weight = [&](const ClipPoint& p) {
    const double near = constants::resting_margin / (constants::resting_margin + (p.gap - deepest));
    return near * near * (kept.has(p.feature) ? constants::kept_points : 1.0);
  };
  const auto position = [&](std::size_t k) -> const Vector3d& { return points[k].position; };
  if (!promote(points, 1,
               [&](const ClipPoint& p) { return weight(p) * (p.position - position(0)).squaredNorm(); }))
    return 1;
  const auto area = [&](const Vector3d& from, const Vector3d& to, const Vector3d& p) {
    return along.dot((to - from).cross(p - from));
  };
  if (!promote(points, 2, [&](const ClipPoint& p) {
        return weight(p) * std::abs(area(position(0), position(1), p.position));
      }))
    return 2;
  // The fourth adds the most area outside the triangle of the first three.
  if (area(position(0), position(1), position(2)) < 0) std::swap(points[1], points[2]);
  const bool wider = promote(points, 3, [&](const ClipPoint& p) {
    return -weight(p) *
           std::min({area(position(0), position(1), p.position), area(position(1), position(2), p.position),
                     area(position(2), position(0), p.position)});
  });
  return wider ? 4 : 3;
}

// Keeps the part of the polygon on the inner side of the plane that stands on one side of the reference face.
void Clipper::cut(const HullCorner& side, std::uint32_t group) {
  bool crosses = false;
  for (Node& node : polygon_) {
    node.beyond = side.outward.dot(node.position) - side.offset;
    crosses = crosses || node.beyond > 0;
  }
  if (!crosses) return;
  next_.clear();
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Node &here = polygon_[k], &ahead = polygon_[k + 1 < polygon_.size() ? k + 1 : 0];
    if (here.beyond <= 0) next_.push_back(here);
    if ((here.beyond <= 0) == (ahead.beyond <= 0)) continue;
    // A crossing on the way out goes on along the reference edge, one on the way in along its own edge.
    const double share = here.beyond / (here.beyond - ahead.beyond);
    const int onward = here.beyond <= 0 ? reference_mark | side.vertex : here.edge;
    next_.push_back({here.position + share * (ahead.position - here.position), 0, onward,
                     feature_number(group, here.edge, static_cast<std::uint32_t>(side.vertex))});
  }
  polygon_.swap(next_);
}

const std::vector<ClipPoint>& Clipper::clip(const CollisionHull& reference, int face, double margin,
                                            std::uint32_t group) {
  for (const HullCorner& side : reference.corners(face)) cut(side, group);
  points_.clear();
  const Vector3d& normal = reference.normals[static_cast<std::size_t>(face)];
  const double offset = reference.offsets[static_cast<std::size_t>(face)];
  for (const Node& node : polygon_) {
    const double gap = normal.dot(node.position) - offset;
    if (gap <= margin) points_.push_back({node.position, gap, node.feature});
  }
  points_.resize(static_cast<std::size_t>(reduce_to_four(points_, normal)));
  return points_;
}

}  // namespace drawpoint::engine::detail
