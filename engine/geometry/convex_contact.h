// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/clipping.h>
#include <drawpoint/engine/geometry/separation.h>
#include <array>

/// Contact of two convex polyhedra as anchors on both of them, so that it can be carried along while they
/// move little.
///
/// Face axis: the facing polygon of the other shape is clipped to the face's prism and reduced to four
/// points. Edge axis: the nearest points of the two edges, and where a face beside them lies nearly across the
/// axis those of the polygon that faces it, off by 0.02 of their gaps. Separated shapes whose polygons do not face each
/// other: the nearest points of their edges, if within the margin. So shapes nearer than the margin always
/// give a point, and shapes farther apart never. When there is no point, the normal is A's and n·x = support
/// is a plane on A that B was clear of.
namespace drawpoint::engine::detail {

struct Anchors {
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero(),
                  on_b = Eigen::Vector3d::Zero();  ///< in the frames of A and B
  std::uint32_t feature = 0;
};

struct ConvexContact {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< from A to B, in the frame of its owner
  double separation = 0;  ///< lower bound on the distance when count = 0, separation along the axis otherwise
  double support = 0;     ///< of A along the normal
  int count = 0;
  bool normal_of_b = false;  ///< the face that gives the normal belongs to B
  Feature feature;           ///< hint for next time
  std::array<Anchors, 4> points;
};

class ConvexContactSearch {
 public:
  /// Into `contact`, whatever it held.
  void find(const HullPair& pair, const AxisQuery& query, ConvexContact& contact);

  /// The same along an axis that is known; without features, one that separates by more than the margin.
  void find_along(const HullPair& pair, const AxisQuery& query, const Axis& axis, ConvexContact& contact);

 private:
  void complete(const HullPair& pair, const AxisQuery& query, const Axis& axis, ConvexContact& contact);
  void touch(const HullPair& pair, const Axis& axis, double margin, ConvexContact& contact);
  void clip_against(const HullPair& pair, const Feature& reference, int other, double margin,
                    ConvexContact& contact);
  void face_contact(const HullPair& pair, const Axis& axis, double margin, ConvexContact& contact);
  void edge_contact(const HullPair& pair, const Axis& axis, double margin, ConvexContact& contact);
  void add_flat_points(const HullPair& pair, const Axis& axis, double margin, ConvexContact& contact);
  void nearest_contact(const HullPair& pair, const Axis& axis, double margin, ConvexContact& contact);

  AxisSearch axes_;
  Clipper clipper_;
  ConvexContact spare_;
};

}  // namespace drawpoint::engine::detail
