// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/claimed_axis.h>
#include <drawpoint/engine/geometry/convex_contact.h>
#include <drawpoint/engine/collision/contact_finder_options.hpp>
#include <map>
#include <memory>
#include <optional>
#include <vector>

/// FCL's narrow phase for two polyhedra: its axis, checked by claimed_axis.h, with the engine's manifold.
///
/// fcl_libccd takes the signed distance (fcl_signed_distance.h); the axis is the line of its two witness points.
/// fcl::collide with that solver refines a portal toward the centres instead, whose depth is along that way and not
/// the least. fcl_indep asks fcl::collide with GST_INDEP, and fcl::distance where that finds nothing. Both start
/// GJK from the axis of the step before. Everything is asked in A's frame: GST_INDEP gives its normal in the frame of
/// the first shape, whatever that shape's pose.
///
/// Tolerance constants::fcl_tolerance. Refused are an exception of FCL, an axis that is missing or not finite, and
/// what claimed_axis.h refuses. Cost: 3 to 6 µs per pair.
namespace drawpoint::engine::detail {

class FclShape;

/// FCL's copies of the colliders' hulls. ask() may be called by many threads.
class FclAxes {
 public:
  explicit FclAxes(NarrowMethod method);

  bool on() const { return method_ != NarrowMethod::separating_axes; }
  /// A collider and its hull, none for a half-space; colliders with one hull share one copy.
  void add(int id, const CollisionHull* hull);
  void remove(int id);
  /// What FCL says of two colliders; nothing when it has no answer. `guess` points from A to B, any length.
  std::optional<AxisClaim> ask(int a, int b, const HullPair& pair, const Eigen::Vector3d& guess) const;

 private:
  NarrowMethod method_;
  std::vector<std::shared_ptr<const FclShape>> shapes_;  // by collider
  std::map<const CollisionHull*, std::weak_ptr<const FclShape>> known_;
};

/// The contact of two colliders along FCL's axis, or by `search` where FCL is wrong; false then. `contact` holds what
/// was found last time.
bool find_by_fcl(const FclAxes& fcl, int a, int b, const HullPair& pair, const AxisQuery& query,
                 ConvexContactSearch& search, ConvexContact& contact);

}  // namespace drawpoint::engine::detail
