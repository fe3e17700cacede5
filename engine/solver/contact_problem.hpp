// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/solver/super_body.hpp>
#include <vector>

/// One step's contact problem as plain arrays: bodies, pairs of bodies that touch, their points, one machine.
///
/// The step h is cut into S substeps of h/S. In each, with the relative velocity u = v_B − v_A at a point
/// with frame (n, t1, t2) and the impulses λ of the substep,
///     0 ≤ λ_n ⊥ u_n − min(b − Σ λ_n, c) ≥ 0,   |λ_t| ≤ μ λ_n,  u_t = −s λ_t with s ≥ 0, s = 0 inside the cone,
/// where Σ and b follow from the gap by the contact law (contact_law.hpp), c = push_out_speed; for every pair a moment
/// m resists rolling, |m_t| ≤ μ_r R* Σ λ_n, and spinning, |m_n| ≤ μ_s R* Σ λ_n, with the same rule on the relative
/// angular velocity. Frames and arms are those of the step's start; gaps follow the motion linearly. The problem knows
/// neither where contacts come from nor what the machine is made of, so it can be solved, written to a file and
/// benchmarked alone. World axes, SI; impulses in N s.
namespace drawpoint::engine {

/// A rigid body during the step. The fixed world is a body of zero inverse mass.
struct SolverBody {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(),
                  angular_velocity = Eigen::Vector3d::Zero();  ///< in: before the step; out: after
  Eigen::Vector3d external_velocity_change =
      Eigen::Vector3d::Zero();  ///< Δv by outer forces over the step [m/s]
  double inverse_mass = 0;
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();  ///< world axes, about the centre of mass
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero(),
                  rotation_vector =
                      Eigen::Vector3d::Zero();  ///< out: ∫ v dt [m] and ∫ ω dt [rad] over the step
};

/// A side of a contact: a rigid body (index ≥ 0) or part p of the machine (index −1 − p).
constexpr int machine_part(int part) { return -1 - part; }
constexpr int part_of(int index) { return -1 - index; }

struct ContactPoint {
  std::uint32_t feature = 0;  ///< label of the touching features, for starting the next step
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< world [m]
  /// From the body's centre of mass (the part's origin) to the point [m].
  Eigen::Vector3d arm_a = Eigen::Vector3d::Zero(), arm_b = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, from A to B; one per pair
  double gap = 0;                                    ///< at the step's start [m], negative when overlapping
  double stiffness = 1e9;                            ///< k at this point [N/m]
  double damping_time = 0;                           ///< τ [s]
  double friction = 0;                               ///< μ; one per pair: what the first point says
  double restitution = 0;                            ///< e, 0 to 1
  /// On B, world axes, of the substep that starts (in) or ended (out) the step, times S [N s].
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  ///< out: on B, world axes, over the step [N s]
  double warm_start_fraction =
      1;  ///< out: share of `start` that the next step may start from (contact_law-inl.h)
};

/// Two bodies that touch, with their points [first, first + count) and the moment between them.
struct ContactPair {
  int a = 0, b = 0;
  int collider_a = 0, collider_b = 0;  ///< label of the pair, for starting the next step
  int first = 0, count = 0;  ///< points lie pair after pair, without gaps; a pair without any carries nothing
  double rolling_arm = 0, spinning_arm = 0;           ///< μ_r R*, μ_s R* [m]
  Eigen::Vector3d start = Eigen::Vector3d::Zero();    ///< moment impulse on B, as ContactPoint::start [N m s]
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  ///< out: over the step [N m s]
};

struct ContactProblem {
  double step = 0;  ///< h [s]
  std::vector<SolverBody> bodies;
  std::vector<ContactPair> pairs;
  std::vector<ContactPoint> points;
  const SuperBody* machine = nullptr;
};

}  // namespace drawpoint::engine
