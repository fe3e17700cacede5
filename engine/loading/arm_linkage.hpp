// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>

/// The pins of the loader's arm in its middle plane, and the lever of its tilt cylinder about the bucket's hinge.
///
/// Reference pose, bucket flat on the floor; x forward from the front axle, z up [m]. Boom: F on the frame, G the
/// bucket's hinge, E the bell-crank's. Bell-crank: E, Q the tilt rod's pin, P the link's. Link: P, H on the bucket. The
/// tilt barrel turns about T on the frame. An estimated, consistent Z-bar linkage: no manufacturer publishes its pins.
///
/// Lever: with the boom held, the bucket's rate ω turns the bell-crank at ω_c through the link, (v_P − v_H)·(P − H) =
/// 0, and the rod's pin moves along the cylinder by ℓ̇; by virtual work a push f of the cylinder turns the bucket about
/// G with the moment f ℓ̇/ω, nose up. Weight and inertia of bell-crank and link are left out: some kN m of the hundreds
/// of a bucket in rock.
namespace drawpoint::engine::loading {

/// Height of the axles over the floor under the machine's own weight, as in the reference pose [m].
inline constexpr double loaded_tyre_radius = 0.93;

struct ArmLinkage {
  Eigen::Vector2d F{-0.60, 1.80}, G{2.05, 0.50}, H{1.94, 1.07}, E{1.31, 1.42}, Q{1.12, 2.32}, P{1.18, 0.63},
      T{0.10, 1.68};
};

/// ℓ̇/ω [m] with the boom at elevation a of FG and the bucket turned by phi from its reference pose, both against the
/// front unit [rad]. Finite wherever the linkage closes; not a number where it cannot.
double tilt_lever(const ArmLinkage& linkage, double a, double phi);

/// How the arm stands against the front unit.
struct ArmAngles {
  double a = 0;    ///< elevation of FG [rad]
  double phi = 0;  ///< of the bucket, from its reference pose [rad]
};

/// From world positions in the machine's plane [m]: G, a front axle whose reference pose is (0, axle_height), and the
/// bucket's world angle [rad]. The frame may pitch.
ArmAngles arm_angles(const ArmLinkage& linkage, const Eigen::Vector2d& G, const Eigen::Vector2d& axle,
                     double axle_height, double bucket_angle);

}  // namespace drawpoint::engine::loading
