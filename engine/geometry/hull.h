// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

/// Convex hull of a small point set, faces merged. A triple of points spans a face when no point lies above
/// its plane; the points in that plane, ordered by a planar hull, are the face. No topology is updated on the
/// way, so nothing can go astray on coplanar, collinear or repeated points; the closed surface is checked
/// once at the end.
namespace drawpoint::engine::detail {

struct Hull {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> faces;  ///< counter-clockwise seen from outside
};

/// Throws std::invalid_argument for fewer than four points, points that are not finite, and points in one
/// plane.
Hull hull(std::span<const Eigen::Vector3d> points);

}  // namespace drawpoint::engine::detail
