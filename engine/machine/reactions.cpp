// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/joint_forces.h>
#include <drawpoint/engine/machine/reactions.h>

namespace drawpoint::engine::machine {
namespace {

struct LoopForces {
  std::vector<Eigen::Vector3d> pins;  // on each pin's point body
  BodyForces bodies;                  // of all pins
};

BodyForces no_forces(const SimbodyTree& tree) {
  return BodyForces(tree.matter.getNumBodies(), SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0)));
}

// From the generalised force that the pins add up to; each owns two rows of G.
LoopForces loop_forces(const SimbodyTree& tree, const Eigen::MatrixXd& G,
                       const Eigen::VectorXd& generalised) {
  LoopForces found{{}, no_forces(tree)};
  if (tree.spec.loops.empty()) return found;
  const Eigen::VectorXd lambda = G.transpose().colPivHouseholderQr().solve(generalised);
  for (std::size_t l = 0; l < tree.spec.loops.size(); ++l) {
    const Eigen::Index row = 2 * static_cast<Eigen::Index>(l);
    Eigen::VectorXd own = Eigen::VectorXd::Zero(lambda.size());
    own.segment<2>(row) = lambda.segment<2>(row);
    BodyForces forces;
    SimTK::Vector unused;
    tree.matter.calcConstraintForcesFromMultipliers(tree.state, to_simbody(own), forces, unused);
    const SimTK::MobilizedBody& point_body = tree.bodies[tree.spec.loops[l].point_body];
    found.pins.push_back(to_eigen(forces[point_body.getMobilizedBodyIndex()][1]));
    found.bodies += forces;
  }
  return found;
}

// A: accelerations of the bodies; loads: all but the tree joints'.
BodyMotion motion_of(const SimbodyTree& tree, std::size_t b, const SimTK::SpatialVec& A,
                     const SimTK::SpatialVec& loads) {
  const SimTK::MobilizedBody& mobilised = tree.bodies[b];
  const Eigen::Matrix3d R = to_eigen(mobilised.getBodyRotation(tree.state));
  const BodySpec& body = tree.spec.bodies[b];
  const SimTK::Vec3 joint_point = tree.station(static_cast<int>(b), body.joint_point);
  return {body.parent,
          body.mass,
          R * body.inertia * R.transpose(),
          to_eigen(mobilised.getBodyOriginLocation(tree.state)),
          to_eigen(mobilised.findStationLocationInGround(tree.state, joint_point)),
          to_eigen(mobilised.getBodyAngularVelocity(tree.state)),
          to_eigen(A[0]),
          to_eigen(A[1]),
          to_eigen(loads[0]),
          to_eigen(loads[1])};
}

// In the body's axes at the pose that they belong to, not the one after the step.
Wrench in_body_axes(const SimbodyTree& tree, std::size_t b, const JointForce& joint) {
  const Eigen::Matrix3d R_BW = to_eigen(tree.bodies[b].getBodyRotation(tree.state)).transpose();
  return {R_BW * joint.moment, R_BW * joint.force};
}

}  // namespace

Reactions reactions(const SimbodyTree& tree, const Eigen::MatrixXd& G, const AppliedForces& applied,
                    const Eigen::VectorXd& acceleration) {
  const SimTK::Vector udot = to_simbody(acceleration);
  SimTK::Vector residual;
  tree.matter.calcResidualForceIgnoringConstraints(tree.state, applied.joints, applied.bodies, udot,
                                                   residual);  // = −Gᵀλ
  LoopForces loops = loop_forces(tree, G, view(residual));
  BodyForces A;
  tree.matter.calcBodyAccelerationFromUDot(tree.state, udot, A);
  std::vector<BodyMotion> motion;
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    const int i = tree.bodies[b].getMobilizedBodyIndex();
    motion.push_back(motion_of(tree, b, A[i], applied.bodies[i] + loops.bodies[i]));
  }
  const std::vector<JointForce> joints = joint_forces(motion);
  Reactions found{{}, std::move(loops.pins)};
  for (std::size_t b = 0; b < joints.size(); ++b) found.joints.push_back(in_body_axes(tree, b, joints[b]));
  return found;
}

}  // namespace drawpoint::engine::machine
