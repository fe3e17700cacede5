// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <drawpoint/engine/base/eigen.hpp>

/// Where two colliders touch or nearly touch: up to four points with one normal.
///
/// World frame, metres. The normal points from A to B. The gap is the distance of the surfaces along the
/// normal: positive apart, negative overlapping; the point lies midway between the surfaces.
namespace drawpoint::engine {

struct ManifoldPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< midway between the surfaces
  double gap = 0;                                      ///< along the normal, negative when overlapping
  std::uint32_t feature = 0;                           ///< the same number while the same features touch
};

struct Manifold {
  int collider_a = -1, collider_b = -1;  ///< a < b
  int body_a = -1, body_b = -1;
  int slot = -1;  ///< of the pair as long as the finder remembers it; for what a user remembers of it
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, from A to B
  std::array<ManifoldPoint, 4> points;
  int count = 0;
  double radius =
      0;  ///< (1/Ra + 1/Rb)⁻¹, Ra the radius of the sphere of A's volume, infinite for a half-space
};

}  // namespace drawpoint::engine
