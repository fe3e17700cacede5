// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/wrench.hpp>
#include <drawpoint/engine/machine/machine_spec.hpp>
#include <drawpoint/engine/world/articulated_body.hpp>
#include <memory>
#include <utility>
#include <vector>

/// An articulated machine on Simbody, stepped as a super-body of the contact solver.
///
/// Per step of h: Simbody gives M(q), G(q), the system Jacobian and the bias f − C(q, u); N spans the null
/// space of G with Nᵀ M N = 1, so that w = NᵀM u and w* = w + h Nᵀ(f − C). The solver returns w⁺ and w̄, its
/// mean over the substeps; then u⁺ = N w⁺, q⁺ = q + h Q(q) N w̄, and q is projected on to the loops (error
/// below 1e-9 m). First order in h, like the rocks' stepper.
///
/// Joint forces follow from the step's accelerations: the loop multipliers from the equations of motion,
/// Gᵀλ = f − C − M (u⁺ − u)/h (least squares, exact up to round-off as the residual lies in the range of Gᵀ),
/// then every tree joint by Newton-Euler from the leaves to the root. A wrench is a mean over the step.
///
/// Cost: O(n³) with n speeds, about 0.1-0.2 ms for n = 21. Not thread-safe; copies share nothing (not
/// copyable). Throws std::invalid_argument for a bad specification, std::runtime_error if the loops cannot be
/// closed.
namespace drawpoint::engine::machine {

using engine::Wrench;

class Machine final : public engine::ArticulatedBody {
 public:
  explicit Machine(const MachineSpec& spec);
  ~Machine() override;

  const MachineSpec& spec() const;

  /// Puts the machine at rest in its reference pose with the machine frame at X_WM.
  void place(const Eigen::Isometry3d& X_WM);

  /// Sets one joint's coordinate, at most 1e4 [rad] or [m] either way; the other joints of its loops follow.
  /// Throws std::invalid_argument for a body without one and for other values, std::runtime_error for a
  /// coordinate that the loops do not reach; the machine has not moved then.
  void set_coordinate(int body, double value);

  /// Moves the machine as it is, speeds and joints kept, by a world vector [m].
  void translate(const Eigen::Vector3d& by);
  /// Gives the free bases this velocity without turning (world) [m/s] and the hinges or sliders `bodies` the speeds
  /// [rad/s] or [m/s]; other joints keep theirs. Loops must allow it: the next step projects what they do not.
  void set_velocity(const Eigen::Vector3d& velocity, const std::vector<std::pair<int, double>>& joint_speeds);

  double coordinate(int body) const;  ///< joint coordinate [rad] or [m]; hinge or slider only
  double speed(int body) const;       ///< [rad/s] or [m/s]
  double loop_error() const;          ///< largest distance of a loop point from its pin axis [m]
  double energy(const Eigen::Vector3d& gravity) const;  ///< kinetic + potential [J]

  Eigen::Isometry3d pose(int body) const;  ///< X_WB; the body frame has its origin at the centre of mass
  /// World position / velocity of the body point that stands at p_M in the reference pose.
  Eigen::Vector3d point(int body, const Eigen::Vector3d& p_M) const;
  Eigen::Vector3d point_velocity(int body, const Eigen::Vector3d& p_M) const;

  void set_motor(int motor, double speed);  ///< [rad/s] or [m/s]
  /// From now on at most this force on each of the motor's joints [N m] or [N], 0 to the specification's.
  void limit_motor(int motor, double force);
  double motor_force(int motor) const;  ///< mean over the last step [N m] or [N]

  /// How fast the joints `driven` move for unit speed of each of the joints `drivers`, with free bases and
  /// the joints `held` at rest: driven x drivers. The drivers must be as many as the freedoms that are left.
  Eigen::MatrixXd transmission(const std::vector<int>& driven, const std::vector<int>& drivers,
                               const std::vector<int>& held) const;

  /// Wrench that the parent put on the body at its joint point in the last step, mean over the step, in the
  /// body's axes.
  Wrench joint_wrench(int body) const;
  /// Force on the point body of a loop pin in the last step, world axes [N].
  Eigen::Vector3d loop_force(int loop) const;

  /// Extra force on a body for the next step only: at its centre of mass, world axes.
  void add_force(int body, const Wrench& wrench);

  int parts() const override;
  Eigen::Isometry3d part_pose(int part) const override;
  const engine::SuperBody& linearise(double h, const Eigen::Vector3d& gravity) override;
  /// Throws std::runtime_error if the speeds are absurd or the loops cannot be closed any more; the machine
  /// has not moved then.
  void advance(const engine::SuperBodySolution& solution) override;

  /// Coordinates, speeds, set speeds and limits, added forces, and of the last step the row impulses and joint
  /// forces.
  std::vector<double> state() const override;
  void set_state(const std::vector<double>& state) override;

 private:
  struct Simbody;
  std::unique_ptr<Simbody> simbody_;
};

}  // namespace drawpoint::engine::machine
