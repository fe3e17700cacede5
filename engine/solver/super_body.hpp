// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <vector>

/// What the contact solver sees of an articulated machine: one super-body.
///
/// A machine with n speeds u, mass matrix M(q) and loop constraints G(q) u = 0 answers an impulse p on its
/// speeds with Δu = A p,  A = M⁻¹ − M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹G M⁻¹ = N Nᵀ,  N: n x r of rank r, the true degrees of
/// freedom. With u = N w the machine is a body of r velocity coordinates w and unit mass: a row J u of any
/// part becomes the row (J N) w, and an impulse λ on it changes w by (J N)ᵀ λ. Joints hold to round-off
/// whatever the solver's number of iterations.
///
/// Frames: world. Spatial vectors are (angular; linear), taken at the part's origin. SI units.
namespace drawpoint::engine {

using SpatialMap = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using SpatialVector = Eigen::Matrix<double, 6, 1>;

/// One scalar row J w of the machine itself: a motor (two-sided limits) or a joint stop (one-sided).
/// Motor: J w⁺ = target with lower ≤ λ ≤ upper, complementary at the limits. Stop: J w⁺ ≥ −g/h while the gap
/// g is open; past the end it asks for |g| / recovery back. Impulses over the step, in N s or N m s.
struct SuperBodyRow {
  enum class Kind { motor, stop };
  Kind kind = Kind::motor;
  Eigen::VectorXd jacobian;  ///< length r
  double target = 0;         ///< motors: [m/s] or [rad/s]
  double gap = 0;            ///< stops: at the step's start [m] or [rad], negative past the end
  double recovery = 0;       ///< stops: time to take an overrun back [s], > 0
  double lower = 0, upper = 0;
  double start = 0;  ///< impulse to start from (last substep's, as ContactPoint::start)
};

/// The machine during one step.
struct SuperBody {
  Eigen::VectorXd velocity_before;       ///< w at the start of the step, length r
  Eigen::VectorXd velocity;              ///< w after gravity and inertia forces, before any impulse, length r
  std::vector<SpatialMap> part_maps;     ///< 6 x r: w -> spatial velocity of the part at its origin
  std::vector<Eigen::Vector3d> origins;  ///< part origins in the world [m]
  std::vector<SuperBodyRow> rows;
};

/// What the solver gives back.
struct SuperBodySolution {
  Eigen::VectorXd velocity;       ///< w at the end of the step, length r
  Eigen::VectorXd mean_velocity;  ///< over the step: what moves the positions
  double steady_share =
      1;  ///< of a change of w that is the same in all S substeps, what the mean has of it: (1 + 1/S)/2
  std::vector<SpatialVector>
      part_impulses;  ///< contact impulse on each part at its origin (moment; force) [N m s; N s]
  std::vector<double> row_impulses;  ///< over the step, in the order of SuperBody::rows
  std::vector<double> row_starts;    ///< what the next step's rows start from
};

}  // namespace drawpoint::engine
