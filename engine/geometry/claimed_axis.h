// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/separation.h>
#include <Eigen/Dense>
#include <optional>

/// An axis that somebody else claims for two polyhedra, checked by their support heights and made exact.
///
/// Along any unit n the shapes separate by s(n) = min over B of n·x − max over A of n·x, two support heights.
/// A claim (n, d), d < 0 for a depth, says two things. s(n) = d is what the supports check. That no axis separates by
/// more is beyond them: an algorithm that grows a polytope inside the Minkowski difference (EPA) bounds the depth from
/// below, and with s(n) = d both bounds meet. A claim without such a bound is held to the engine's own search, which
/// starts from it and has little left to do.
///
/// Tolerance of s(n) = d: constants::claim_tolerance. A claim beyond it is refused, and so is one whose axis is that
/// of no face or pair of edges next to the supporting vertices though the shapes overlap: the axis of least overlap
/// always is one. What passes is replaced by the best axis of those features, exact to round-off. All in A's frame,
/// metres. Cost: some 0.3 µs for rocks.
namespace drawpoint::engine::detail {

struct AxisClaim {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, from A to B, in A's frame
  double separation = 0;                             ///< along it; minus the depth when overlapping
  bool bounded = false;  ///< the depth is no less: known from a polytope inside the Minkowski difference
};

/// Nothing when the claim is refused. The axis has features unless it separates by more than the margin; of shapes
/// nearer than that which a vertex separates from a vertex or an edge it may be the search's. As AxisSearch::find()
/// does, it keeps the hint while that is the best within the hysteresis.
std::optional<Axis> confirmed_axis(const HullPair& pair, const AxisClaim& claim, const AxisQuery& query);

}  // namespace drawpoint::engine::detail
