// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/collision/manifold.hpp>

namespace drawpoint::engine {

/// Where two shapes that are apart touch first, each going on with its motion.
struct FirstTouch {
  /// Normal and positions are those at the touch; a gap is what the point closes along the normal until then.
  Manifold manifold;
  std::array<Eigen::Vector3d, 4> on_a, on_b;  ///< its points on the shapes as these stand at the start
  Eigen::Vector3d origin_a = Eigen::Vector3d::Zero(),
                  origin_b = Eigen::Vector3d::Zero();  ///< of the bodies, at the touch
};

}  // namespace drawpoint::engine
