// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/super_body.hpp>
#include <vector>

/// The machine's motion through the substeps of a sequential solve: its velocity w, and its motors and stops.
///
/// The machine is a body of unit mass in w (articulated_body.hpp). Where it takes part in a contact, rows R
/// of the part give u = R w, and an impulse λ there changes w by Rᵀ λ. A motor or stop row J takes the step
/// λ ← clamp(λ − (J w − b) / |J|², λ_min, λ_max), with b the motor's speed, or for a stop with gap g the −g/h
/// that closes it, −g / recovery past the end; g follows ∫ w dt. h is the substep. Cost of an iteration: the
/// sum of the rows' lengths.
namespace drawpoint::engine::detail {

using PartRows = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>>;

class SuperBodyMotion {
 public:
  /// nullptr: no machine, w and the rows are empty. `step`: the whole one [s].
  SuperBodyMotion(const SuperBody* machine, double step, int substeps);

  /// Rows for the velocity of a part's point at `arm` from its origin, in the given axes; returns their
  /// index.
  int add_rows(int part, const Eigen::Vector3d& arm, const Eigen::Matrix3d& axes);
  /// The same for a part's angular velocity.
  int add_angular_rows(int part, const Eigen::Matrix3d& axes);
  PartRows rows(int index) const { return {part_rows_.data() + 3 * w_.size() * index, 3, w_.size()}; }

  /// R w, and w ← w + Rᵀ λ. Coefficient by coefficient: there are some ten coordinates at most.
  Eigen::Vector3d velocity(int index) const { return rows(index).lazyProduct(w_); }
  void push(int index, const Eigen::Vector3d& impulse) { w_ += rows(index).transpose().lazyProduct(impulse); }

  /// Velocities that motors and stops must reach in this substep.
  void set_bias_velocities();
  /// First substep: outer forces, and the start impulses of motors and stops.
  void start();
  /// Other substeps: what changed w in the last one acts again.
  void extrapolate();
  /// w and the impulses of motors and stops as SequentialIteration::add_momentum.
  void add_momentum(double share);
  /// One step of every motor and stop.
  void iteration();
  /// By how much its momentum has changed since this was asked last [N s], all of its mass counted (motion_change.h).
  double moved();
  /// Adds the substep's displacement and impulses to the step's.
  void finish();
  /// Whether no part is faster than that at its origin [m/s, rad/s], before and after the substep; without a machine
  /// true.
  bool stands(double speed) const { return slower(begin_, speed) && slower(w_, speed); }
  /// finish() so many times.
  void repeat(int substeps);

  /// The machine's part of the solution, but for contact impulses on its parts: these are zero.
  SuperBodySolution store() const;

 private:
  struct Row {
    double inverse, impulse;  // 1/|J|²; of the substep
    double previous = 0;      // what momentum goes on from
    double total = 0, target = 0;
  };
  int add(const Eigen::Matrix<double, 3, Eigen::Dynamic>& rows);
  bool slower(const Eigen::VectorXd& w, double speed) const;

  const SuperBody* machine_;
  double step_, h_;
  int substeps_;
  double root_mass_ = 0;  // of all that its heaviest part carries along [√kg]
  Eigen::VectorXd w_, begin_, push_, travel_, previous_, watched_;
  std::vector<Row> rows_;          // in the order of SuperBody::rows
  std::vector<double> part_rows_;  // 3 x r each, column by column
};

}  // namespace drawpoint::engine::detail
