// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <drawpoint/engine/contact/articulated_body.hpp>
#include <vector>

/// One step's contact problem as plain arrays: bodies with velocities, contact points, rolling rows, one
/// machine.
///
/// Find impulses such that for every point with frame (n, t1, t2) and relative velocity u = v_B − v_A there
///     0 ≤ λ_n ⊥ u_n + Σ λ_n − b ≥ 0,      |λ_t| ≤ μ λ_n,  u_t = −s λ_t with s ≥ 0, s = 0 inside the cone,
/// and for every pair |m_r| ≤ μ_r R* Σ λ_n with the same rule on the relative angular velocity (rolling and
/// spinning). The problem knows neither where contacts come from nor what the machine is made of, so it can
/// be solved, dumped and benchmarked alone. World axes, SI; impulses in N s.
namespace drawpoint::engine::contact {

/// A rigid body during the step. The fixed world is a body of zero inverse mass.
struct SolverBody {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), angular_velocity = Eigen::Vector3d::Zero();
  double inverse_mass = 0;
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();  ///< world axes, about the centre of mass
};

/// A side of a contact: a rigid body (index ≥ 0) or part p of the machine (index −1 − p).
constexpr int machine_part(int part) { return -1 - part; }
constexpr int part_of(int index) { return -1 - index; }

struct ContactPoint {
  int a = 0, b = 0;
  std::uint32_t feature = 0;     ///< label of the touching features, for starting the next step
  Eigen::Vector3d position;      ///< world [m]
  Eigen::Vector3d arm_a, arm_b;  ///< from the body's centre of mass (the part's origin) to the point [m]
  Eigen::Vector3d normal;        ///< unit, from A to B
  double sigma = 0, target = 0;  ///< Σ, b of the normal law
  double friction = 0;           ///< μ
  Eigen::Vector3d impulse =
      Eigen::Vector3d::Zero();  ///< on B, world axes [N s]; in: start value, out: solution
};

/// Rolling resistance of one pair, over its points [first, first + count).
struct RollingRow {
  int a = 0, b = 0;
  int collider_a = 0, collider_b = 0;  ///< label of the pair, for starting the next step
  int first = 0, count = 0;
  double arm = 0;                                     ///< μ_r R* [m]
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  ///< moment impulse on B, world axes [N m s]; in and out
};

struct ContactProblem {
  std::vector<SolverBody> bodies;  ///< in: velocities before contact impulses; out: after
  std::vector<ContactPoint> points;
  std::vector<RollingRow> rolling;
  const SuperBody* machine = nullptr;
};

}  // namespace drawpoint::engine::contact
