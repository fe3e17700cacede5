// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/collision_hull.h>
#include <Eigen/Dense>
#include <cstdint>
#include <vector>

/// Facing polygons clipped to a manifold (Sutherland and Hodgman 1974) and the choice of four points.
///
/// The incident polygon is cut by the planes on the sides of the reference face; what is left within the
/// margin of the face's own plane is the contact. Each point knows its origin, a vertex of the incident
/// polygon or a crossing of two edges, as a number that stays the same while the same features touch. All in
/// the frame of the reference shape. Cost: sides x corners; a side that does not cut copies nothing.
namespace drawpoint::engine::detail {

struct ClipPoint {
  Eigen::Vector3d position;  ///< on the incident polygon
  double gap = 0;            ///< over the reference plane
  std::uint32_t feature = 0;
};

/// Feature numbers: 12 bits for each of two indices, `vertex_mark` in place of the second for an incident
/// vertex.
constexpr std::uint32_t vertex_mark = 0xfff;
constexpr std::uint32_t feature_number(std::uint32_t group, int first, std::uint32_t second) {
  return group << 24 | (static_cast<std::uint32_t>(first) & 0xfff) << 12 | (second & 0xfff);
}

/// The deepest point and three that span a large area with it, those near its gap before those that only might
/// touch (a point counts (g₀ / (g₀ + gap − least))², g₀ = resting_margin), moved to the front; returns min(count,
/// 4). `along` is the contact normal. Ties go to the earlier point.
int reduce_to_four(std::vector<ClipPoint>& points, const Eigen::Vector3d& along);

class Clipper {
 public:
  void clear() { polygon_.clear(); }
  /// A corner of the incident polygon and its number in its shape; either sense of turning will do.
  void add_incident(const Eigen::Vector3d& position, int vertex, std::uint32_t group) {
    polygon_.push_back({position, 0, vertex, feature_number(group, vertex, vertex_mark)});
  }

  /// Clips the incident polygon to the face, keeps what is within the margin and reduces it to four points.
  /// `group`: upper byte of the feature numbers.
  const std::vector<ClipPoint>& clip(const CollisionHull& reference, int face, double margin,
                                     std::uint32_t group);

 private:
  struct Node {
    Eigen::Vector3d position;
    double beyond;  // the side that is being cut
    int edge;       // incident vertex at which the polygon edge after this node starts
    std::uint32_t feature;
  };
  void cut(const HullCorner& side, std::uint32_t group);

  std::vector<Node> polygon_, next_;
  std::vector<ClipPoint> points_;
};

}  // namespace drawpoint::engine::detail
