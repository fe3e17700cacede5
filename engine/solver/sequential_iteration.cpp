// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/base/cross_matrix.h>
#include <drawpoint/engine/solver/contact_frame.h>
#include <drawpoint/engine/solver/direct_solution.h>
#include <drawpoint/engine/solver/sequential_iteration.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace drawpoint::engine::detail {

using Eigen::Matrix3d;
using Eigen::Vector3d;

SequentialIteration::SequentialIteration(ContactProblem& problem, int substeps)
    : problem_(problem),
      substeps_(substeps),
      h_(problem.step / substeps),
      machine_(problem.machine, problem.step, substeps) {
  points_.reserve(problem.points.size());
  for (const ContactPair& pair : problem.pairs) add_pair(pair);
}

Matrix3d SequentialIteration::response(int index, const Vector3d& arm, const Matrix3d& frame) const {
  const SolverBody& body = problem_.bodies[index];
  const Matrix3d X = cross_matrix(arm);
  return frame * (body.inverse_mass * Matrix3d::Identity() - X * body.inverse_inertia * X) *
         frame.transpose();
}

void SequentialIteration::add_part_response(ContactBlock& block) const {
  for (const int rows : {block.rows_a, block.rows_b})
    if (rows >= 0) block.W += machine_.rows(rows) * machine_.rows(rows).transpose();
}

void SequentialIteration::add_pair(const ContactPair& pair) {
  assert(pair.first == static_cast<int>(points_.size()) && "blocks have the order of the problem's points");
  for (int k = pair.first; k < pair.first + pair.count; ++k) add_point(pair, problem_.points[k]);
  PairBlock r;
  r.a = pair.a;
  r.b = pair.b;
  r.first = pair.first;
  r.count = pair.count;
  r.rolling_arm = pair.rolling_arm;
  r.spinning_arm = pair.spinning_arm;
  r.frame = contact_frame(pair.count > 0 ? problem_.points[pair.first].normal : Vector3d::UnitX());
  r.W.setZero();
  r.rows_a = r.a < 0 ? machine_.add_angular_rows(part_of(r.a), r.frame) : -1;
  r.rows_b = r.b < 0 ? machine_.add_angular_rows(part_of(r.b), r.frame) : -1;
  for (const int index : {r.a, r.b})
    if (index >= 0) r.W += r.frame * problem_.bodies[index].inverse_inertia * r.frame.transpose();
  add_part_response(r);
  r.invert(0);
  r.impulse = r.frame * pair.start / substeps_;
  pairs_.push_back(r);
}

void SequentialIteration::add_point(const ContactPair& pair, const ContactPoint& point) {
  PointBlock p;
  p.a = pair.a;
  p.b = pair.b;
  p.arm_a = point.arm_a;
  p.arm_b = point.arm_b;
  p.frame = contact_frame(point.normal);
  p.terms = law::spook_terms(point, problem_.step, substeps_);
  p.gap = point.gap;
  p.friction = problem_.points[pair.first].friction;
  p.W.setZero();
  p.rows_a = p.a < 0 ? machine_.add_rows(part_of(p.a), p.arm_a, p.frame) : -1;
  p.rows_b = p.b < 0 ? machine_.add_rows(part_of(p.b), p.arm_b, p.frame) : -1;
  if (p.a >= 0) p.W += response(p.a, p.arm_a, p.frame);
  if (p.b >= 0) p.W += response(p.b, p.arm_b, p.frame);
  add_part_response(p);
  p.invert(p.terms.sigma);
  p.impulse = start_impulse(point, p.frame, p.friction, substeps_);
  p.initial_impulse = p.impulse[0];
  points_.push_back(p);
}

Vector3d SequentialIteration::velocity(const PointBlock& p) const {
  Vector3d u = Vector3d::Zero();
  if (p.a >= 0) {
    const SolverBody& body = problem_.bodies[p.a];
    u -= p.frame * (body.velocity + body.angular_velocity.cross(p.arm_a));
  } else {
    u -= machine_.velocity(p.rows_a);
  }
  if (p.b >= 0) {
    const SolverBody& body = problem_.bodies[p.b];
    u += p.frame * (body.velocity + body.angular_velocity.cross(p.arm_b));
  } else {
    u += machine_.velocity(p.rows_b);
  }
  return u;
}

Vector3d SequentialIteration::spin(const PairBlock& r) const {
  Vector3d u = Vector3d::Zero();
  u -= r.a >= 0 ? Vector3d(r.frame * problem_.bodies[r.a].angular_velocity) : machine_.velocity(r.rows_a);
  u += r.b >= 0 ? Vector3d(r.frame * problem_.bodies[r.b].angular_velocity) : machine_.velocity(r.rows_b);
  return u;
}

void SequentialIteration::apply(const PointBlock& p, const Vector3d& delta) {
  const Vector3d impulse = p.frame.transpose() * delta;
  if (p.a >= 0) {
    SolverBody& body = problem_.bodies[p.a];
    body.velocity -= body.inverse_mass * impulse;
    body.angular_velocity -= body.inverse_inertia * p.arm_a.cross(impulse);
  } else {
    machine_.push(p.rows_a, -delta);
  }
  if (p.b >= 0) {
    SolverBody& body = problem_.bodies[p.b];
    body.velocity += body.inverse_mass * impulse;
    body.angular_velocity += body.inverse_inertia * p.arm_b.cross(impulse);
  } else {
    machine_.push(p.rows_b, delta);
  }
}

void SequentialIteration::apply(const PairBlock& r, const Vector3d& delta) {
  if (r.a >= 0)
    problem_.bodies[r.a].angular_velocity -=
        problem_.bodies[r.a].inverse_inertia * (r.frame.transpose() * delta);
  else
    machine_.push(r.rows_a, -delta);
  if (r.b >= 0)
    problem_.bodies[r.b].angular_velocity +=
        problem_.bodies[r.b].inverse_inertia * (r.frame.transpose() * delta);
  else
    machine_.push(r.rows_b, delta);
}

// Load that has built up carries over to the next substep; an impact does not (law::kept_load).
void SequentialIteration::carry_over() {
  for (PairBlock& r : pairs_) {
    double force = 0, impacts = 0;
    for (int k = r.first; k < r.first + r.count; ++k) {
      PointBlock& p = points_[k];
      const Vector3d end = p.impulse;
      const double kept = law::kept_load(end[0], p.initial_impulse, p.inverse_nn);
      const double share = law::warm_start_fraction(end[0], kept);
      p.impulse = {kept, share * end[1], share * end[2]};
      p.correction = p.impulse - end;
      p.initial_impulse = kept;
      force += end[0];
      impacts += end[0] - kept;
    }
    r.correction = law::moment_change(impacts, force) * r.impulse;
    r.impulse += r.correction;
  }
}

void SequentialIteration::refresh() {
  if (!fresh_) carry_over();
  const double closing_rate = -1 / h_;
  for (PointBlock& p : points_) {
    const double approach = velocity(p)[0];
    if (!fresh_) p.gap += h_ * approach;
    p.target = law::bias_velocity(p.gap, approach, p.terms.upsilon, closing_rate);
  }
  fresh_ = false;
  machine_.set_bias_velocities();
}

void SequentialIteration::correct() {
  for (const PointBlock& p : points_) apply(p, p.correction);
  for (const PairBlock& r : pairs_) apply(r, r.correction);
}

void SequentialIteration::set_bias_velocities(const std::vector<double>& targets) {
  assert(targets.size() == points_.size() && "one bias velocity per point");
  for (std::size_t k = 0; k < points_.size(); ++k) points_[k].target = targets[k];
  fastest_ = std::numeric_limits<double>::infinity();
}

void SequentialIteration::start() {
  machine_.start();
  for (const PointBlock& p : points_) apply(p, p.impulse);
  for (const PairBlock& r : pairs_) apply(r, r.impulse);
}

void SequentialIteration::add_momentum(double share) {
  for (PointBlock& p : points_) p.add_momentum(share);
  for (PairBlock& r : pairs_) r.add_momentum(share);
  machine_.add_momentum(share);
}

double SequentialIteration::iteration() {
  change_ = 0;
  machine_.iteration();
  for (PairBlock& r : pairs_) {
    for (int k = r.first; k < r.first + r.count; ++k) solve_point(points_[k]);
    solve_pair(r);
  }
  return change_;
}

void SequentialIteration::solve_point(PointBlock& p) {
  const Vector3d u = velocity(p);
  const Vector3d before = p.impulse;
  p.impulse[0] = law::normal_step(before[0], u[0], p.terms.sigma, p.target, p.inverse_nn, fastest_);
  p.step_tangents(u, before[0], p.friction * p.impulse[0]);
  const Vector3d delta = p.impulse - before;
  const double moved = delta.lpNorm<1>();
  if (moved == 0) return;
  change_ += moved;
  apply(p, delta);
}

void SequentialIteration::solve_pair(PairBlock& r) {
  double load = 0;
  for (int k = r.first; k < r.first + r.count; ++k) load += points_[k].impulse[0];
  if (r.rolling_arm == 0 && r.spinning_arm == 0) return;
  const Vector3d u = spin(r);
  const Vector3d before = r.impulse;
  r.impulse[0] = law::spin_step(before[0], u[0], r.inverse_nn, r.spinning_arm * load);
  r.step_tangents(u, before[0], r.rolling_arm * load);
  apply(r, r.impulse - before);
}

void SequentialIteration::solve_directly() {
  assert(!problem_.machine && "machines have no direct solution");
  DirectSolution(problem_.bodies, points_, pairs_, fastest_).solve();
}

void SequentialIteration::finish() {
  machine_.finish();
  for (PointBlock& p : points_) p.total += p.impulse;
  for (PairBlock& r : pairs_) r.total += r.impulse;
}

void SequentialIteration::repeat(int substeps) {
  machine_.repeat(substeps);
  for (PointBlock& p : points_) p.total += substeps * p.impulse;
  for (PairBlock& r : pairs_) r.total += substeps * r.impulse;
}

double SequentialIteration::normal_load() const {
  double sum = 0;
  for (const PointBlock& p : points_) sum += p.impulse[0];
  return sum;
}

ResidualSums SequentialIteration::residual_sums() const {
  ResidualSums sum;
  for (const PointBlock& p : points_) {
    const Vector3d u = velocity(p);
    const double normal = p.impulse[0];
    const double next = law::normal_step(normal, u[0], p.terms.sigma, p.target, p.inverse_nn, fastest_);
    sum.normal += std::abs(normal - next);
    sum.load += std::max(normal, next);
    sum.tangent +=
        law::tangent_residual(p.impulse[1], p.impulse[2], u[1], u[2], p.inverse_tt.rho, p.friction * normal);
  }
  return sum;
}

SuperBodySolution SequentialIteration::store() {
  assert(points_.size() == problem_.points.size() && pairs_.size() == problem_.pairs.size() &&
         "a block for each point and pair of the problem");
  SuperBodySolution solution = machine_.store();
  const auto add = [&](int part, double sign, const Vector3d& arm, const Vector3d& impulse,
                       const Vector3d& moment) {
    solution.part_impulses[part].head<3>() += sign * (arm.cross(impulse) + moment);
    solution.part_impulses[part].tail<3>() += sign * impulse;
  };
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const PointBlock& p = points_[k];
    const Vector3d impulse = p.frame.transpose() * p.total;
    problem_.points[k].impulse = impulse;
    problem_.points[k].start = substeps_ * (p.frame.transpose() * p.impulse);
    problem_.points[k].warm_start_fraction =
        law::warm_start_fraction(p.impulse[0], law::kept_load(p.impulse[0], p.initial_impulse, p.inverse_nn));
    if (p.a < 0) add(part_of(p.a), -1, p.arm_a, impulse, Vector3d::Zero());
    if (p.b < 0) add(part_of(p.b), +1, p.arm_b, impulse, Vector3d::Zero());
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const PairBlock& r = pairs_[k];
    const Vector3d moment = r.frame.transpose() * r.total;
    problem_.pairs[k].impulse = moment;
    problem_.pairs[k].start = substeps_ * (r.frame.transpose() * r.impulse);
    if (r.a < 0) add(part_of(r.a), -1, Vector3d::Zero(), Vector3d::Zero(), moment);
    if (r.b < 0) add(part_of(r.b), +1, Vector3d::Zero(), Vector3d::Zero(), moment);
  }
  return solution;
}

}  // namespace drawpoint::engine::detail
