// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/collision/manifold.hpp>

namespace drawpoint::engine {

/// Where two shapes that are apart touch first, each going on with its motion, told at the start.
struct FirstTouch {
  /// The normal is that at the touch; a gap is what the point closes along it until then; a position lies
  /// midway between the point's places on the shapes as they stand at the start, so that equal and opposite
  /// impulses there keep angular momentum.
  Manifold manifold;
  std::array<Eigen::Vector3d, 4> on_a, on_b;  ///< these places
};

}  // namespace drawpoint::engine
