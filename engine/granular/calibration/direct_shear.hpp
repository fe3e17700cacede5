// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/calibration/rock_sample.hpp>
#include <drawpoint/engine/world/kinematic_body.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <vector>

/// Large direct shear: the angle of internal friction at a given normal stress.
///
/// A box is cut at half its height. Rock fills both halves between smooth walls; a plate of weight σA lies on
/// it; the upper half is moved along x at a set speed. T is the force that this takes, N what presses the two
/// halves of the rock together: plate and rock above the cut, less what the lower box carries of them where
/// the upper one stands over its wall. As the walls are smooth, T and N are the tangential and normal force
/// on the plane of the cut, whatever its area, and φ = atan(T/N). The plate is free to rise and tilt:
/// constant normal load. Rock is rough to the floor and to the plate. The box is 10 x 5 x 6 largest rocks
/// (ASTM D3080 asks for 10 in length and 6 in height); it is moved by 0.15 of its length. σ of 20 to 100 kPa
/// is what 1 to 4 m of loose ore press. At 0.05 m/s and 50 kPa the inertial number of rocks of 0.3 m is 2e-3:
/// quasi-static. World frame: floor at z = 0, x the way of shearing, SI units. Cost: 800 rocks, some 2200
/// steps.
namespace drawpoint::engine::granular {

struct ShearBoxSize {
  double length = 10, width = 5, height = 6;  ///< inside, both halves [largest rocks]
};

/// Mean over a part of the way.
struct ShearPoint {
  double displacement = 0;  ///< of the upper half, at the middle of the part [m]
  double ratio = 0;         ///< T/N
  double rise = 0;          ///< of the plate's middle [m]
};

struct ShearOptions : RunOptions {
  ShearBoxSize box;
  double stress = 50e3;  ///< σ, of plate on rock; what lies above the cut comes on top [Pa]
  double speed = 0.05;   ///< [m/s]
  double travel = 0.15;  ///< of the box's length
  int parts = 24;        ///< of the way, over which T/N is averaged; at least 6
};

struct ShearResult {
  RunStatus status = RunStatus::completed;
  double peak = 0;           ///< φ of the largest mean T/N over three parts in a row [deg]
  double large = 0;          ///< φ of the mean T/N over the last third of the way [deg]
  double dilation = 0;       ///< angle of the plate's mean rise over the way [deg]
  double normal_stress = 0;  ///< N over the box's section, mean [Pa]
  int rocks = 0;             ///< without the plate
  std::vector<ShearPoint> curve;
};

/// The box, empty at first; for the tests of the method, which put blocks of their own in it.
class ShearBox {
 public:
  /// Throws std::invalid_argument for a side of less than 2 largest rocks, a travel outside 0 to 0.5, fewer
  /// than 6 parts, and for a speed or stress that is not positive; all have to be finite.
  ShearBox(const RockSample& sample, const ShearOptions& options);

  engine::World& world() { return world_; }
  double length() const { return length_; }  ///< inside [m]
  double width() const { return width_; }
  double height() const { return height_; }

  /// Lays the plate, 0.1 of the length thick, on the highest rock. Throws std::invalid_argument where that
  /// stands lower than 0.6 of the box's height, or so high that the plate would reach above twice the height
  /// (the walls of the upper half end at 2.5 times).
  void load(double stress);
  engine::KinematicBody& upper() { return upper_; }
  double tangential() const;    ///< T of the last step [N]
  double normal() const;        ///< N of the last step [N]
  double plate_height() const;  ///< of the plate's middle [m]

 private:
  double length_, width_, height_, mean_length_;
  engine::World world_;
  engine::KinematicBody upper_;
  int front_ = -1, plate_ = -1;
};

/// Moves the upper half of a box that is loaded and at rest.
ShearResult shear(ShearBox& box, const ShearOptions& options);

/// Fills, loads and shears. Throws as the box does.
ShearResult direct_shear(const RockSample& sample, const ShearOptions& options = {});

}  // namespace drawpoint::engine::granular
