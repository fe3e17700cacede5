// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/base/eigen.hpp>
#include <limits>

/// Planar kinematics of the loader's arm: drive (prismatic), boom hinge F, bucket hinge G, cutting edge K.
///
/// World frame: x toward the back wall, z up [m]; angles are elevations, positive with the nose up [rad].
///   x_K = q_d + x_F + FG cos a + GK cos b,   z_K = z_F + FG sin a + GK sin b,   φ = b − ψ_b
/// with a the elevation of FG and b that of GK. Rates (singular only at cos a = 0, boom vertical):
///   ȧ = (v_z − GK cos b ω) / (FG cos a),   q̇_d = v_x + FG sin a ȧ + GK sin b ω,   ḃ = ω.
/// Source: Lindmark (2016), equations 25-37.
namespace drawpoint::engine::loading {

/// Fixed lengths and angles; the defaults are the estimated linkage of the LH621 class.
struct ArmGeometry {
  double FG = 2.952;        ///< boom hinge to bucket hinge [m]
  double GK = 1.868;        ///< bucket hinge to cutting edge [m]
  double x_F = -0.60;       ///< F ahead of the point whose x is q_d (front axle line) [m]
  double z_F = 1.80;        ///< F above the floor [m]
  double psi_b = -0.27087;  ///< elevation of GK when the bucket floor is level, −15.52° [rad]
};

/// The geometry of hinge points given in the reference pose (bucket flat on the floor, z = 0, x from the
/// front axle line).
ArmGeometry arm_geometry(const Eigen::Vector3d& F, const Eigen::Vector3d& G, const Eigen::Vector3d& K);

struct ArmPose {
  double q_d = 0;  ///< drive coordinate [m]
  double a = 0;    ///< elevation of FG [rad]
  double b = 0;    ///< elevation of GK [rad]
};

struct TipPose {
  double x = 0, z = 0;  ///< cutting edge [m]
  double phi = 0;       ///< bucket angle, 0: floor level [rad]
};

struct TipRates {
  double v_x = 0, v_z = 0;  ///< [m/s]
  double omega = 0;         ///< positive: curling back [rad/s]
};

struct ActuatorRates {
  double drive = 0;  ///< q̇_d, wheel rate times tyre radius [m/s]
  double boom = 0;   ///< ȧ [rad/s]
  double tilt = 0;   ///< ḃ − ȧ, bucket relative to the boom [rad/s]
};

TipPose tip_pose(const ArmGeometry& arm, const ArmPose& pose);

/// The arm pose of a tip pose, boom elevation within ±90°. A height out of reach gives the nearest boom
/// elevation.
ArmPose arm_pose(const ArmGeometry& arm, const TipPose& tip);

TipRates tip_rates(const ArmGeometry& arm, const ArmPose& pose, const ActuatorRates& rates);

/// Inverse of tip_rates. Below |cos a| = 1e-3 the boom's lever is taken as 1e-3 FG, so that the result stays
/// finite.
ActuatorRates actuator_rates(const ArmGeometry& arm, const ArmPose& pose, const TipRates& rates);

/// Largest magnitudes; infinity: no limit.
struct RateLimits {
  double drive = 2.5;  ///< [m/s]
  double boom = 0.20;  ///< [rad/s]
  double tilt = 0.40;  ///< [rad/s]
  /// How fast a drive may be set to go faster [m/s²], or it rears and lifts the bucket off the floor; the
  /// executor keeps it.
  double drive_acceleration = std::numeric_limits<double>::infinity();
};

/// All three rates times one factor in (0, 1], the largest that meets the limits: the direction of the path
/// is kept.
ActuatorRates within_limits(const ActuatorRates& rates, const RateLimits& limits);

}  // namespace drawpoint::engine::loading
