// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>

/// A force and a moment about a stated point, in stated axes.
namespace drawpoint::engine {

struct Wrench {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< [N m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
};

}  // namespace drawpoint::engine
