// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/hull_extremes.h>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

/// By how much the faces and edges of one hull can separate it from another shape, at most, from a few points
/// of that shape.
///
/// For a normal n that a face or an edge allows, with p on that face or edge and any point q of the other
/// shape, the separation along n is at most n·(q − p). For a face that is the height of q over its plane. For
/// an edge the normals lie between those of its two faces, and the bound is the largest height of q over the
/// edge among them. q is the witness, and for edges also the lowest points over the faces that were looked at.
/// All in the hull's frame, metres. Cost: one vectorised pass over the planes, one over the edges for each point.
namespace drawpoint::engine::detail {

class SeparationBounds {
 public:
  /// Starts anew, with the witness on the other shape.
  void measure(const CollisionHull& hull, const Eigen::Vector3d& witness);
  /// A face was looked at: the lowest point of the other shape over it.
  void see(const Eigen::Vector3d& lowest);

  /// The faces that may separate by more than `least`, and the edges; valid until the next of these calls.
  std::span<const HullBound> faces(const CollisionHull& hull, double least);
  std::span<const HullBound> edges(const CollisionHull& hull, double least);

 private:
  std::array<Eigen::Vector3d, most_points> points_;  // of the other shape, the witness first
  std::size_t count_ = 0;
  std::vector<HullBound> found_;
};

inline void SeparationBounds::measure(const CollisionHull& hull, const Eigen::Vector3d& witness) {
  found_.resize(std::max(found_.size(), hull.edges.size()));  // a hull has fewer faces than edges
  points_[0] = witness;
  count_ = 1;
}

// More points tighten the bounds less and less.
inline void SeparationBounds::see(const Eigen::Vector3d& lowest) {
  if (count_ < most_points) points_[count_++] = lowest;
}

inline std::span<const HullBound> SeparationBounds::faces(const CollisionHull& hull, double least) {
  const int size = faces_over(hull, points_[0], least, found_.data());
  return std::span(found_).first(static_cast<std::size_t>(size));
}

inline std::span<const HullBound> SeparationBounds::edges(const CollisionHull& hull, double least) {
  const int size = edges_over(hull, std::span(points_).first(count_), least, found_.data());
  return std::span(found_).first(static_cast<std::size_t>(size));
}

}  // namespace drawpoint::engine::detail
