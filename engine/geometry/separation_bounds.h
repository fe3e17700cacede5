// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/hull_extremes.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>
#include <vector>

/// By how much the faces and edges of one hull can separate it from another shape, at most, from a few points
/// of that shape.
///
/// For a normal n that a face or an edge allows, with p on that face or edge and any point q of the other
/// shape, the separation along n is at most n·(q − p). For a face that is the height of q over its plane. For
/// an edge the normals lie between those of its two faces, and the bound is the largest height of q over the
/// edge among them. q is the witness, or the lowest point over a face that was looked at. All in the hull's
/// frame, metres. Cost: one pass over the planes, then a few operations per edge of the faces that q lies
/// over.
namespace drawpoint::engine::detail {

class SeparationBounds {
 public:
  /// Starts anew, with the witness on the other shape.
  void measure(const CollisionHull& hull, const Eigen::Vector3d& witness);
  /// The face was looked at: what it separates by, and the lowest point of the other shape over it.
  void see(int face, double separation, const Eigen::Vector3d& lowest);

  /// Height of the witness over a face: no separation along its normal is more.
  double over(int face) const { return over_[face]; }
  /// Calls `keep(e, most)` once for each edge of the hull that may separate by more than `least`, and by no
  /// more than `most`.
  template <class Keep>
  void for_edges(const CollisionHull& hull, double least, const Keep& keep) const;

 private:
  struct SeenFace {
    double separation;
    Eigen::Vector3d lowest;
  };
  static double most_over(const HullEdge& edge, const Eigen::Vector3d& start, const Eigen::Vector3d& p,
                          double left, double right);
  double most(const CollisionHull& hull, const HullEdge& edge, double least) const;

  Eigen::Vector3d witness_;
  std::vector<double> over_;
  std::vector<SeenFace> seen_;
  std::vector<int> seen_at_;  // by face: its place in `seen_`, or -1
};

inline void SeparationBounds::measure(const CollisionHull& hull, const Eigen::Vector3d& witness) {
  over_.resize(std::max<std::size_t>(over_.size(), hull.nx.size()));
  heights(hull, witness, over_.data());
  witness_ = witness;
  seen_.clear();
  seen_at_.assign(static_cast<std::size_t>(hull.face_count()), -1);
}

inline void SeparationBounds::see(int face, double separation, const Eigen::Vector3d& lowest) {
  assert(face >= 0 && face < static_cast<int>(seen_at_.size()) && "a face of the hull that was measured");
  seen_at_[face] = static_cast<int>(seen_.size());
  seen_.push_back({separation, lowest});
}

// The most that a point lies over an edge, along directions between the normals of its two faces; `left` and
// `right`: its heights over these. The height over the edge is a cosine of the direction: it is largest at an
// end, or inside when it is positive and the point lies beyond both faces.
inline double SeparationBounds::most_over(const HullEdge& edge, const Eigen::Vector3d& start,
                                          const Eigen::Vector3d& p, double left, double right) {
  const double end = std::max(left, right);
  if (end <= 0) return end;
  const Eigen::Vector3d from = p - start;
  if (edge.beyond_left.dot(from) <= -constants::height_round_off ||
      edge.beyond_right.dot(from) <= -constants::height_round_off)
    return end;
  const double along = edge.along.dot(from);
  return std::sqrt(std::max(0.0, from.squaredNorm() - along * along / edge.along.squaredNorm()));
}

// Three points of the other shape can rule an edge out: the witness, and the lowest ones over its two faces
// where those were looked at.
inline double SeparationBounds::most(const CollisionHull& hull, const HullEdge& edge, double least) const {
  const Eigen::Vector3d& start = hull.vertices[edge.start];
  double bound = most_over(edge, start, witness_, over_[edge.left], over_[edge.right]);
  for (const bool left : {true, false}) {
    const int at = seen_at_[left ? edge.left : edge.right];
    if (at < 0 || bound <= least) continue;
    const SeenFace& face = seen_[at];
    const int other = left ? edge.right : edge.left;
    const double across = hull.normals[other].dot(face.lowest) - hull.offsets[other];
    bound = std::min(bound, most_over(edge, start, face.lowest, left ? face.separation : across,
                                      left ? across : face.separation));
  }
  return bound;
}

template <class Keep>
void SeparationBounds::for_edges(const CollisionHull& hull, double least, const Keep& keep) const {
  const double high = std::min(least, 0.0);  // over no other face is the witness high enough
  for (int f = 0; f < hull.face_count(); ++f) {
    if (over_[f] <= high) continue;
    for (int e : hull.edges_of(f)) {
      const HullEdge& edge = hull.edges[e];
      const int other = edge.left == f ? edge.right : edge.left;
      if (other < f && over_[other] > high) continue;  // seen from there
      if (const double bound = most(hull, edge, least); bound > least) keep(e, bound);
    }
  }
}

}  // namespace drawpoint::engine::detail
