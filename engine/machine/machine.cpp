// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/reactions.h>

#include <drawpoint/engine/machine/constrained_response.h>
#include <drawpoint/engine/machine/free_motion.h>
#include <drawpoint/engine/machine/machine_rows.h>
#include <algorithm>
#include <drawpoint/engine/base/checks.hpp>
#include <drawpoint/engine/machine/machine.hpp>
#include <stdexcept>
#include <utility>

namespace drawpoint::engine::machine {
namespace {

constexpr double fastest_motor = 1e3;        // [m/s] or [rad/s]
constexpr double farthest_coordinate = 1e4;  // [rad] or [m]

std::vector<double> most_forces(const MachineSpec& spec) {
  std::vector<double> forces;
  for (const MotorSpec& motor : spec.motors)
    forces.push_back(std::max(motor.max_force, motor.max_reverse_force));
  return forces;
}

}  // namespace

struct Machine::Simbody {
  SimbodyTree tree;
  std::vector<double> motor_targets, motor_limits, motor_forces, row_starts;
  std::vector<Wrench> extra;  // by add_force, for the next step
  Eigen::VectorXd reaction;   // generalised force of contacts, motors and stops in the last step
  Reactions reactions;        // of the last step

  // The linearisation of the present step.
  double h = 0;
  Eigen::Vector3d gravity;
  TreeDynamics dynamics;
  Eigen::MatrixXd J;  // 6 (bodies + 1) x n, ground first
  TreeMotion flow;    // over the step, if what contacts, motors and stops do stays as it was in the last
  Eigen::VectorXd flow_change;  // of w
  engine::SuperBody super;

  explicit Simbody(const MachineSpec& spec)
      : tree(spec),
        motor_targets(spec.motors.size()),
        motor_limits(most_forces(spec)),
        motor_forces(spec.motors.size()),
        row_starts(spec.motors.size() + 2 * spec.stops.size()),
        extra(spec.bodies.size()),
        reaction(Eigen::VectorXd::Zero(tree.state.getNU())),
        reactions{std::vector<Wrench>(spec.bodies.size()),
                  std::vector<Eigen::Vector3d>(spec.loops.size(), Eigen::Vector3d::Zero())} {}

  std::array<StopSide, 2> ends_now(const StopSpec& stop) const;
  Eigen::RowVectorXd joint_sum(const std::vector<int>& bodies) const;
  void linearise_dynamics();
  void build_rows();
  BodyForces loads(const std::vector<engine::SpatialVector>* part_impulses) const;
  SimTK::Vector row_forces(const std::vector<double>& row_impulses) const;
  Eigen::VectorXd lasting(const Eigen::VectorXd& force) const;
  Eigen::VectorXd beside_flow(const engine::SuperBodySolution& solution) const;
};

void Machine::Simbody::linearise_dynamics() {
  const BodyForces outer = loads(nullptr);
  dynamics.linearise(tree, tree.state, outer);
  SimTK::Matrix matrix;
  tree.matter.calcSystemJacobian(tree.state, matrix);
  J = to_eigen(matrix);
  flow = free_motion(tree, dynamics, outer, reaction, h);
}

// Gravity and added forces on every body, with the contact impulses over the step when they are known.
BodyForces Machine::Simbody::loads(const std::vector<engine::SpatialVector>* part_impulses) const {
  BodyForces forces(tree.matter.getNumBodies(), SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0)));
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    Wrench total = extra[b];
    total.force += tree.spec.bodies[b].mass * gravity;
    if (part_impulses) {
      total.moment += (*part_impulses)[b].head<3>() / h;
      total.force += (*part_impulses)[b].tail<3>() / h;
    }
    forces[tree.bodies[b].getMobilizedBodyIndex()] += to_simbody(total);
  }
  return forces;
}

std::array<StopSide, 2> Machine::Simbody::ends_now(const StopSpec& stop) const {
  double sum = 0;
  for (int body : stop.bodies) sum += tree.coordinate(body);
  return ends_of(stop, sum / static_cast<double>(stop.bodies.size()));
}

// What turns w into the sum of the joints' speeds.
Eigen::RowVectorXd Machine::Simbody::joint_sum(const std::vector<int>& bodies) const {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(dynamics.N.cols());
  for (int body : bodies) sum += dynamics.N.row(tree.speed_index(body));
  return sum;
}

void Machine::Simbody::build_rows() {
  const MachineSpec& spec = tree.spec;
  super.rows.clear();
  const std::size_t n_motors = spec.motors.size();
  for (std::size_t m = 0; m < n_motors; ++m) {
    const std::vector<int>& bodies = spec.motors[m].bodies;
    const MotorSetting setting{static_cast<double>(bodies.size()) * motor_targets[m],
                               std::min(spec.motors[m].max_force, motor_limits[m]),
                               std::min(spec.motors[m].max_reverse_force, motor_limits[m])};
    super.rows.push_back(motor_row(setting, joint_sum(bodies), h, row_starts[m]));
  }
  for (const StopSpec& stop : spec.stops)
    for (const StopSide& end : ends_now(stop))
      super.rows.push_back(stop_row(stop, end, joint_sum(stop.bodies), h, row_starts[super.rows.size()]));
}

// What of a generalised force may be expected to go on: not an impact, which outer forces do not match.
Eigen::VectorXd Machine::Simbody::lasting(const Eigen::VectorXd& force) const {
  const double own = (dynamics.N.transpose() * force).norm(),
               outer = (dynamics.N.transpose() * dynamics.bias).norm();
  return std::min(1.0, own > 0 ? 2 * outer / own : 1.0) * force;
}

// The mean of w beyond that of the flow. Substeps change w at their beginnings, which moves farther than a
// steady change does: where the impulses are those that the flow knew, that is taken off; else gaps are to be
// closed just as the solver closed them.
Eigen::VectorXd Machine::Simbody::beside_flow(const engine::SuperBodySolution& solution) const {
  const double change = flow_change.norm(),
               unknown = (solution.velocity - super.velocity_before - flow_change).norm();
  const double as_known = change > 0 ? std::max(0.0, 1 - unknown / change) : 0.0;
  const double share = 0.5 + as_known * (solution.steady_share - 0.5);
  return solution.mean_velocity - super.velocity_before - share * flow_change;
}

// Generalised forces of motors and stops on the joints, means over the step.
SimTK::Vector Machine::Simbody::row_forces(const std::vector<double>& row_impulses) const {
  const MachineSpec& spec = tree.spec;
  const std::size_t n_motors = spec.motors.size();
  SimTK::Vector forces(tree.state.getNU(), 0.0);
  for (std::size_t m = 0; m < n_motors; ++m)
    for (int body : spec.motors[m].bodies)
      forces[static_cast<int>(tree.speed_index(body))] += row_impulses[m] / h;
  std::size_t row = n_motors;
  for (const StopSpec& stop : spec.stops)
    for (const StopSide& end : ends_now(stop)) {
      for (int body : stop.bodies)
        forces[static_cast<int>(tree.speed_index(body))] += end.sign * row_impulses[row] / h;
      ++row;
    }
  return forces;
}

Machine::Machine(const MachineSpec& spec) {
  check(spec);
  simbody_ = std::make_unique<Simbody>(spec);
}
Machine::~Machine() = default;

const MachineSpec& Machine::spec() const { return simbody_->tree.spec; }
int Machine::parts() const { return static_cast<int>(simbody_->tree.bodies.size()); }

void Machine::place(const Eigen::Isometry3d& X_WM) {
  std::fill(simbody_->row_starts.begin(), simbody_->row_starts.end(), 0.0);
  simbody_->reaction.setZero();
  simbody_->tree.place(X_WM);
}

void Machine::set_coordinate(int body, double value) {
  check_joint(spec(), body, "machine::Machine::set_coordinate");
  engine::detail::require(
      "machine::Machine::set_coordinate: the coordinate of \"" + spec().bodies[body].name + "\"", value,
      {-farthest_coordinate, farthest_coordinate, "rad or m"});
  simbody_->tree.set_coordinate(body, value);
}

void Machine::translate(const Eigen::Vector3d& by) {
  if (!by.allFinite() || by.norm() > farthest_coordinate)
    throw std::invalid_argument("machine::Machine::translate: the way is " + std::to_string(by.norm()) +
                                " m; allowed: up to " + std::to_string(farthest_coordinate) + " m");
  simbody_->tree.translate(by);
}

void Machine::set_velocity(const Eigen::Vector3d& velocity,
                           const std::vector<std::pair<int, double>>& joint_speeds) {
  const auto require_speed = [](double speed) {
    if (!(std::abs(speed) <= fastest_motor))
      throw std::invalid_argument("machine::Machine::set_velocity: a speed is " + std::to_string(speed) +
                                  " m/s or rad/s; allowed: at most " + std::to_string(fastest_motor) +
                                  " either way");
  };
  require_speed(velocity.norm());
  for (const auto& [body, speed] : joint_speeds) {
    check_joint(spec(), body, "machine::Machine::set_velocity");
    require_speed(speed);
  }
  simbody_->tree.set_velocity(velocity, joint_speeds);
}

double Machine::coordinate(int body) const { return simbody_->tree.coordinate(body); }
double Machine::speed(int body) const { return simbody_->tree.bodies[body].getOneU(simbody_->tree.state, 0); }

double Machine::loop_error() const {
  const Simbody& s = *simbody_;
  double worst = 0;
  for (const LoopPinSpec& loop : s.tree.spec.loops) {
    const Eigen::Vector3d gap = point(loop.point_body, loop.point) - point(loop.line_body, loop.point);
    const Eigen::Vector3d axis = pose(loop.line_body).linear() * loop.axis;
    worst = std::max(worst, (gap - axis * axis.dot(gap)).norm());
  }
  return worst;
}

double Machine::energy(const Eigen::Vector3d& gravity) const {
  const Simbody& s = *simbody_;
  double total = s.tree.matter.calcKineticEnergy(s.tree.state);
  for (std::size_t b = 0; b < s.tree.bodies.size(); ++b)
    total -= s.tree.spec.bodies[b].mass * gravity.dot(pose(static_cast<int>(b)).translation());
  return total;
}

Eigen::Isometry3d Machine::pose(int body) const {
  return to_eigen(simbody_->tree.bodies[body].getBodyTransform(simbody_->tree.state));
}
Eigen::Isometry3d Machine::part_pose(int part) const { return pose(part); }

Eigen::Vector3d Machine::point(int body, const Eigen::Vector3d& p_M) const {
  return pose(body) * (p_M - spec().bodies[body].centre);
}

Eigen::Vector3d Machine::point_velocity(int body, const Eigen::Vector3d& p_M) const {
  const SimbodyTree& tree = simbody_->tree;
  return to_eigen(tree.bodies[body].findStationVelocityInGround(tree.state, tree.station(body, p_M)));
}

void Machine::set_motor(int motor, double speed) {
  if (!(std::abs(speed) <= fastest_motor))
    throw std::invalid_argument("machine::Machine::set_motor: the speed of motor " + std::to_string(motor) +
                                " is " + std::to_string(speed) + " m/s or rad/s; allowed: at most " +
                                std::to_string(fastest_motor) + " either way");
  simbody_->motor_targets.at(motor) = speed;
}

void Machine::limit_motor(int motor, double force) {
  const MotorSpec& of = spec().motors.at(motor);
  const double most = std::max(of.max_force, of.max_reverse_force);
  if (!(force >= 0 && force <= most))
    throw std::invalid_argument("machine::Machine::limit_motor: the limit of motor " + std::to_string(motor) +
                                " is " + std::to_string(force) + " N or N m; allowed: 0 to " +
                                std::to_string(most) + ", what its specification says");
  simbody_->motor_limits[motor] = force;
}

double Machine::motor_force(int motor) const { return simbody_->motor_forces.at(motor); }

Eigen::MatrixXd Machine::transmission(const std::vector<int>& driven, const std::vector<int>& drivers,
                                      const std::vector<int>& held) const {
  const Simbody& s = *simbody_;
  SimTK::Matrix matrix;
  s.tree.matter.calcG(s.tree.state, matrix);
  std::vector<Eigen::Index> still, driving;
  for (std::size_t b = 0; b < s.tree.bodies.size(); ++b) {
    const bool base = s.tree.spec.bodies[b].joint == JointKind::free;
    const bool hold = std::find(held.begin(), held.end(), static_cast<int>(b)) != held.end();
    for (int k = 0; (base || hold) && k < s.tree.bodies[b].getNumU(s.tree.state); ++k)
      still.push_back(s.tree.speed_index(static_cast<int>(b)) + k);
  }
  for (int joint : drivers) driving.push_back(s.tree.speed_index(joint));
  const Eigen::MatrixXd speeds = driven_speeds(to_eigen(matrix), still, driving);
  Eigen::MatrixXd factors(static_cast<Eigen::Index>(driven.size()), speeds.cols());
  for (std::size_t k = 0; k < driven.size(); ++k)
    factors.row(static_cast<Eigen::Index>(k)) = speeds.row(s.tree.speed_index(driven[k]));
  return factors;
}

Wrench Machine::joint_wrench(int body) const { return simbody_->reactions.joints[body]; }

Eigen::Vector3d Machine::loop_force(int loop) const { return simbody_->reactions.loops.at(loop); }

void Machine::add_force(int body, const Wrench& wrench) {
  if (!wrench.moment.allFinite() || !wrench.force.allFinite())
    throw std::invalid_argument("machine::Machine::add_force: the wrench on body " + std::to_string(body) +
                                " is not finite; give finite N and N m");
  simbody_->extra.at(body).moment += wrench.moment;
  simbody_->extra.at(body).force += wrench.force;
}

const engine::SuperBody& Machine::linearise(double h, const Eigen::Vector3d& gravity) {
  Simbody& s = *simbody_;
  s.h = h;
  s.gravity = gravity;
  s.linearise_dynamics();
  const Eigen::VectorXd u = view(s.tree.state.getU());
  const Eigen::MatrixXd &M = s.dynamics.M, &N = s.dynamics.N;
  s.super.velocity_before = N.transpose() * (M * u);
  s.flow_change = N.transpose() * (M * (s.flow.u - u));
  s.super.velocity = s.super.velocity_before + s.flow_change - h * (N.transpose() * s.reaction);
  s.super.part_maps.resize(s.tree.bodies.size());
  s.super.origins.resize(s.tree.bodies.size());
  for (std::size_t b = 0; b < s.tree.bodies.size(); ++b) {
    s.super.part_maps[b] = s.J.middleRows<6>(6 * s.tree.bodies[b].getMobilizedBodyIndex()) * N;
    s.super.origins[b] = to_eigen(s.tree.bodies[b].getBodyOriginLocation(s.tree.state));
  }
  s.build_rows();
  return s.super;
}

void Machine::advance(const engine::SuperBodySolution& solution) {
  Simbody& s = *simbody_;
  const Eigen::MatrixXd& N = s.dynamics.N;
  const Eigen::VectorXd u = N * solution.velocity;
  if (!(u.norm() <= SimbodyTree::fastest))
    throw std::runtime_error("machine::Machine::advance: the joint speeds come out with norm " +
                             std::to_string(u.norm()) + " m/s or rad/s; use a smaller step");
  // At the pose before the step, but kept only once the step has been made.
  const AppliedForces applied{s.row_forces(solution.row_impulses), s.loads(&solution.part_impulses)};
  const Eigen::VectorXd reaction =
      s.dynamics.bias - TreeDynamics::bias_under(s.tree, s.tree.state, applied.joints, applied.bodies);
  Reactions felt = reactions(s.tree, s.dynamics.G, applied, s.dynamics.acceleration(reaction));
  s.tree.move(u, s.flow.q, s.h * (N * s.beside_flow(solution)));
  s.reaction = s.lasting(reaction);
  s.reactions = std::move(felt);
  for (std::size_t m = 0; m < s.motor_forces.size(); ++m) s.motor_forces[m] = solution.row_impulses[m] / s.h;
  s.row_starts = solution.row_starts;
  std::fill(s.extra.begin(), s.extra.end(), Wrench());
}

std::vector<double> Machine::state() const {
  const Simbody& s = *simbody_;
  std::vector<double> out;
  const auto add = [&out](const auto& values) {
    out.insert(out.end(), values.data(), values.data() + values.size());
  };
  add(view(s.tree.state.getQ()));
  add(view(s.tree.state.getU()));
  add(s.motor_targets);
  add(s.motor_limits);
  add(s.motor_forces);
  add(s.row_starts);
  add(s.reaction);
  for (const std::vector<Wrench>* wrenches : {&s.extra, &s.reactions.joints})
    for (const Wrench& w : *wrenches) add(w.moment), add(w.force);
  for (const Eigen::Vector3d& force : s.reactions.loops) add(force);
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
  Eigen::VectorXd q(s.tree.state.getNQ()), u(s.tree.state.getNU());
  take(q.data(), static_cast<std::size_t>(q.size()));
  take(u.data(), static_cast<std::size_t>(u.size()));
  s.tree.set_motion(q, u);
  for (std::vector<double>* values : {&s.motor_targets, &s.motor_limits, &s.motor_forces, &s.row_starts})
    take(values->data(), values->size());
  take(s.reaction.data(), static_cast<std::size_t>(s.reaction.size()));
  for (std::vector<Wrench>* wrenches : {&s.extra, &s.reactions.joints})
    for (Wrench& w : *wrenches) take(w.moment.data(), 3), take(w.force.data(), 3);
  for (Eigen::Vector3d& force : s.reactions.loops) take(force.data(), 3);
}

}  // namespace drawpoint::engine::machine
