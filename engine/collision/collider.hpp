// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/geometry/shape.hpp>
#include <memory>

/// A shape on a body, as the search for contacts sees it. World frame, SI units.
namespace drawpoint::engine {

struct Collider {
  std::shared_ptr<const Shape> shape;
  int body = 0;                                            ///< colliders of one body never touch
  int family = 0;                                          ///< colliders of one family > 0 never touch
  bool moves = true;                                       ///< two colliders that do not move never touch
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();  ///< shape in its body
};

struct ColliderMove {
  int collider = -1;
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  double speculative_margin = 0;  ///< [m]
};

}  // namespace drawpoint::engine
