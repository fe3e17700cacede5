// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/collision_hull.h>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
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

/// The points that were chosen last time. A body that rests on five points would rock if the choice of four followed
/// each micrometre of their gaps: the one left out sinks until it is chosen again, for ever.
struct KeptPoints {
  std::array<std::uint32_t, 4> features{};
  int count = 0;
  double within = 0;  ///< [m] by how much another point must be deeper to be the first

  bool has(std::uint32_t feature) const {
    return std::find(features.begin(), features.begin() + count, feature) != features.begin() + count;
  }
};

/// The deepest point and three that span a large area with it, those near its gap before those that only might
/// touch (a point counts (g₀ / (g₀ + gap − least))², g₀ = resting_margin, and `kept_points` times as much if it was
/// chosen last time), moved to the front; returns min(count, 4). `along` is the contact normal. Ties go to the
/// earlier point.
int reduce_to_four(std::vector<ClipPoint>& points, const Eigen::Vector3d& along, const KeptPoints& kept = {});

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
