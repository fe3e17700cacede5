// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/separation_bounds.h>
#include <Eigen/Dense>
#include <cstdint>
#include <limits>
#include <vector>

/// The axis of greatest separation (least overlap) of two polyhedra, by the separating-axis theorem.
///
/// s(n) = min over B of n·x − max over A of n·x; the axis maximises s over the face normals of A and B and
/// the directions of edge pairs that form a face of the Minkowski difference (Gauss map test, Gregorius
/// 2013). Overlapping shapes: −s is the exact penetration depth. Separated: s > 0 is a lower bound on the
/// distance.
///
/// Pruned without loss (separation_bounds.h). With a good first guess s₀ and a point q of the other shape
/// next to the contact a face is looked at only when q lies higher than s₀ over it, and an edge only when
/// that holds between its two faces: of a pair that rests on a face one plane and no edge is left. The first
/// guess is last time's axis, or the line of centres. All in A's frame, metres. Cost: about 1 µs for rocks of
/// a dozen vertices without a guess, less with one.
namespace drawpoint::engine::detail {

enum class FeatureKind : std::uint8_t { none, face_a, face_b, edges };

/// Which features give the axis: a face (index a of A, or b of B), or edge a of A with edge b of B.
struct Feature {
  FeatureKind kind = FeatureKind::none;
  int a = -1, b = -1;
  bool operator==(const Feature&) const = default;
};

struct Axis {
  Feature feature;  ///< none: the line of centres separates by more than the margin
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< from A to B, in A's frame
  double separation = 0;
  double support = 0;  ///< of A along the normal
  int vertex = -1;     ///< face axes: the vertex of the other shape nearest to the face
};

/// Two hulls and the pose of B in A's frame.
struct HullPair {
  const CollisionHull& a;
  const CollisionHull& b;
  Eigen::Isometry3d X_AB;

  Eigen::Vector3d vertex_b(int v) const { return X_AB * b.vertices[v]; }  ///< in A's frame
  Eigen::Vector3d in_b(const Eigen::Vector3d& p) const {
    return X_AB.linear().transpose() * (p - X_AB.translation());
  }
};

struct AxisQuery {
  double margin = 0;      ///< [m] beyond this separation nothing more is asked
  double hysteresis = 0;  ///< [m] by how much another axis must beat the hint
  Feature hint;           ///< last time's axis
  /// [m] points beyond this are not reported: a contact with no other is looked at again for nearer edges.
  double report = std::numeric_limits<double>::infinity();
};

/// Buffers of the search, grown to the largest shapes seen and then reused; nothing in them outlives a call.
class AxisSearch {
 public:
  /// The axis; the search stops early at any axis with more separation than the margin.
  Axis find(const HullPair& pair, const AxisQuery& query);

  /// The axis that these features give; its kind is none where two edges form no face of the Minkowski difference.
  Axis axis_of(const HullPair& pair, const Feature& feature) const;

  /// The nearest points of two shapes that an axis separates by less than the margin, when an edge or a
  /// vertex of both is nearest. False when no edges are within the margin.
  struct Nearest {
    Eigen::Vector3d on_a, on_b;  ///< in A's frame
    int edge_a, edge_b;
    double distance;
  };
  bool nearest_edges(const HullPair& pair, const Axis& axis, double margin, Nearest& nearest);

 private:
  struct Witness {
    Eigen::Vector3d on_a, on_b;  ///< a point of each shape, in A's frame, near where they touch
  };
  struct EdgeOfA {
    int edge;
    double most;  // no axis of this edge separates by more
    Eigen::Vector3d along_in_b;
  };
  struct EdgeOfB {
    int edge;
    double most;
    Eigen::Vector3d along, start;  ///< in A's frame
  };

  Axis guess(const HullPair& pair, Witness& witness);
  Axis face_of_a(const HullPair& pair, int face) const;
  Axis face_of_b(const HullPair& pair, int face) const;
  bool edge_axis(const HullPair& pair, const EdgeOfA& first, const EdgeOfB& second, Axis& axis) const;
  Witness witness_of(const HullPair& pair, const Axis& axis) const;
  bool search_faces(const HullPair& pair, const Witness& witness);
  void search_edges(const HullPair& pair, Axis& best_edges);

  SeparationBounds bounds_a_, bounds_b_;
  std::vector<EdgeOfA> edges_a_;
  std::vector<EdgeOfB> edges_b_;
  Axis best_;
  AxisQuery query_;
  double floor_ = 0;  // some axis has at least this separation
};

}  // namespace drawpoint::engine::detail
