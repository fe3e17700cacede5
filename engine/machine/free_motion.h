// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/machine/simbody_tree.h>

/// How a tree moves over a step under its outer forces, its inertia and a generalised force that stays as it is.
///
/// Runge and Kutta's fourth-order steps, as many as keep the turn of the fastest body within `flow_turn` in
/// each: the energy of a body that spins freely then changes by some 1e-10 of itself in a turn. Where
/// something holds the tree and its inertia turns its momentum by less than `least_turn` in the step, as in
/// machines at work, one step of the first order, which costs nothing. Loops are held by M⁻¹ − M⁻¹Gᵀ(G
/// M⁻¹Gᵀ)⁻¹G M⁻¹ (super_body.hpp); what they turn by in a step is projected when the step is kept. Cost:
/// three linearisations a step.
namespace drawpoint::engine::machine {

struct TreeMotion {
  SimTK::Vector q;
  Eigen::VectorXd u;
};

/// Mass matrix, loops and N of super_body.hpp at a state realised to velocities.
struct TreeDynamics {
  Eigen::MatrixXd M, G, N;
  Eigen::VectorXd bias;  ///< C(q, u) − f

  void linearise(const SimbodyTree& tree, const SimTK::State& state, const BodyForces& loads);
  /// C(q, u) − f with these forces on bodies and joints.
  static Eigen::VectorXd bias_under(const SimbodyTree& tree, const SimTK::State& state,
                                    const SimTK::Vector& joints, const BodyForces& loads);
  /// Under a generalised force besides.
  Eigen::VectorXd acceleration(const Eigen::VectorXd& force) const {
    return N * (N.transpose() * (force - bias));
  }
};

/// From the tree's state after a time h; `now`: there. Body forces in world axes.
TreeMotion free_motion(const SimbodyTree& tree, const TreeDynamics& now, const BodyForces& loads,
                       const Eigen::VectorXd& force, double h);

}  // namespace drawpoint::engine::machine
