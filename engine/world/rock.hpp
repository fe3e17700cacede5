// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/geometry/shape.hpp>
#include <memory>
#include <span>

/// A rock: its frame has its origin at the centre of mass and its axes along the principal axes.
namespace drawpoint::engine {

/// A rock's fixed properties, shared by equal rocks. World::add_rock() refuses a shape whose centre of mass, as a
/// homogeneous solid, is off the origin by more than 1e-6 of its size.
struct RockBody {
  /// The convex hull of points in any frame, moved to its centre of mass and turned to its principal axes. density
  /// [kg/m³]. Throws std::invalid_argument for fewer than four points, points in one plane, a density that is not
  /// positive. place_hull() also says where the hull stood.
  static RockBody from_hull(std::span<const Eigen::Vector3d> points, double density, int material = 0);

  std::shared_ptr<const Shape> shape;                 ///< convex polyhedron, centred, principal axes
  double mass = 0;                                    ///< [kg]
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< principal moments [kg m²]
  int material = 0;
};

struct PlacedHull {
  RockBody body;
  Eigen::Isometry3d X_PB = Eigen::Isometry3d::Identity();  ///< the body's frame in the frame of the points
};

/// As RockBody::from_hull(): add_rock(placed.body, X_WP * placed.X_PB) puts the hull where its points are.
PlacedHull place_hull(std::span<const Eigen::Vector3d> points, double density, int material = 0);

struct Rock {
  RockBody body;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();                                          ///< X_WB
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), angular_velocity = Eigen::Vector3d::Zero();  ///< world
  bool present = true;  ///< a removed rock keeps its index
  int collider = -1;
};

}  // namespace drawpoint::engine
