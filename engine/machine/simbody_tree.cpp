// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/simbody_tree.h>

#include <drawpoint/engine/machine/loop_projection.h>
#include <stdexcept>

namespace drawpoint::engine::machine {
namespace {

// A linkage has several ways to close; walking to a coordinate in steps this small [rad or m] keeps the one
// it is in.
constexpr double coordinate_step = 0.05;
constexpr double farthest = 1e7;         // norm of all coordinates
constexpr double restored_error = 1e-6;  // [m], and of unit quaternions: what a saved state may have at most

}  // namespace

SimbodyTree::SimbodyTree(const MachineSpec& s) : spec(s) {
  for (const BodySpec& body : spec.bodies) add_body(body);
  for (const LoopPinSpec& loop : spec.loops) add_loop(loop);
  state = system.realizeTopology();
  close_loops();
}

void SimbodyTree::add_body(const BodySpec& body) {
  SimTK::MobilizedBody& parent =
      body.parent < 0 ? static_cast<SimTK::MobilizedBody&>(matter.updGround()) : bodies[body.parent];
  const Eigen::Vector3d parent_origin =
      body.parent < 0 ? Eigen::Vector3d::Zero().eval() : spec.bodies[body.parent].centre;
  const SimTK::Body::Rigid rigid(mass_properties(body));
  if (body.joint == JointKind::free) {
    bodies.push_back(SimTK::MobilizedBody::Free(
        parent, SimTK::Transform(to_simbody(Eigen::Vector3d(body.centre - parent_origin))), rigid,
        SimTK::Transform()));
    return;
  }
  const bool hinge = body.joint == JointKind::hinge;
  const SimTK::CoordinateAxis along =
      hinge ? SimTK::CoordinateAxis(SimTK::ZAxis) : SimTK::CoordinateAxis(SimTK::XAxis);
  const SimTK::Rotation R(SimTK::UnitVec3(to_simbody(body.joint_axis)), along);
  const SimTK::Transform X_PF(R, to_simbody(Eigen::Vector3d(body.joint_point - parent_origin)));
  const SimTK::Transform X_BM(R, to_simbody(Eigen::Vector3d(body.joint_point - body.centre)));
  if (hinge)
    bodies.push_back(SimTK::MobilizedBody::Pin(parent, X_PF, rigid, X_BM));
  else
    bodies.push_back(SimTK::MobilizedBody::Slider(parent, X_PF, rigid, X_BM));
}

void SimbodyTree::add_loop(const LoopPinSpec& loop) {
  SimTK::Constraint::PointOnLine(bodies[loop.line_body], SimTK::UnitVec3(to_simbody(loop.axis)),
                                 station(loop.line_body, loop.point), bodies[loop.point_body],
                                 station(loop.point_body, loop.point));
}

// While these joints stay where they are, and bases too if the loops can be closed so.
void SimbodyTree::close_loops(const std::vector<int>& held) {
  std::vector<int> with_bases = held;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int k = 0; is_base(b) && k < bodies[b].getNumU(state); ++k)
      with_bases.push_back(static_cast<int>(speed_index(static_cast<int>(b))) + k);
  const SimTK::Vector before = state.getQ();
  try {
    project_on_loops(system, matter, with_bases, {}, state);
  } catch (const std::runtime_error&) {
    close_loops_by_all(held, before);
  }
  system.realize(state, SimTK::Stage::Velocity);
}

void SimbodyTree::close_loops_by_all(const std::vector<int>& held, const SimTK::Vector& before) {
  state.updQ() = before;
  try {
    project_on_loops(system, matter, held, {}, state);
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("machine::Machine: the loops cannot be closed at this pose (") +
                             error.what() + "); move the joints closer to a pose that the linkage can reach");
  }
}

bool SimbodyTree::is_base(std::size_t body) const {
  return spec.bodies[body].joint == JointKind::free && spec.bodies[body].parent < 0;
}

void SimbodyTree::place(const Eigen::Isometry3d& X_WM) {
  state = system.getDefaultState();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!is_base(b)) continue;
    // At zero coordinates the body stands at its centre in the machine frame; the joint's frame is there too.
    Eigen::Isometry3d X_FM = X_WM;
    X_FM.translation() = X_WM * spec.bodies[b].centre - spec.bodies[b].centre;
    bodies[b].setQToFitTransform(state, to_simbody(X_FM));
  }
  close_loops();
}

void SimbodyTree::set_coordinate(int body, double value) {
  const double start = coordinate(body);
  const int steps = 1 + static_cast<int>(std::abs(value - start) / coordinate_step);
  const SimTK::State before = state;
  try {
    for (int k = 1; k <= steps; ++k) {
      bodies[body].setOneQ(state, 0, start + (value - start) * k / steps);
      close_loops({static_cast<int>(speed_index(body))});
    }
  } catch (...) {
    state = before;
    system.realize(state, SimTK::Stage::Velocity);
    throw;
  }
}

void SimbodyTree::translate(const Eigen::Vector3d& by) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!is_base(b)) continue;
    SimTK::Transform X_FM = bodies[b].getMobilizerTransform(state);
    X_FM.updP() += SimTK::Vec3(by.x(), by.y(), by.z());
    bodies[b].setQToFitTransform(state, X_FM);
  }
  system.realize(state, SimTK::Stage::Velocity);
}

void SimbodyTree::set_velocity(const Eigen::Vector3d& velocity,
                               const std::vector<std::pair<int, double>>& joint_speeds) {
  const SimTK::SpatialVec V_FM(SimTK::Vec3(0), SimTK::Vec3(velocity.x(), velocity.y(), velocity.z()));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (is_base(b)) bodies[b].setUToFitVelocity(state, V_FM);
  for (const auto& [body, speed] : joint_speeds) bodies[body].setOneU(state, 0, speed);
  system.realize(state, SimTK::Stage::Velocity);
}

// Speeds are not projected here: the next w = NᵀMu is their mass-weighted projection, which keeps momentum.
void SimbodyTree::move(const Eigen::VectorXd& u, const SimTK::Vector& q, const Eigen::VectorXd& way) {
  const SimTK::Vector q_before = state.getQ(), u_before = state.getU();
  try {
    state.updQ() = q;
    system.realize(state, SimTK::Stage::Position);
    SimTK::Vector change;
    matter.multiplyByN(state, false, to_simbody(way), change);
    state.updQ() += change;
    state.updU() = to_simbody(u);
    project_on_loops(system, matter, {}, {}, state);
    system.realize(state, SimTK::Stage::Velocity);
  } catch (const std::exception& error) {
    put_back(q_before, u_before);
    throw std::runtime_error(
        std::string("machine::Machine::advance: the loops cannot be closed after the step (") + error.what() +
        "); use a smaller step");
  }
}

void SimbodyTree::set_motion(const Eigen::VectorXd& q, const Eigen::VectorXd& u) {
  const SimTK::Vector q_before = state.getQ(), u_before = state.getU();
  const auto refuse = [&](const std::string& what) {
    put_back(q_before, u_before);
    throw std::runtime_error("machine::Machine::set_state: " + what + "; give the state of the same machine");
  };
  if (!(q.norm() <= farthest && u.norm() <= fastest)) refuse("the coordinates or speeds are absurd");
  try {
    put_back(to_simbody(q), to_simbody(u));
  } catch (const std::exception& error) {
    refuse(std::string("the coordinates are no pose (") + error.what() + ")");
  }
  const SimTK::Vector errors = state.getQErr();
  for (int k = 0; k < errors.size(); ++k)
    if (!(std::abs(errors[k]) <= restored_error)) refuse("the coordinates do not close the loops");
}

void SimbodyTree::put_back(const SimTK::Vector& q, const SimTK::Vector& u) {
  state.updQ() = q;
  state.updU() = u;
  system.realize(state, SimTK::Stage::Velocity);
}

}  // namespace drawpoint::engine::machine
