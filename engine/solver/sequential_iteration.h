// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_block.h>
#include <drawpoint/engine/solver/super_body_motion.h>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/solver/solver_options.hpp>
#include <drawpoint/engine/solver/solver_report.hpp>
#include <vector>

/// Gauss-Seidel iterations over the points, pairs and machine rows of a ContactProblem, in double precision.
///
/// Works on the bodies' velocities in the problem and on the machine's w. A substep is: refresh(); then
/// either start() in the first substep or extrapolate() in the others; iteration() as often as wanted; and
/// finish(). Extrapolating, v = 2 v_end − v_begin of the last substep, adds the outer forces' share and last
/// substep's contact impulses to every body at once, because that is what changed it.
namespace drawpoint::engine::detail {

/// Sums over points of the natural map of their law (residual.hpp) [N s].
struct ResidualSums {
  double normal = 0, tangent = 0;
  double load = 0;  ///< what they are relative to
};

inline void report_residual(const ResidualSums& residual_sums, SolverReport& report) {
  if (residual_sums.load <= 0) return;
  report.complementarity = residual_sums.normal / residual_sums.load;
  report.cone = residual_sums.tangent / residual_sums.load;
}

class SequentialIteration {
 public:
  SequentialIteration(ContactProblem& problem, int substeps);

  /// Gaps and targets from the bodies' velocities, which are those at the end of the last substep.
  void refresh();
  /// In place of refresh(): the velocities that the points' normals must reach [m/s], however fast.
  void set_bias_velocities(const std::vector<double>& targets);
  /// First substep: the machine's outer forces, and the start impulses on bodies and machine.
  void start();
  /// Other substeps: the machine's w; the bodies are the caller's.
  void extrapolate() { machine_.extrapolate(); }
  /// After extrapolating: takes back the impacts that it repeated.
  void correct();
  /// Adds this share of what impulses and the machine's w have changed by since the last call, but for 0, when the
  /// changes begin to count. The bodies are the caller's.
  void add_momentum(double share);
  /// Returns Σ|Δλ| over the points.
  double iteration();
  /// Moves the impulses to where the iterations lead, at once; without a machine (direct_solution.h).
  void solve_directly();
  /// Returns how far the last iteration moved the machine, as SuperBodyMotion::moved() does.
  double machine_moved() { return machine_.moved(); }
  /// Adds the substep's impulses and the machine's displacement to the step's.
  void finish();

  /// Whether the machine stands (SuperBodyMotion::stands).
  bool stands(double speed) const { return machine_.stands(speed); }
  /// Adds substeps that repeat the impulses and speeds of the last one.
  void repeat(int substeps);

  double normal_load() const;          ///< Σ λ_n of the substep [N s]
  ResidualSums residual_sums() const;  ///< of the points, at the velocities reached

  /// Writes the impulses into the problem and returns the machine's part.
  SuperBodySolution store();

 private:
  Eigen::Matrix3d response(int index, const Eigen::Vector3d& arm, const Eigen::Matrix3d& frame) const;
  void add_pair(const ContactPair& pair);
  void add_point(const ContactPair& pair, const ContactPoint& point);
  void add_part_response(ContactBlock& block) const;
  void carry_over();
  void solve_point(PointBlock& p);
  void solve_pair(PairBlock& r);
  Eigen::Vector3d velocity(const PointBlock& p) const;
  Eigen::Vector3d spin(const PairBlock& r) const;
  void apply(const PointBlock& p, const Eigen::Vector3d& delta);
  void apply(const PairBlock& r, const Eigen::Vector3d& delta);

  ContactProblem& problem_;
  int substeps_;
  double h_;
  bool fresh_ = true;
  SuperBodyMotion machine_;
  std::vector<PointBlock> points_;
  std::vector<PairBlock> pairs_;
  double change_ = 0;
  double fastest_ = constants::push_out_speed;  // that contacts push; set velocities have no bound
};

}  // namespace drawpoint::engine::detail
