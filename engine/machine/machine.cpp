// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <Simbody.h>

#include <algorithm>
#include <drawpoint/engine/machine/constrained_response.hpp>
#include <drawpoint/engine/machine/joint_forces.hpp>
#include <drawpoint/engine/machine/machine.hpp>
#include <drawpoint/engine/machine/machine_rows.hpp>
#include <stdexcept>

namespace drawpoint::engine::machine {
namespace {

// A linkage has several ways to close; walking to a coordinate in steps this small [rad or m] keeps the one
// it is in.
constexpr double coordinate_step = 0.05;
constexpr double fastest_motor = 1e3;     // [m/s] or [rad/s]
constexpr double fastest_speed = 1e5;     // norm of all joint speeds; beyond, a step has broken down
constexpr double farthest = 1e7;          // norm of all coordinates
constexpr double restored_error = 1e-6;   // [m], and of unit quaternions: what a saved state may have at most
constexpr double loop_tolerance = 1e-11;  // [m], what projection aims at; the promise is 1e-9

SimTK::Vec3 to_simbody(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d to_eigen(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }
SimTK::SpatialVec to_simbody(const Wrench& w) { return {to_simbody(w.moment), to_simbody(w.force)}; }

Eigen::Map<const Eigen::VectorXd> view(const SimTK::Vector& v) {
  return {v.size() ? &v[0] : nullptr, v.size()};
}
Eigen::MatrixXd to_eigen(const SimTK::Matrix& m) {
  Eigen::MatrixXd out(m.nrow(), m.ncol());
  for (int j = 0; j < m.ncol(); ++j)
    for (int i = 0; i < m.nrow(); ++i) out(i, j) = m(i, j);
  return out;
}
SimTK::Vector to_simbody(const Eigen::VectorXd& v) {
  return SimTK::Vector(static_cast<int>(v.size()), v.data());
}

Eigen::Matrix3d to_eigen(const SimTK::Rotation& R) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out(i, j) = R[i][j];
  return out;
}
Eigen::Isometry3d to_eigen(const SimTK::Transform& X) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = to_eigen(X.R());
  out.translation() = to_eigen(X.p());
  return out;
}
SimTK::Transform to_simbody(const Eigen::Isometry3d& X) {
  SimTK::Mat33 R;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) = X.linear()(i, j);
  return {SimTK::Rotation(R), to_simbody(Eigen::Vector3d(X.translation()))};
}

SimTK::MassProperties mass_properties(const BodySpec& body) {
  const Eigen::Matrix3d& I = body.inertia;
  return {body.mass, SimTK::Vec3(0), SimTK::Inertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2))};
}

}  // namespace

struct Machine::Simbody {
  MachineSpec spec;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> bodies;  // in the order of the spec
  std::vector<SimTK::Constraint::PointOnLine> loops;
  SimTK::State state;

  std::vector<double> motor_targets, motor_forces, row_starts;
  std::vector<Wrench> extra;      // by add_force, for the next step
  std::vector<Wrench> reactions;  // of the last step, in the body's axes
  std::vector<Eigen::Vector3d> loop_forces;

  // The linearisation of the present step.
  double h = 0;
  Eigen::Vector3d gravity;
  Eigen::MatrixXd M, G, J, N;  // J: 6 (bodies + 1) x n, ground first
  SimTK::Vector bias;          // C(q, u) − f
  contact::SuperBody super;

  explicit Simbody(const MachineSpec& s) : spec(s) {
    for (const BodySpec& body : spec.bodies) add_body(body);
    for (const LoopPinSpec& loop : spec.loops) add_loop(loop);
    state = system.realizeTopology();
    motor_targets.assign(spec.motors.size(), 0.0);
    motor_forces.assign(spec.motors.size(), 0.0);
    row_starts.assign(spec.motors.size() + spec.stops.size(), 0.0);
    extra.assign(spec.bodies.size(), Wrench());
    reactions.assign(spec.bodies.size(), Wrench());
    loop_forces.assign(spec.loops.size(), Eigen::Vector3d::Zero());
    settle_state();
  }

  void add_body(const BodySpec& body) {
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

  void add_loop(const LoopPinSpec& loop) {
    loops.emplace_back(bodies[loop.line_body], SimTK::UnitVec3(to_simbody(loop.axis)),
                       to_simbody(Eigen::Vector3d(loop.point - spec.bodies[loop.line_body].centre)),
                       bodies[loop.point_body],
                       to_simbody(Eigen::Vector3d(loop.point - spec.bodies[loop.point_body].centre)));
  }

  // Closes the loops in q and u.
  void settle_state() {
    system.realize(state, SimTK::Stage::Position);
    try {
      system.project(state, loop_tolerance);
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string("machine::Machine: the loops cannot be closed at this pose (") +
                               error.what() +
                               "); move the joints closer to a pose that the linkage can reach");
    }
    system.realize(state, SimTK::Stage::Velocity);
  }

  void put_back(const SimTK::Vector& q, const SimTK::Vector& u) {
    state.updQ() = q;
    state.updU() = u;
    system.realize(state, SimTK::Stage::Velocity);
  }

  // Coordinates and speeds as they once were, not projected: the same bits. They must close the loops.
  void set_motion(const Eigen::VectorXd& q, const Eigen::VectorXd& u) {
    const SimTK::Vector q_before = state.getQ(), u_before = state.getU();
    const auto refuse = [&](const std::string& what) {
      put_back(q_before, u_before);
      throw std::runtime_error("machine::Machine::set_state: " + what +
                               "; give the state of the same machine");
    };
    if (!(q.norm() <= farthest && u.norm() <= fastest_speed)) refuse("the coordinates or speeds are absurd");
    try {
      put_back(to_simbody(q), to_simbody(u));
    } catch (const std::exception& error) {
      refuse(std::string("the coordinates are no pose (") + error.what() + ")");
    }
    const SimTK::Vector errors = state.getQErr();
    for (int k = 0; k < errors.size(); ++k)
      if (!(std::abs(errors[k]) <= restored_error)) refuse("the coordinates do not close the loops");
  }

  Eigen::Vector3d local(int body, const Eigen::Vector3d& p_M) const { return p_M - spec.bodies[body].centre; }
  Eigen::Index speed_index(int body) const { return bodies[body].getFirstUIndex(state); }

  StopSide side_of(const StopSpec& stop) const {
    return nearer_stop(stop, bodies[stop.body].getOneQ(state, 0));
  }

  void linearise_dynamics();
  void build_rows();
  SimTK::Vector_<SimTK::SpatialVec> loads(const std::vector<contact::SpatialVector>* part_impulses) const;
  SimTK::Vector_<SimTK::SpatialVec> recover_loops(const Eigen::VectorXd& generalised);
  void recover_forces(const contact::SuperBodySolution& solution, const Eigen::VectorXd& acceleration);
};

void Machine::Simbody::linearise_dynamics() {
  SimTK::Matrix matrix;
  matter.calcM(state, matrix);
  M = to_eigen(matrix);
  matter.calcG(state, matrix);
  G = to_eigen(matrix);
  matter.calcSystemJacobian(state, matrix);
  J = to_eigen(matrix);
  N = constrained_response(M, G);
  const SimTK::Vector none(state.getNU(), 0.0);
  matter.calcResidualForceIgnoringConstraints(state, none, loads(nullptr), none, bias);
}

// Gravity and added forces on every body, with the contact impulses over the step when they are known.
SimTK::Vector_<SimTK::SpatialVec> Machine::Simbody::loads(
    const std::vector<contact::SpatialVector>* part_impulses) const {
  SimTK::Vector_<SimTK::SpatialVec> forces(matter.getNumBodies(),
                                           SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0)));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Wrench total = extra[b];
    total.force += spec.bodies[b].mass * gravity;
    if (part_impulses) {
      total.moment += (*part_impulses)[b].head<3>() / h;
      total.force += (*part_impulses)[b].tail<3>() / h;
    }
    forces[bodies[b].getMobilizedBodyIndex()] += to_simbody(total);
  }
  return forces;
}

void Machine::Simbody::build_rows() {
  super.rows.clear();
  const std::size_t n_motors = spec.motors.size();
  for (std::size_t m = 0; m < n_motors; ++m) {
    Eigen::RowVectorXd joints = Eigen::RowVectorXd::Zero(N.cols());
    for (int body : spec.motors[m].bodies) joints += N.row(speed_index(body));
    super.rows.push_back(motor_row(spec.motors[m], joints, motor_targets[m], h, row_starts[m]));
  }
  for (std::size_t s = 0; s < spec.stops.size(); ++s)
    super.rows.push_back(stop_row(side_of(spec.stops[s]), N.row(speed_index(spec.stops[s].body)), h,
                                  row_starts[n_motors + s]));
}

// Loop forces on every body from the generalised force that they must add up to; each pin owns two rows of G.
SimTK::Vector_<SimTK::SpatialVec> Machine::Simbody::recover_loops(const Eigen::VectorXd& generalised) {
  const SimTK::SpatialVec zero(SimTK::Vec3(0), SimTK::Vec3(0));
  SimTK::Vector_<SimTK::SpatialVec> total(matter.getNumBodies(), zero);
  if (loops.empty()) return total;
  const Eigen::VectorXd lambda = G.transpose().colPivHouseholderQr().solve(generalised);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const Eigen::Index row = 2 * static_cast<Eigen::Index>(l);
    Eigen::VectorXd own = Eigen::VectorXd::Zero(lambda.size());
    own.segment<2>(row) = lambda.segment<2>(row);
    SimTK::Vector_<SimTK::SpatialVec> forces;
    SimTK::Vector unused;
    matter.calcConstraintForcesFromMultipliers(state, to_simbody(own), forces, unused);
    loop_forces[l] = to_eigen(forces[bodies[spec.loops[l].point_body].getMobilizedBodyIndex()][1]);
    total += forces;
  }
  return total;
}

void Machine::Simbody::recover_forces(const contact::SuperBodySolution& solution,
                                      const Eigen::VectorXd& acceleration) {
  const std::size_t n_motors = spec.motors.size();
  SimTK::Vector mobility(state.getNU(), 0.0);
  for (std::size_t m = 0; m < n_motors; ++m) {
    motor_forces[m] = solution.row_impulses[m] / h;
    for (int body : spec.motors[m].bodies) mobility[static_cast<int>(speed_index(body))] += motor_forces[m];
  }
  for (std::size_t s = 0; s < spec.stops.size(); ++s)
    mobility[static_cast<int>(speed_index(spec.stops[s].body))] +=
        side_of(spec.stops[s]).sign * solution.row_impulses[n_motors + s] / h;
  SimTK::Vector residual, udot = to_simbody(acceleration);
  const auto applied = loads(&solution.part_impulses);
  matter.calcResidualForceIgnoringConstraints(state, mobility, applied, udot, residual);  // = −Gᵀλ

  const auto loop_loads = recover_loops(view(residual));
  SimTK::Vector_<SimTK::SpatialVec> A;
  matter.calcBodyAccelerationFromUDot(state, udot, A);
  std::vector<BodyMotion> motion(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const int i = bodies[b].getMobilizedBodyIndex();
    const Eigen::Matrix3d R = to_eigen(bodies[b].getBodyRotation(state));
    const BodySpec& body = spec.bodies[b];
    motion[b] = {body.parent,
                 body.mass,
                 R * body.inertia * R.transpose(),
                 to_eigen(bodies[b].getBodyOriginLocation(state)),
                 to_eigen(bodies[b].findStationLocationInGround(
                     state, to_simbody(local(static_cast<int>(b), body.joint_point)))),
                 to_eigen(bodies[b].getBodyAngularVelocity(state)),
                 to_eigen(A[i][0]),
                 to_eigen(A[i][1]),
                 to_eigen(applied[i][0] + loop_loads[i][0]),
                 to_eigen(applied[i][1] + loop_loads[i][1])};
  }
  const auto joints = joint_forces(motion);
  for (std::size_t b = 0; b < bodies.size();
       ++b) {  // at the pose that they belong to, not the one after the step
    const Eigen::Matrix3d R_BW = to_eigen(bodies[b].getBodyRotation(state)).transpose();
    reactions[b] = {R_BW * joints[b].moment, R_BW * joints[b].force};
  }
}

Machine::Machine(const MachineSpec& spec) {
  check(spec);
  simbody_ = std::make_unique<Simbody>(spec);
}
Machine::~Machine() = default;

const MachineSpec& Machine::spec() const { return simbody_->spec; }
int Machine::parts() const { return static_cast<int>(simbody_->bodies.size()); }

void Machine::place(const Eigen::Isometry3d& X_WM) {
  Simbody& s = *simbody_;
  s.state = s.system.getDefaultState();
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    if (s.spec.bodies[b].joint != JointKind::free || s.spec.bodies[b].parent >= 0) continue;
    // At zero coordinates the body stands at its centre in the machine frame; the joint's frame is there too.
    Eigen::Isometry3d X_FM = X_WM;
    X_FM.translation() = X_WM * s.spec.bodies[b].centre - s.spec.bodies[b].centre;
    s.bodies[b].setQToFitTransform(s.state, to_simbody(X_FM));
  }
  std::fill(s.row_starts.begin(), s.row_starts.end(), 0.0);
  s.settle_state();
}

void Machine::set_coordinate(int body, double value) {
  Simbody& s = *simbody_;
  const double start = coordinate(body);
  const int steps = 1 + static_cast<int>(std::abs(value - start) / coordinate_step);
  for (int k = 1; k <= steps; ++k) {
    s.bodies[body].lockAt(s.state,
                          start + (value - start) * k / steps);  // held while the rest of its loops follow
    s.settle_state();
  }
  s.bodies[body].unlock(s.state);
  s.system.realize(s.state, SimTK::Stage::Velocity);
}

double Machine::coordinate(int body) const { return simbody_->bodies[body].getOneQ(simbody_->state, 0); }
double Machine::speed(int body) const { return simbody_->bodies[body].getOneU(simbody_->state, 0); }

double Machine::loop_error() const {
  const Simbody& s = *simbody_;
  double worst = 0;
  for (const LoopPinSpec& loop : s.spec.loops) {
    const Eigen::Vector3d gap = point(loop.point_body, loop.point) - point(loop.line_body, loop.point);
    const Eigen::Vector3d axis = pose(loop.line_body).linear() * loop.axis;
    worst = std::max(worst, (gap - axis * axis.dot(gap)).norm());
  }
  return worst;
}

double Machine::energy(const Eigen::Vector3d& gravity) const {
  const Simbody& s = *simbody_;
  double total = s.matter.calcKineticEnergy(s.state);
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    total -= s.spec.bodies[b].mass * gravity.dot(pose(static_cast<int>(b)).translation());
  return total;
}

Eigen::Isometry3d Machine::pose(int body) const {
  return to_eigen(simbody_->bodies[body].getBodyTransform(simbody_->state));
}
Eigen::Isometry3d Machine::part_pose(int part) const { return pose(part); }

Eigen::Vector3d Machine::point(int body, const Eigen::Vector3d& p_M) const {
  return pose(body) * simbody_->local(body, p_M);
}

Eigen::Vector3d Machine::point_velocity(int body, const Eigen::Vector3d& p_M) const {
  return to_eigen(simbody_->bodies[body].findStationVelocityInGround(simbody_->state,
                                                                     to_simbody(simbody_->local(body, p_M))));
}

void Machine::set_motor(int motor, double speed) {
  if (!(std::abs(speed) <= fastest_motor))
    throw std::invalid_argument("machine::Machine::set_motor: the speed of motor " + std::to_string(motor) +
                                " is " + std::to_string(speed) + " m/s or rad/s; allowed: at most " +
                                std::to_string(fastest_motor) + " either way");
  simbody_->motor_targets.at(motor) = speed;
}
double Machine::motor_force(int motor) const { return simbody_->motor_forces.at(motor); }

Eigen::MatrixXd Machine::transmission(const std::vector<int>& driven, const std::vector<int>& drivers,
                                      const std::vector<int>& held) const {
  const Simbody& s = *simbody_;
  SimTK::Matrix matrix;
  s.matter.calcG(s.state, matrix);
  std::vector<Eigen::Index> still, driving;
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    const bool base = s.spec.bodies[b].joint == JointKind::free;
    const bool hold = std::find(held.begin(), held.end(), static_cast<int>(b)) != held.end();
    for (int k = 0; (base || hold) && k < s.bodies[b].getNumU(s.state); ++k)
      still.push_back(s.speed_index(static_cast<int>(b)) + k);
  }
  for (int joint : drivers) driving.push_back(s.speed_index(joint));
  const Eigen::MatrixXd speeds = driven_speeds(to_eigen(matrix), still, driving);
  Eigen::MatrixXd factors(static_cast<Eigen::Index>(driven.size()), speeds.cols());
  for (std::size_t k = 0; k < driven.size(); ++k)
    factors.row(static_cast<Eigen::Index>(k)) = speeds.row(s.speed_index(driven[k]));
  return factors;
}

Wrench Machine::joint_wrench(int body) const { return simbody_->reactions[body]; }

Eigen::Vector3d Machine::loop_force(int loop) const { return simbody_->loop_forces.at(loop); }

void Machine::add_force(int body, const Wrench& wrench) {
  if (!wrench.moment.allFinite() || !wrench.force.allFinite())
    throw std::invalid_argument("machine::Machine::add_force: the wrench on body " + std::to_string(body) +
                                " is not finite; give finite N and N m");
  simbody_->extra.at(body).moment += wrench.moment;
  simbody_->extra.at(body).force += wrench.force;
}

const contact::SuperBody& Machine::linearise(double h, const Eigen::Vector3d& gravity) {
  Simbody& s = *simbody_;
  s.h = h;
  s.gravity = gravity;
  s.linearise_dynamics();
  const Eigen::VectorXd u = view(s.state.getU());
  s.super.velocity_before = s.N.transpose() * (s.M * u);
  s.super.velocity = s.super.velocity_before - h * (s.N.transpose() * view(s.bias));
  s.super.part_maps.resize(s.bodies.size());
  s.super.origins.resize(s.bodies.size());
  for (std::size_t b = 0; b < s.bodies.size(); ++b) {
    s.super.part_maps[b] = s.J.middleRows<6>(6 * s.bodies[b].getMobilizedBodyIndex()) * s.N;
    s.super.origins[b] = to_eigen(s.bodies[b].getBodyOriginLocation(s.state));
  }
  s.build_rows();
  return s.super;
}

void Machine::advance(const contact::SuperBodySolution& solution) {
  Simbody& s = *simbody_;
  const Eigen::VectorXd u = s.N * solution.velocity;
  if (!(u.norm() <= fastest_speed))
    throw std::runtime_error("machine::Machine::advance: the joint speeds come out with norm " +
                             std::to_string(u.norm()) + " m/s or rad/s; use a smaller step");
  s.recover_forces(solution, (u - view(s.state.getU())) / s.h);
  s.row_starts = solution.row_starts;
  std::fill(s.extra.begin(), s.extra.end(), Wrench());

  const SimTK::Vector q_before = s.state.getQ(), u_before = s.state.getU();
  SimTK::Vector qdot;
  s.matter.multiplyByN(s.state, false, to_simbody(Eigen::VectorXd(s.N * solution.mean_velocity)), qdot);
  s.state.updQ() += s.h * qdot;
  s.state.updU() = to_simbody(u);
  // Speeds are not projected here: the next w = NᵀMu is their mass-weighted projection, which keeps momentum.
  try {
    s.system.realize(s.state, SimTK::Stage::Position);
    s.system.projectQ(s.state, loop_tolerance);
    s.system.realize(s.state, SimTK::Stage::Velocity);
  } catch (const std::exception& error) {
    s.put_back(q_before, u_before);
    throw std::runtime_error(
        std::string("machine::Machine::advance: the loops cannot be closed after the step (") + error.what() +
        "); use a smaller step");
  }
}

std::vector<double> Machine::state() const {
  const Simbody& s = *simbody_;
  std::vector<double> out;
  const auto add = [&out](const auto& values) {
    out.insert(out.end(), values.data(), values.data() + values.size());
  };
  add(view(s.state.getQ()));
  add(view(s.state.getU()));
  add(s.motor_targets);
  add(s.motor_forces);
  add(s.row_starts);
  for (const std::vector<Wrench>* wrenches : {&s.extra, &s.reactions})
    for (const Wrench& w : *wrenches) add(w.moment), add(w.force);
  for (const Eigen::Vector3d& force : s.loop_forces) add(force);
  return out;
}

void Machine::set_state(const std::vector<double>& state) {
  Simbody& s = *simbody_;
  if (state.size() != this->state().size())
    throw std::runtime_error("machine::Machine::set_state: " + std::to_string(state.size()) +
                             " numbers; this machine has " + std::to_string(this->state().size()) +
                             "; give the state of the same machine");
  const double* next = state.data();
  const auto take = [&next](double* to, std::size_t count) {
    std::copy_n(next, count, to);
    next += count;
  };
  Eigen::VectorXd q(s.state.getNQ()), u(s.state.getNU());
  take(q.data(), static_cast<std::size_t>(q.size()));
  take(u.data(), static_cast<std::size_t>(u.size()));
  s.set_motion(q, u);
  for (std::vector<double>* values : {&s.motor_targets, &s.motor_forces, &s.row_starts})
    take(values->data(), values->size());
  for (std::vector<Wrench>* wrenches : {&s.extra, &s.reactions})
    for (Wrench& w : *wrenches) take(w.moment.data(), 3), take(w.force.data(), 3);
  for (Eigen::Vector3d& force : s.loop_forces) take(force.data(), 3);
}

}  // namespace drawpoint::engine::machine
