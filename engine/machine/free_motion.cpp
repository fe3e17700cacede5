// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/free_motion.h>

#include <drawpoint/engine/machine/constrained_response.h>
#include <algorithm>
#include <cmath>

namespace drawpoint::engine::machine {
namespace {

constexpr double flow_turn = 0.05;  // [rad]; an oscillation loses x⁶/72 of its energy in a step of x radians
constexpr double least_turn = 0.005;  // [rad]; a step of the first order adds x² of it
constexpr int most_steps = 200;       // of the flow in a step

struct Rates {
  SimTK::Vector q;
  Eigen::VectorXd u;
};

int steps_of(const SimbodyTree& tree, double h) {
  double fastest = 0;
  for (const SimTK::MobilizedBody& body : tree.bodies)
    fastest = std::max(fastest, body.getBodyAngularVelocity(tree.state).norm());
  return static_cast<int>(std::clamp(std::ceil(h * fastest / flow_turn), 1.0, double(most_steps)));
}

// Whether inertia forces hardly turn the momentum.
bool turns_little(const SimbodyTree& tree, const TreeDynamics& now, double h) {
  const SimTK::Vector none(tree.state.getNU(), 0.0);
  const BodyForces no_loads(tree.matter.getNumBodies(), SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0)));
  const Eigen::VectorXd inertia = TreeDynamics::bias_under(tree, tree.state, none, no_loads);
  const Eigen::VectorXd w = now.N.transpose() * (now.M * view(tree.state.getU()));
  return h * (now.N.transpose() * inertia).norm() <= least_turn * w.norm();
}

TreeMotion straight_motion(const SimbodyTree& tree, const Eigen::VectorXd& acceleration, double h) {
  const Eigen::VectorXd u = view(tree.state.getU());
  SimTK::Vector way;
  tree.matter.multiplyByN(tree.state, false, to_simbody(Eigen::VectorXd(h * (u + 0.5 * h * acceleration))),
                          way);
  return {tree.state.getQ() + way, u + h * acceleration};
}

}  // namespace

Eigen::VectorXd TreeDynamics::bias_under(const SimbodyTree& tree, const SimTK::State& state,
                                         const SimTK::Vector& joints, const BodyForces& loads) {
  SimTK::Vector residual;
  tree.matter.calcResidualForceIgnoringConstraints(state, joints, loads, SimTK::Vector(state.getNU(), 0.0),
                                                   residual);
  return view(residual);
}

void TreeDynamics::linearise(const SimbodyTree& tree, const SimTK::State& state, const BodyForces& loads) {
  SimTK::Matrix matrix;
  tree.matter.calcM(state, matrix);
  M = to_eigen(matrix);
  tree.matter.calcG(state, matrix);
  G = to_eigen(matrix);
  N = constrained_response(M, G);
  bias = bias_under(tree, state, SimTK::Vector(state.getNU(), 0.0), loads);
}

TreeMotion free_motion(const SimbodyTree& tree, const TreeDynamics& now, const BodyForces& loads,
                       const Eigen::VectorXd& force, double h) {
  const int steps = steps_of(tree, h);
  if (!force.isZero(0) && steps == 1 && turns_little(tree, now, h))
    return straight_motion(tree, now.acceleration(force), h);
  const double dt = h / steps;
  SimTK::State state = tree.state;
  TreeDynamics dynamics;
  TreeMotion motion{state.getQ(), view(state.getU())};
  const auto rates_at = [&](const SimTK::Vector& q, const Eigen::VectorXd& u) -> Rates {
    state.updQ() = q;
    state.updU() = to_simbody(u);
    tree.system.realize(state, SimTK::Stage::Velocity);
    dynamics.linearise(tree, state, loads);
    return {state.getQDot(), dynamics.acceleration(force)};
  };
  for (int k = 0; k < steps; ++k) {
    const Rates r1 =
        k == 0 ? Rates{tree.state.getQDot(), now.acceleration(force)} : rates_at(motion.q, motion.u);
    const Rates r2 = rates_at(motion.q + 0.5 * dt * r1.q, motion.u + 0.5 * dt * r1.u);
    const Rates r3 = rates_at(motion.q + 0.5 * dt * r2.q, motion.u + 0.5 * dt * r2.u);
    const Rates r4 = rates_at(motion.q + dt * r3.q, motion.u + dt * r3.u);
    motion.q += dt / 6 * (r1.q + 2 * r2.q + 2 * r3.q + r4.q);
    motion.u += dt / 6 * (r1.u + 2 * r2.u + 2 * r3.u + r4.u);
  }
  return motion;
}

}  // namespace drawpoint::engine::machine
