// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/calibration/rock_sample.hpp>
#include <drawpoint/engine/world/kinematic_body.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <vector>

/// Force of a plate that is pushed down into a bed of rock, as a bucket's lip is pushed into a pile.
///
/// A flat plate of given width and thickness, standing upright and rough as rock, goes down at a set speed in
/// the middle of a box with smooth walls that was filled loosely. The force is that of all contacts along the
/// way, the work is what the plate has done, W = ∫ F dz. The quasi-static force rises with the depth; it
/// scatters by half of itself as rocks are caught and pushed aside, so means over a range of depths are given.
/// No published value is for rocks of this size: the test compares coefficients with each other. Depth counts
/// from the mean surface under the plate. World frame, z up, SI units. Cost: 800 rocks, some 1500 steps.
namespace drawpoint::engine::granular {

struct PushOptions : RunOptions {
  double speed = 0.1;  ///< [m/s]
  int parts = 10;      ///< of the way, over which the force is averaged
};

struct PenetrationOptions : PushOptions {
  double side = 7, height = 5;           ///< of the bed, about [largest rocks]
  double width = 2.5, thickness = 0.25;  ///< of the plate [largest rocks]
  double depth = 2;                      ///< to which it goes [largest rocks]
};

struct PenetrationPoint {
  double depth = 0;  ///< of the plate's edge, at the end of the part [m]
  double force = 0;  ///< on the plate against its motion, mean over the part [N]
};

struct PenetrationResult {
  RunStatus status = RunStatus::completed;
  double early_force = 0;  ///< mean over the first half of the way [N]
  double mean_force = 0;   ///< over the second half [N]
  double work = 0;         ///< of the plate [J]
  double pressure = 0;     ///< mean_force over the plate's section [Pa]
  int rocks = 0;
  std::vector<PenetrationPoint> curve;
};

/// Pushes a plate along `way` [m] from where it stands; fills curve, mean force and work.
PenetrationResult push_in(engine::World& world, engine::KinematicBody& plate, const Eigen::Vector3d& way,
                          const PushOptions& options);

/// Throws std::invalid_argument for a plate that is wider than the bed less two rocks, a way that comes nearer
/// to the floor than two rocks, and for lengths and speeds that are not positive.
PenetrationResult plate_penetration(const RockSample& sample, const PenetrationOptions& options = {});

}  // namespace drawpoint::engine::granular
