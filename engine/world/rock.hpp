// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <drawpoint/engine/geometry/shape.hpp>
#include <memory>

/// A rock: its frame has its origin at the centre of mass and its axes along the principal axes.
namespace drawpoint::engine {

/// A rock's fixed properties, shared by equal rocks.
struct RockBody {
  std::shared_ptr<const Shape> shape;                 ///< convex polyhedron, centred, principal axes
  double mass = 0;                                    ///< [kg]
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< principal moments [kg m²]
  int material = 0;
};

struct Rock {
  RockBody body;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();                                          ///< X_WB
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), angular_velocity = Eigen::Vector3d::Zero();  ///< world
  bool present = true;  ///< a removed rock keeps its index
  int collider = -1;
};

}  // namespace drawpoint::engine
