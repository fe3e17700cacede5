// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/contact/contact_frame.hpp>
#include <drawpoint/engine/contact/sequential_sweeper.hpp>

namespace drawpoint::engine::contact::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Largest eigenvalue of a symmetric 2 x 2 matrix.
double largest_eigenvalue(double a, double b, double d) {
  return 0.5 * (a + d) + std::hypot(0.5 * (a - d), b);
}

// Below this, relative to the largest eigenvalue's power, a block counts as singular.
constexpr double singular = 1e-12;

double inverse_or_zero(double x) { return x > 0 ? 1.0 / x : 0.0; }

// Exact inverse of the tangents' block, or the scalar step where a part with few freedoms does not answer in
// some direction.
void invert(ContactBlock& block, double sigma) {
  block.inverse_nn = inverse_or_zero(block.W(0, 0) + sigma);
  const double a = block.W(1, 1), b = block.W(1, 2), d = block.W(2, 2), rho = largest_eigenvalue(a, b, d);
  block.inverse_rho = inverse_or_zero(rho);
  const double det = a * d - b * b;
  const bool regular = det > singular * rho * rho;
  block.inverse_tt[0] = regular ? d / det : block.inverse_rho;
  block.inverse_tt[1] = regular ? -b / det : 0;
  block.inverse_tt[2] = regular ? a / det : block.inverse_rho;
}

// The tangential part of the impulse after its step against the velocity (u1, u2): sticking where the cone of
// radius `limit` allows it, else a scalar step projected on it.
void project_tangents(ContactBlock& block, double u1, double u2, double limit) {
  Vector3d& impulse = block.impulse;
  double t1 = impulse[1] - (block.inverse_tt[0] * u1 + block.inverse_tt[1] * u2);
  double t2 = impulse[2] - (block.inverse_tt[1] * u1 + block.inverse_tt[2] * u2);
  if (t1 * t1 + t2 * t2 > limit * limit) {
    t1 = impulse[1] - block.inverse_rho * u1;
    t2 = impulse[2] - block.inverse_rho * u2;
    const double length = std::sqrt(t1 * t1 + t2 * t2);
    if (length > limit) {
      t1 *= limit / length;
      t2 *= limit / length;
    }
  }
  impulse[1] = t1;
  impulse[2] = t2;
}

}  // namespace

SequentialSweeper::SequentialSweeper(ContactProblem& problem, int substeps)
    : problem_(problem), substeps_(substeps), h_(problem.step / substeps) {
  if (problem.machine) prepare_machine(*problem.machine);
  points_.reserve(problem.points.size());
  for (const ContactPair& pair : problem.pairs) add_pair(pair);
}

// Rows of a machine part at a point: velocity of the point = rows · w, in the given axes.
int SequentialSweeper::add_rows(int part, const Vector3d& arm, const Matrix3d& axes) {
  const SpatialMap& map = problem_.machine->part_maps[part];
  part_rows_.push_back(axes * (map.bottomRows<3>() - cross_matrix(arm) * map.topRows<3>()));
  return static_cast<int>(part_rows_.size()) - 1;
}

int SequentialSweeper::add_angular_rows(int part, const Matrix3d& axes) {
  part_rows_.push_back(axes * problem_.machine->part_maps[part].topRows<3>());
  return static_cast<int>(part_rows_.size()) - 1;
}

Matrix3d SequentialSweeper::response(int index, const Vector3d& arm, const Matrix3d& frame) const {
  const SolverBody& body = problem_.bodies[index];
  const Matrix3d X = cross_matrix(arm);
  return frame * (body.inverse_mass * Matrix3d::Identity() - X * body.inverse_inertia * X) *
         frame.transpose();
}

void SequentialSweeper::prepare_machine(const SuperBody& machine) {
  w_ = w_begin_ = machine.velocity_before;
  w_push_ = (machine.velocity - machine.velocity_before) / substeps_;
  w_travel_ = Eigen::VectorXd::Zero(w_.size());
  for (const SuperBodyRow& row : machine.rows) {
    inverse_rows_.push_back(inverse_or_zero(row.jacobian.squaredNorm()));
    row_impulses_.push_back(std::clamp(row.start, row.lower, row.upper) / substeps_);
  }
  row_totals_.assign(machine.rows.size(), 0.0);
  row_targets_.assign(machine.rows.size(), 0.0);
}

void SequentialSweeper::add_part_response(ContactBlock& block) const {
  for (const int rows : {block.rows_a, block.rows_b})
    if (rows >= 0) block.W += part_rows_[rows] * part_rows_[rows].transpose();
}

void SequentialSweeper::add_pair(const ContactPair& pair) {
  for (int k = pair.first; k < pair.first + pair.count; ++k) add_point(pair, problem_.points[k]);
  PairBlock r;
  r.a = pair.a;
  r.b = pair.b;
  r.first = pair.first;
  r.count = pair.count;
  r.rolling_arm = pair.rolling_arm;
  r.spinning_arm = pair.spinning_arm;
  r.frame = contact_frame(problem_.points[pair.first].normal);
  r.W.setZero();
  r.rows_a = r.a < 0 ? add_angular_rows(part_of(r.a), r.frame) : -1;
  r.rows_b = r.b < 0 ? add_angular_rows(part_of(r.b), r.frame) : -1;
  for (const int index : {r.a, r.b})
    if (index >= 0) r.W += r.frame * problem_.bodies[index].inverse_inertia * r.frame.transpose();
  add_part_response(r);
  invert(r, 0);
  r.impulse = r.frame * pair.start / substeps_;
  pairs_.push_back(r);
}

void SequentialSweeper::add_point(const ContactPair& pair, const ContactPoint& point) {
  PointBlock p;
  p.a = pair.a;
  p.b = pair.b;
  p.arm_a = point.arm_a;
  p.arm_b = point.arm_b;
  p.frame = contact_frame(point.normal);
  p.law = spook(point.stiffness, std::max(point.damping_time, 2 * problem_.step), h_);
  p.gap = point.gap;
  p.friction = point.friction;
  p.W.setZero();
  p.rows_a = p.a < 0 ? add_rows(part_of(p.a), p.arm_a, p.frame) : -1;
  p.rows_b = p.b < 0 ? add_rows(part_of(p.b), p.arm_b, p.frame) : -1;
  if (p.a >= 0) p.W += response(p.a, p.arm_a, p.frame);
  if (p.b >= 0) p.W += response(p.b, p.arm_b, p.frame);
  add_part_response(p);
  invert(p, p.law.sigma);
  p.impulse = start_impulse(point, p.frame, substeps_);
  p.begun = p.impulse[0];
  points_.push_back(p);
}

Vector3d SequentialSweeper::velocity(const PointBlock& p) const {
  Vector3d u = Vector3d::Zero();
  if (p.a >= 0) {
    const SolverBody& body = problem_.bodies[p.a];
    u -= p.frame * (body.velocity + body.angular_velocity.cross(p.arm_a));
  } else {
    u.noalias() -= part_rows_[p.rows_a] * w_;
  }
  if (p.b >= 0) {
    const SolverBody& body = problem_.bodies[p.b];
    u += p.frame * (body.velocity + body.angular_velocity.cross(p.arm_b));
  } else {
    u.noalias() += part_rows_[p.rows_b] * w_;
  }
  return u;
}

Vector3d SequentialSweeper::spin(const PairBlock& r) const {
  Vector3d u = Vector3d::Zero();
  u -= r.a >= 0 ? Vector3d(r.frame * problem_.bodies[r.a].angular_velocity)
                : Vector3d(part_rows_[r.rows_a] * w_);
  u += r.b >= 0 ? Vector3d(r.frame * problem_.bodies[r.b].angular_velocity)
                : Vector3d(part_rows_[r.rows_b] * w_);
  return u;
}

void SequentialSweeper::apply(const PointBlock& p, const Vector3d& delta) {
  const Vector3d impulse = p.frame.transpose() * delta;
  if (p.a >= 0) {
    SolverBody& body = problem_.bodies[p.a];
    body.velocity -= body.inverse_mass * impulse;
    body.angular_velocity -= body.inverse_inertia * p.arm_a.cross(impulse);
  } else {
    w_.noalias() -= part_rows_[p.rows_a].transpose() * delta;
  }
  if (p.b >= 0) {
    SolverBody& body = problem_.bodies[p.b];
    body.velocity += body.inverse_mass * impulse;
    body.angular_velocity += body.inverse_inertia * p.arm_b.cross(impulse);
  } else {
    w_.noalias() += part_rows_[p.rows_b].transpose() * delta;
  }
}

void SequentialSweeper::apply(const PairBlock& r, const Vector3d& delta) {
  if (r.a >= 0)
    problem_.bodies[r.a].angular_velocity -=
        problem_.bodies[r.a].inverse_inertia * (r.frame.transpose() * delta);
  else
    w_.noalias() -= part_rows_[r.rows_a].transpose() * delta;
  if (r.b >= 0)
    problem_.bodies[r.b].angular_velocity +=
        problem_.bodies[r.b].inverse_inertia * (r.frame.transpose() * delta);
  else
    w_.noalias() += part_rows_[r.rows_b].transpose() * delta;
}

double SequentialSweeper::row_target(const SuperBodyRow& row) const {
  if (row.kind == SuperBodyRow::Kind::motor) return row.target;
  const double gap = row.gap + row.jacobian.dot(w_travel_);
  return gap >= 0 ? -gap / h_ : -gap / row.recovery;
}

// Load that has built up carries over to the next substep; a blow does not (contact_law.hpp).
void SequentialSweeper::carry_over() {
  for (PairBlock& r : pairs_) {
    double force = 0, kept = 0;
    for (int k = r.first; k < r.first + r.count; ++k) {
      PointBlock& p = points_[k];
      const double share = carried_share(p.impulse[0], p.begun, p.inverse_nn);
      p.correction = (share - 1) * p.impulse;
      force += p.impulse[0];
      p.impulse += p.correction;
      p.begun = p.impulse[0];
      kept += p.impulse[0];
    }
    r.correction = force > kept ? Vector3d((kept / force - 1) * r.impulse) : Vector3d::Zero().eval();
    r.impulse += r.correction;
  }
}

void SequentialSweeper::refresh() {
  if (!fresh_) carry_over();
  for (PointBlock& p : points_) {
    const double approach = velocity(p)[0];
    if (!fresh_) p.gap += h_ * approach;
    p.target = spook_target(p.gap, approach, p.law.upsilon, h_);
  }
  fresh_ = false;
  for (std::size_t k = 0; k < row_targets_.size(); ++k)
    row_targets_[k] = row_target(problem_.machine->rows[k]);
}

void SequentialSweeper::correct() {
  for (const PointBlock& p : points_) apply(p, p.correction);
  for (const PairBlock& r : pairs_) apply(r, r.correction);
}

void SequentialSweeper::aim(const std::vector<double>& targets) {
  for (std::size_t k = 0; k < points_.size(); ++k) points_[k].target = targets[k];
}

void SequentialSweeper::start() {
  if (problem_.machine) w_ += w_push_;
  for (std::size_t k = 0; k < row_impulses_.size(); ++k)
    w_ += problem_.machine->rows[k].jacobian * row_impulses_[k];
  for (const PointBlock& p : points_) apply(p, p.impulse);
  for (const PairBlock& r : pairs_) apply(r, r.impulse);
}

void SequentialSweeper::extrapolate() {
  const Eigen::VectorXd next = 2 * w_ - w_begin_;
  w_begin_ = w_;
  w_ = next;
}

double SequentialSweeper::sweep(bool forward) {
  change_ = 0;
  solve_machine_rows();
  const int n = static_cast<int>(pairs_.size());
  for (int k = 0; k < n; ++k) {
    PairBlock& r = pairs_[forward ? k : n - 1 - k];
    for (int i = 0; i < r.count; ++i) solve_point(points_[r.first + (forward ? i : r.count - 1 - i)]);
    solve_pair(r);
  }
  return change_;
}

void SequentialSweeper::solve_machine_rows() {
  if (!problem_.machine) return;
  for (std::size_t k = 0; k < problem_.machine->rows.size(); ++k) {
    const SuperBodyRow& row = problem_.machine->rows[k];
    const double rest = row.jacobian.dot(w_) - row_targets_[k];
    const double next =
        std::clamp(row_impulses_[k] - inverse_rows_[k] * rest, row.lower / substeps_, row.upper / substeps_);
    const double delta = next - row_impulses_[k];
    if (delta == 0) continue;
    row_impulses_[k] = next;
    w_.noalias() += row.jacobian * delta;
  }
}

void SequentialSweeper::solve_point(PointBlock& p) {
  const Vector3d u = velocity(p);
  const Vector3d before = p.impulse;
  p.impulse[0] = std::max(0.0, before[0] - p.inverse_nn * (u[0] + p.law.sigma * before[0] - p.target));
  const double dn = p.impulse[0] - before[0];
  project_tangents(p, u[1] + p.W(1, 0) * dn, u[2] + p.W(2, 0) * dn, p.friction * p.impulse[0]);
  const Vector3d delta = p.impulse - before;
  const double moved = delta.lpNorm<1>();
  if (moved == 0) return;
  change_ += moved;
  apply(p, delta);
}

void SequentialSweeper::solve_pair(PairBlock& r) {
  double load = 0;
  for (int k = r.first; k < r.first + r.count; ++k) load += points_[k].impulse[0];
  if (r.rolling_arm == 0 && r.spinning_arm == 0) return;
  const Vector3d u = spin(r);
  const Vector3d before = r.impulse;
  const double limit = r.spinning_arm * load;
  r.impulse[0] = std::clamp(before[0] - r.inverse_nn * u[0], -limit, limit);
  const double dn = r.impulse[0] - before[0];
  project_tangents(r, u[1] + r.W(1, 0) * dn, u[2] + r.W(2, 0) * dn, r.rolling_arm * load);
  apply(r, r.impulse - before);
}

void SequentialSweeper::finish() {
  if (problem_.machine) w_travel_ += h_ * w_;
  for (std::size_t k = 0; k < row_totals_.size(); ++k) row_totals_[k] += row_impulses_[k];
  for (PointBlock& p : points_) p.total += p.impulse;
  for (PairBlock& r : pairs_) r.total += r.impulse;
}

double SequentialSweeper::normal_load() const {
  double sum = 0;
  for (const PointBlock& p : points_) sum += p.impulse[0];
  return sum;
}

Misfit SequentialSweeper::misfit() const {
  Misfit sum;
  for (const PointBlock& p : points_) {
    const Vector3d u = velocity(p);
    const double normal = p.impulse[0], rest = u[0] + p.law.sigma * normal - p.target;
    const double next = std::max(0.0, normal - p.inverse_nn * rest);
    sum.normal += std::abs(normal - next);
    sum.load += std::max(normal, next);
    Eigen::Vector2d stepped = p.impulse.tail<2>() - p.inverse_rho * u.tail<2>();
    const double length = stepped.norm(), limit = p.friction * normal;
    if (length > limit) stepped *= limit / length;
    sum.tangent += (p.impulse.tail<2>() - stepped).norm();
  }
  return sum;
}

SuperBodySolution SequentialSweeper::store() {
  SuperBodySolution solution;
  if (problem_.machine) {
    solution.velocity = w_;
    solution.mean_velocity = w_travel_ / problem_.step;
    solution.row_impulses = row_totals_;
    for (const double impulse : row_impulses_) solution.row_starts.push_back(substeps_ * impulse);
    solution.part_impulses.assign(problem_.machine->part_maps.size(), SpatialVector::Zero());
  }
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
    problem_.points[k].carried = carried_share(p.impulse[0], p.begun, p.inverse_nn);
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

}  // namespace drawpoint::engine::contact::detail
