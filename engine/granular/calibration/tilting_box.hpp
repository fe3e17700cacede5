// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/calibration/rock_sample.hpp>
#include <drawpoint/engine/world/kinematic_body.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <limits>

/// The angle at which a bed starts to slide when its box is tilted.
///
/// A box with smooth walls is filled to a little above its lower end, then turned about that end at a steady
/// rate. Ribs across its floor, a mean length apart, hold the bed, which would slide on a plane as a whole.
/// The bed slides once half of the rocks of its upper layer (the topmost largest rock, one away from both
/// ends) have gone down the slope by half a mean length: single rocks roll, and all of them settle by a
/// tenth, some five degrees before.
///
/// The way w of half a length takes time: on a layer of friction tan φ a tilt of ω t beyond φ makes g ω t/cos
/// φ, so the start is late by ω (6 w cos φ/g ω)^⅓, 1.6 degrees at 1 degree per second for rocks of 0.3 m that
/// slide at 40. At half the rate 1.0 degree. Cost: 400 rocks of one size take some 6000 steps.
namespace drawpoint::engine::granular {

struct TiltingBoxOptions : RunOptions {
  double length = 12, width = 4;  ///< of the box [largest rocks]
  double height = 3;              ///< to which it is filled, about [largest rocks]
  double rate = 1;                ///< of the tilting [deg/s]
  bool ribs = true;
};

struct TiltResult {
  RunStatus status = RunStatus::completed;
  /// Tilt at which the bed slides [deg]; NaN: not up to 80 degrees, or stopped before.
  double start = std::numeric_limits<double>::quiet_NaN();
  int rocks = 0;  ///< in the box before it turns
};

class TiltingBox {
 public:
  /// Throws std::invalid_argument for a length, width or height that is not finite and at least 3 largest
  /// rocks, and for a rate that is not finite and positive.
  TiltingBox(const RockSample& sample, const TiltingBoxOptions& options);
  TiltingBox(const TiltingBox&) = delete;
  TiltingBox& operator=(const TiltingBox&) = delete;

  World& world() { return world_; }
  double length() const { return length_; }  ///< inside [m]
  double width() const { return width_; }    ///< [m]
  double height() const { return height_; }  ///< to which it is to be filled [m]
  double mean_length() const { return mean_length_; }
  double largest() const { return largest_; }  ///< [m]
  double rate() const { return rate_; }        ///< of the tilting [rad/s]

  void turn();  ///< from the next step on, at the rate of the options
  void stop();
  double tilt() const;  ///< [rad]
  /// In the box, from the middle of its lower end's foot: x down the slope, z away from the floor [m].
  Eigen::Vector3d inside(const Eigen::Vector3d& p_W) const { return box_.pose().inverse() * p_W; }

 private:
  double length_, width_, height_, mean_length_, largest_, rate_;
  World world_;
  KinematicBody box_;
};

/// Turns a level box until what lies in it slides. Throws std::invalid_argument if no rock lies in
/// its middle.
TiltResult tilt(TiltingBox& box, const RunOptions& options);

/// Fills a box and tilts it.
TiltResult tilting_box(const RockSample& sample, const TiltingBoxOptions& options = {});

}  // namespace drawpoint::engine::granular
