// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/machine/simbody_tree.h>

/// What a machine's loop pins and joints carried in a step, from the accelerations that it had.
///
/// With motor and stop forces τ on the joints and the loads f on the bodies, the equations of motion leave
/// Gᵀλ = τ + f − C − M u̇ to the pins: least squares for λ, exact up to round-off as the right side lies in
/// the range of Gᵀ. With the pins' forces on the bodies every tree joint follows by Newton-Euler
/// (joint_forces.h). All at the pose before the step, means over the step, SI units. Cost O(n³) with n
/// speeds. Internal, as simbody_types.h.
namespace drawpoint::engine::machine {

struct AppliedForces {
  SimTK::Vector joints;  ///< τ on each speed: motors and stops [N] or [N m]
  BodyForces bodies;     ///< f at the centres of mass, world axes: gravity, contacts, added forces
};

struct Reactions {
  std::vector<Wrench> joints;          ///< by the parent on the body at the joint point, in the body's axes
  std::vector<Eigen::Vector3d> loops;  ///< on each pin's point body, world axes [N]
};

/// G: loop constraints at the tree's pose, two rows per pin; acceleration: u̇.
Reactions reactions(const SimbodyTree& tree, const Eigen::MatrixXd& G, const AppliedForces& applied,
                    const Eigen::VectorXd& acceleration);

}  // namespace drawpoint::engine::machine
