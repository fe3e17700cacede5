// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/contact/clipping.hpp>

#include <algorithm>
#include <cmath>

namespace drawpoint::engine::contact::detail {
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

int reduce_to_four(std::vector<ClipPoint>& points, const Vector3d& along) {
  const int count = static_cast<int>(points.size());
  if (count <= 4) return count;
  const auto deeper = [](const ClipPoint& p, const ClipPoint& q) { return p.gap < q.gap; };
  std::swap(points[0], *std::min_element(points.begin(), points.end(), deeper));
  const auto position = [&](std::size_t k) -> const Vector3d& { return points[k].position; };
  if (!promote(points, 1, [&](const ClipPoint& p) { return (p.position - position(0)).squaredNorm(); }))
    return 1;
  const auto area = [&](const Vector3d& from, const Vector3d& to, const Vector3d& p) {
    return along.dot((to - from).cross(p - from));
  };
  if (!promote(points, 2,
               [&](const ClipPoint& p) { return std::abs(area(position(0), position(1), p.position)); }))
    return 2;
  // The fourth adds the most area outside the triangle of the first three.
  if (area(position(0), position(1), position(2)) < 0) std::swap(points[1], points[2]);
  const bool wider = promote(points, 3, [&](const ClipPoint& p) {
    return -std::min({area(position(0), position(1), p.position), area(position(1), position(2), p.position),
                      area(position(2), position(0), p.position)});
  });
  return wider ? 4 : 3;
}

void Clipper::clear() {
  reference_.clear();
  incident_.clear();
}

// Keeps the part of the polygon on the inner side of the plane through one reference edge.
void Clipper::cut(const Corner& from, const Corner& to, const Vector3d& normal, std::uint32_t group) {
  const Vector3d outward = (to.position - from.position).cross(normal);
  const double offset = outward.dot(from.position);
  next_.clear();
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Node &here = polygon_[k], &ahead = polygon_[(k + 1) % polygon_.size()];
    const double d = outward.dot(here.position) - offset, e = outward.dot(ahead.position) - offset;
    if (d <= 0) next_.push_back(here);
    if ((d <= 0) == (e <= 0)) continue;
    // A crossing on the way out goes on along the reference edge, one on the way in along its own edge.
    const Vector3d crossing = here.position + d / (d - e) * (ahead.position - here.position);
    const int onward = d <= 0 ? reference_mark | from.index : here.edge;
    next_.push_back(
        {crossing, onward, feature_number(group, here.edge, static_cast<std::uint32_t>(from.index))});
  }
  polygon_.swap(next_);
}

const std::vector<ClipPoint>& Clipper::clip(const Vector3d& normal, double margin, std::uint32_t group) {
  polygon_.clear();
  for (const Corner& c : incident_)
    polygon_.push_back({c.position, c.index, feature_number(group, c.index, vertex_mark)});
  for (std::size_t k = 0; k < reference_.size() && !polygon_.empty(); ++k)
    cut(reference_[k], reference_[(k + 1) % reference_.size()], normal, group);
  points_.clear();
  for (const Node& node : polygon_) {
    const double gap = normal.dot(node.position - reference_[0].position);
    if (gap <= margin) points_.push_back({node.position, gap, node.feature});
  }
  points_.resize(static_cast<std::size_t>(reduce_to_four(points_, normal)));
  return points_;
}

}  // namespace drawpoint::engine::contact::detail
