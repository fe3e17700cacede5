// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

/// Facets of a closed convex surface that lie in one plane, as one face.
///
/// Each facet not yet in a face, largest first, gathers its neighbours and theirs while all their corners lie within
/// the tolerance of the mean plane of what it has. A corner then stays where three faces or more meet.
namespace drawpoint::engine::detail {

/// Twice the area of a polygon along its outward normal (Newell): exact for a planar one, and the best plane of one
/// that is planar up to round-off.
Eigen::Vector3d twice_area(const std::vector<Eigen::Vector3d>& points, const std::vector<int>& face);

using FaceList = std::vector<std::vector<int>>;  ///< corners, counter-clockwise seen from outside

/// Each face begins at its first point, and faces are in the order of their points. Empty when that is no closed
/// surface: the tolerance [m] is too large then. At 0 facets stay apart.
FaceList merged_faces(const std::vector<Eigen::Vector3d>& points, const FaceList& facets, double tolerance);

}  // namespace drawpoint::engine::detail
