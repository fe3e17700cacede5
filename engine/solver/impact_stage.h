// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/islands.h>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>

/// The impulse stage of a step: restitution, before anything else acts.
///
/// Runs when some point with restitution e > 0 closes within the step faster than `impact_speed`. All points
/// that touch (within 1e-6 m) or close within the step then take impulses with 0 ≤ λ_n ⊥ u_n⁺ + e' u_n⁻ ≥ 0
/// and friction, e' = e for impacts and 0 for the rest: Newton's law, all impacts at once, neither compliance
/// nor outer forces. Three balls in a row so share the impact at once, (−1/3, 2/3, 2/3) v for e = 1, where
/// real cradles pass it on. An impact comes early by up to a step, first order in h. With friction Newton's law may add
/// energy to an oblique impact (T. Kane): where it would, e' of all impacts that are joined by bodies which can move is
/// scaled by the largest factor, to 1e-3, at which they add none. There is one: at 0 each impulse works against its
/// contact's velocity. Solved by sequential iterations to a relative change of 1e-12, at most 10 000; costs nothing
/// where every e is 0.
namespace drawpoint::engine::detail {

class ImpactStage {
 public:
  /// Changes the velocities of the problem's bodies, and its machine for one that has taken the impacts; this
  /// stage must outlive the solve.
  void run(ContactProblem& problem, const ThreadPool& pool);

  /// After the solve: adds the stage's impulses to those of the step, and gives back the machine.
  void finish(ContactProblem& problem, SuperBodySolution& solution) const;

 private:
  bool needed(const ContactProblem& problem, const ThreadPool& pool) const;
  bool rebounds(const ContactProblem& problem, const ContactPair& pair) const;
  double normal_speed(const ContactProblem& problem, const ContactPair& pair,
                      const ContactPoint& point) const;
  void choose_points(const ContactProblem& problem);
  void solve(const ContactProblem& problem, const std::vector<double>& scales);  // scales: by group
  void solve_without_gain(const ContactProblem& problem);
  std::vector<bool> groups_that_gain(const ContactProblem& problem) const;

  bool ran_ = false;
  const SuperBody* machine_ = nullptr;
  SuperBody struck_, bare_;  // after the impacts; without rows
  ContactProblem stage_;
  std::vector<int> members_;     // the problem's point of each of the stage's
  std::vector<double> targets_;  // of the stage's points [m/s]
  Islands groups_;               // of impacts that share bodies which can move
  SuperBodySolution solution_;
};

}  // namespace drawpoint::engine::detail
