// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/hull_extremes.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
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
  static double most_over(const CollisionHull& hull, const HullEdge& edge, const Eigen::Vector3d& p);
  bool rules_out(const CollisionHull& hull, const HullEdge& edge, double least) const;

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

// The most that a point lies over an edge, along directions between the normals of its two faces.
inline double SeparationBounds::most_over(const CollisionHull& hull, const HullEdge& edge,
                                          const Eigen::Vector3d& p) {
  const Eigen::Vector3d from = p - hull.vertices[edge.start];
  const double left = hull.normals[edge.left].dot(from),
               end = std::max(left, hull.normals[edge.right].dot(from));
  const double beyond = edge.beyond_left.dot(from);
  const bool at_end = end <= 0 || beyond <= -constants::height_round_off ||
                      edge.beyond_right.dot(from) <= -constants::height_round_off;
  return at_end ? end : std::sqrt(left * left + beyond * beyond);
}

inline bool SeparationBounds::rules_out(const CollisionHull& hull, const HullEdge& edge, double least) const {
  for (std::size_t k = 0; k < count_; ++k)
    if (most_over(hull, edge, points_[k]) <= least) return true;
  return false;
}

// Single precision cannot tell the edges of the face that leads from better ones, so what it lets through is
// looked at again.
inline std::span<const HullBound> SeparationBounds::edges(const CollisionHull& hull, double least) {
  const int size = edges_over(hull, std::span(points_).first(count_), least, found_.data());
  const auto end = std::remove_if(found_.begin(), found_.begin() + size, [&](const HullBound& bound) {
    return rules_out(hull, hull.edges[static_cast<std::size_t>(bound.feature)], least);
  });
  return std::span(found_).first(static_cast<std::size_t>(end - found_.begin()));
}

}  // namespace drawpoint::engine::detail
