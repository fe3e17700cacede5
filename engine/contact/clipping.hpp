// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <vector>

/// Facing polygons clipped to a manifold (Sutherland and Hodgman 1974) and the choice of four points.
///
/// The incident polygon is cut by the planes through the edges of the reference polygon along its normal;
/// what is left within the margin of the reference plane is the contact. Each point knows its origin, a
/// vertex of the incident polygon or a crossing of two edges, as a number that stays the same while the same
/// features touch.
namespace drawpoint::engine::contact::detail {

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

/// The deepest point and the three that span the largest area with it, moved to the front; returns min(count,
/// 4). `along` is the contact normal. Ties go to the earlier point.
int reduce_to_four(std::vector<ClipPoint>& points, const Eigen::Vector3d& along);

class Clipper {
 public:
  struct Corner {
    Eigen::Vector3d position;
    int index;  ///< of the vertex in its shape
  };
  void clear();
  void add_reference(const Corner& corner) { reference_.push_back(corner); }
  void add_incident(const Corner& corner) { incident_.push_back(corner); }

  /// Clips the incident polygon to the reference polygon (counter-clockwise about its outward normal), keeps
  /// what is within the margin and reduces it to four points. `group`: upper byte of the feature numbers.
  const std::vector<ClipPoint>& clip(const Eigen::Vector3d& normal, double margin, std::uint32_t group);

 private:
  struct Node {
    Eigen::Vector3d position;
    int edge;  // incident vertex at which the polygon edge after this node starts
    std::uint32_t feature;
  };
  void cut(const Corner& from, const Corner& to, const Eigen::Vector3d& normal, std::uint32_t group);

  std::vector<Corner> reference_, incident_;
  std::vector<Node> polygon_, next_;
  std::vector<ClipPoint> points_;
};

}  // namespace drawpoint::engine::contact::detail
