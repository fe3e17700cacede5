// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <drawpoint/engine/contact/collision_hull.hpp>
#include <vector>

/// The axis of greatest separation (least overlap) of two polyhedra, by the separating-axis theorem.
///
/// s(n) = min over B of n·x − max over A of n·x; the axis maximises s over the face normals of A and B and
/// the directions of edge pairs that form a face of the Minkowski difference (Gauss map test, Gregorius
/// 2013). Overlapping shapes: −s is the exact penetration depth. Separated: s > 0 is a lower bound on the
/// distance. Edges are pruned without loss: the axis of an edge pair can win only when the edges come within
/// the bound b = max(margin, −best face s) of each other, so an edge that stays outside one of the other's
/// planes moved out by b is skipped. When the shapes are apart by more than b along an edge pair, find() may
/// so report an overlap that is none; it is certain only once a point of each surface has been seen within b
/// of each other (the contact itself). Where there is none, ask find_exhaustively(). All in A's frame,
/// metres. Cost: faces x vertices products each way plus a handful of edge pairs.
namespace drawpoint::engine::contact::detail {

enum class FeatureKind : std::uint8_t { none, face_a, face_b, edges };

/// Which features give the axis: a face (index a of A, or b of B), or edge a of A with edge b of B.
struct Feature {
  FeatureKind kind = FeatureKind::none;
  int a = -1, b = -1;
  bool operator==(const Feature&) const = default;
};

struct Axis {
  Feature feature;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< from A to B, in A's frame
  double separation = 0;
  int support = -1;  ///< face axes: the vertex of the other shape nearest to the face
};

/// Two hulls and the pose of B in A's frame.
struct HullPair {
  const CollisionHull& a;
  const CollisionHull& b;
  Eigen::Isometry3d X_AB;
};

struct AxisQuery {
  double margin = 0;      ///< [m] beyond this separation nothing more is asked
  double hysteresis = 0;  ///< [m] by how much another axis must beat the hint
  Feature hint;           ///< last time's axis
};

/// Buffers of the search, grown to the largest shapes seen and then reused.
class AxisSearch {
 public:
  /// The axis; the search stops early at any axis with more separation than the margin.
  Axis find(const HullPair& pair, const AxisQuery& query);

  /// After find(): the same over all edge pairs, with no hint. Rarely needed; edges x edges.
  Axis find_exhaustively(const HullPair& pair);

  /// The nearest points of two separated shapes when an edge or a vertex of both is nearest. Looks at the
  /// edges that the last find() kept; false when none of their pairs is within the margin.
  struct Nearest {
    Eigen::Vector3d on_a, on_b;  ///< in A's frame
    int edge_a, edge_b;
    double distance;
  };
  bool nearest_edges(const HullPair& pair, double margin, Nearest& nearest) const;

  /// Vertex v of B in A's frame, as the last find() computed it.
  Eigen::Vector3d vertex_b(int v) const { return {bx_[v], by_[v], bz_[v]}; }

 private:
  struct Vertices {
    const double *x, *y, *z;
    Eigen::Index count;
  };
  void place(const HullPair& pair);
  bool sweep_faces(const CollisionHull& faces, const Vertices& vertices, double margin, FeatureKind kind);
  void note_face(FeatureKind kind, int face, double separation);
  void near_edges(const CollisionHull& edges, const CollisionHull& faces,
                  const std::vector<double>& distances, std::vector<int>& result);
  void sweep_edges(const HullPair& pair);
  Axis finish(const HullPair& pair);
  bool edge_axis(const HullPair& pair, int edge_a, int edge_b, Axis& axis) const;
  void complete(const HullPair& pair, Axis& axis) const;

  Eigen::ArrayXd bx_, by_, bz_;      // vertices of B in A's frame, padded
  Eigen::ArrayXd ax_, ay_, az_;      // vertices of A in B's frame, padded
  std::vector<double> to_a_, to_b_;  // [face][vertex]: distances to the planes of A, of B
  std::vector<std::uint64_t> outside_;
  std::vector<int> edges_a_, edges_b_;
  Axis best_face_, best_, hinted_;
  AxisQuery query_;
  double bound_ = 0;
};

}  // namespace drawpoint::engine::contact::detail
