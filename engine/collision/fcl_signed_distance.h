// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/geometry/separation.h>
#include <Eigen/Dense>

/// FCL's signed distance of two convex polyhedra on libccd: GJK, and EPA where they overlap, with the engine's own
/// support mapping.
///
/// It is what fcl::distance() runs for GST_LIBCCD with enable_signed_distance, without four of its faults: Debian's
/// library keeps its assertions, and a failed one ends the program (here they are off, and the caller checks the
/// answer); its EPA loop has no limit and may never end (here the support mapping ends it: after `most_supports` both
/// shapes are at the origin, which EPA takes for convergence); it ignores a cached guess (here it is the first
/// direction); where its EPA throws it leaves its polytope allocated (here it is freed). A's frame, metres.
/// Cost: 2 to 4 µs for rocks.
namespace drawpoint::engine::detail {

struct SignedDistance {
  double value = 0;  ///< minus the depth when overlapping
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero(), on_b = Eigen::Vector3d::Zero();  ///< the witness points
  bool ended = false;  ///< by itself, within most_supports
};

/// Throws what FCL throws, a std::exception. `guess` points from A to B, any length.
SignedDistance fcl_signed_distance(const HullPair& pair, const Eigen::Vector3d& guess, double tolerance);

}  // namespace drawpoint::engine::detail
