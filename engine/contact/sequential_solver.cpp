// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/contact/contact_law.hpp>
#include <drawpoint/engine/contact/sequential_solver.hpp>

namespace drawpoint::engine::contact {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using PartRows = Eigen::Matrix<double, 3, Eigen::Dynamic>;

struct Frame {
  Vector3d t1, t2;
};

Frame tangents(const Vector3d& n) {
  const Vector3d helper = std::abs(n.z()) < 0.7 ? Vector3d::UnitZ() : Vector3d::UnitX();
  const Vector3d t1 = helper.cross(n).normalized();
  return {t1, n.cross(t1)};
}

Matrix3d cross_matrix(const Vector3d& r) {
  Matrix3d X;
  X << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return X;
}

// Largest eigenvalue of a symmetric 2 x 2 matrix.
double largest_eigenvalue(double a, double b, double d) {
  return 0.5 * (a + d) + std::hypot(0.5 * (a - d), b);
}

// Below this, relative to the largest eigenvalue's power, a block counts as singular.
constexpr double singular = 1e-12;

double inverse_or_zero(double x) { return x > 0 ? 1.0 / x : 0.0; }

// A contact point made ready: frame, block and its inverse pieces.
struct PointBlock {
  int a, b;
  Vector3d arm_a, arm_b;
  Matrix3d frame;  // rows n, t1, t2
  Matrix3d W;      // in the frame
  double friction, gap;
  SpookTerms law;
  double target;         // of the substep
  double inverse_nn;     // 1 / (W_nn + Σ)
  double inverse_tt[3];  // of the 2 x 2 friction block: xx, xy, yy
  double inverse_rho;
  Vector3d impulse;              // in the frame, of the substep
  Vector3d total;                // in the frame, of the step
  int rows_a = -1, rows_b = -1;  // index of the side's rows, if it is a machine part
};

// The moment between a pair, in the frame of its normal.
struct PairBlock {
  int a, b, first, count;
  double rolling_arm, spinning_arm;
  Matrix3d frame;
  double inverse_nn;
  double inverse_tt[3];
  double inverse_rho;
  Matrix3d W;
  Vector3d impulse, total;
  int rows_a = -1, rows_b = -1;
};

// Exact inverse of the 2 x 2 block of the tangents, or the scalar step where a part with few freedoms does
// not answer in some direction.
void invert_tangents(const Matrix3d& W, double (&inverse)[3], double& inverse_rho) {
  const double a = W(1, 1), b = W(1, 2), d = W(2, 2), rho = largest_eigenvalue(a, b, d);
  inverse_rho = inverse_or_zero(rho);
  const double det = a * d - b * b;
  const bool regular = det > singular * rho * rho;
  inverse[0] = regular ? d / det : inverse_rho;
  inverse[1] = regular ? -b / det : 0;
  inverse[2] = regular ? a / det : inverse_rho;
}

// The tangential part of an impulse after its step: sticking where the cone of radius `limit` allows it, else
// a scalar step projected on it.
void project_tangents(Vector3d& impulse, double u1, double u2, const double (&inverse)[3], double inverse_rho,
                      double limit) {
  double t1 = impulse[1] - (inverse[0] * u1 + inverse[1] * u2);
  double t2 = impulse[2] - (inverse[1] * u1 + inverse[2] * u2);
  if (t1 * t1 + t2 * t2 > limit * limit) {
    t1 = impulse[1] - inverse_rho * u1;
    t2 = impulse[2] - inverse_rho * u2;
    const double length = std::sqrt(t1 * t1 + t2 * t2);
    if (length > limit) {
      t1 *= limit / length;
      t2 *= limit / length;
    }
  }
  impulse[1] = t1;
  impulse[2] = t2;
}

class Sweeper {
 public:
  Sweeper(ContactProblem& problem, int substeps)
      : problem_(problem), substeps_(substeps), h_(problem.step / substeps) {
    for (SolverBody& body : problem.bodies) body.travel.setZero(), body.turn.setZero();
    if (problem.machine) prepare_machine(*problem.machine);
    points_.reserve(problem.points.size());
    for (const ContactPair& pair : problem.pairs) add_pair(pair);
  }

  void begin_substep();
  double sweep(bool forward);
  void end_substep();

  double normal_load() const {
    double sum = 0;
    for (const PointBlock& p : points_) sum += p.impulse[0];
    return sum;
  }

  SuperBodySolution store();

 private:
  // Rows of a machine part at a point: velocity of the point = rows · w, in the given axes.
  int add_rows(int part, const Vector3d& arm, const Matrix3d& axes) {
    const SpatialMap& map = problem_.machine->part_maps[part];
    part_rows_.push_back(axes * (map.bottomRows<3>() - cross_matrix(arm) * map.topRows<3>()));
    return static_cast<int>(part_rows_.size()) - 1;
  }
  int add_angular_rows(int part, const Matrix3d& axes) {
    part_rows_.push_back(axes * problem_.machine->part_maps[part].topRows<3>());
    return static_cast<int>(part_rows_.size()) - 1;
  }
  Matrix3d response(int index, const Vector3d& arm, const Matrix3d& frame) const {
    const SolverBody& body = problem_.bodies[index];
    const Matrix3d X = cross_matrix(arm);
    return frame * (body.inverse_mass * Matrix3d::Identity() - X * body.inverse_inertia * X) *
           frame.transpose();
  }

  void prepare_machine(const SuperBody& machine);
  void add_pair(const ContactPair& pair);
  void add_point(const ContactPair& pair, const ContactPoint& point);
  double row_target(const SuperBodyRow& row) const;
  void solve_machine_rows();
  void solve_point(PointBlock& p);
  void solve_pair(PairBlock& r);
  Vector3d velocity(const PointBlock& p) const;
  Vector3d displacement(const PointBlock& p) const;
  Vector3d spin(const PairBlock& r) const;
  void apply(const PointBlock& p, const Vector3d& delta);
  void apply(const PairBlock& r, const Vector3d& delta);

  ContactProblem& problem_;
  int substeps_;
  double h_;
  Eigen::VectorXd w_, w_push_, w_travel_;
  std::vector<double> inverse_rows_, row_impulses_, row_totals_, row_targets_;
  std::vector<PointBlock> points_;
  std::vector<PairBlock> pairs_;
  std::vector<PartRows> part_rows_;
  double change_ = 0;
};

void Sweeper::prepare_machine(const SuperBody& machine) {
  w_ = machine.velocity_before;
  w_push_ = (machine.velocity - machine.velocity_before) / substeps_;
  w_travel_ = Eigen::VectorXd::Zero(w_.size());
  for (const SuperBodyRow& row : machine.rows) {
    inverse_rows_.push_back(inverse_or_zero(row.jacobian.squaredNorm()));
    row_impulses_.push_back(std::clamp(row.start, row.lower, row.upper) / substeps_);
  }
  row_totals_.assign(machine.rows.size(), 0.0);
  row_targets_.assign(machine.rows.size(), 0.0);
}

void Sweeper::add_pair(const ContactPair& pair) {
  for (int k = pair.first; k < pair.first + pair.count; ++k) add_point(pair, problem_.points[k]);
  PairBlock r{};
  r.a = pair.a;
  r.b = pair.b;
  r.first = pair.first;
  r.count = pair.count;
  r.rolling_arm = pair.rolling_arm;
  r.spinning_arm = pair.spinning_arm;
  const Vector3d& n = problem_.points[pair.first].normal;
  const Frame t = tangents(n);
  r.frame << n.transpose(), t.t1.transpose(), t.t2.transpose();
  r.W.setZero();
  r.rows_a = r.a < 0 ? add_angular_rows(part_of(r.a), r.frame) : -1;
  r.rows_b = r.b < 0 ? add_angular_rows(part_of(r.b), r.frame) : -1;
  for (const int index : {r.a, r.b})
    if (index >= 0) r.W += r.frame * problem_.bodies[index].inverse_inertia * r.frame.transpose();
  for (const int rows : {r.rows_a, r.rows_b})
    if (rows >= 0) r.W += part_rows_[rows] * part_rows_[rows].transpose();
  r.inverse_nn = inverse_or_zero(r.W(0, 0));
  invert_tangents(r.W, r.inverse_tt, r.inverse_rho);
  r.impulse = r.frame * pair.start / substeps_;
  r.total.setZero();
  pairs_.push_back(r);
}

void Sweeper::add_point(const ContactPair& pair, const ContactPoint& point) {
  const Frame t = tangents(point.normal);
  PointBlock p{};
  p.a = pair.a;
  p.b = pair.b;
  p.arm_a = point.arm_a;
  p.arm_b = point.arm_b;
  p.frame << point.normal.transpose(), t.t1.transpose(), t.t2.transpose();
  p.law = spook(point.stiffness, std::max(point.damping_time, 2 * problem_.step), h_);
  p.gap = point.gap;
  p.friction = point.friction;
  p.W.setZero();
  p.rows_a = p.a < 0 ? add_rows(part_of(p.a), p.arm_a, p.frame) : -1;
  p.rows_b = p.b < 0 ? add_rows(part_of(p.b), p.arm_b, p.frame) : -1;
  if (p.a >= 0) p.W += response(p.a, p.arm_a, p.frame);
  if (p.b >= 0) p.W += response(p.b, p.arm_b, p.frame);
  for (const int rows : {p.rows_a, p.rows_b})
    if (rows >= 0) p.W += part_rows_[rows] * part_rows_[rows].transpose();
  p.inverse_nn = inverse_or_zero(p.W(0, 0) + p.law.sigma);
  invert_tangents(p.W, p.inverse_tt, p.inverse_rho);
  p.impulse = p.frame * point.start / substeps_;
  p.impulse[0] = std::max(0.0, p.impulse[0]);
  const double slip = p.impulse.tail<2>().norm(), limit = p.friction * p.impulse[0];
  if (slip > limit) p.impulse.tail<2>() *= limit / slip;
  p.total.setZero();
  points_.push_back(p);
}

Vector3d Sweeper::velocity(const PointBlock& p) const {
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

Vector3d Sweeper::displacement(const PointBlock& p) const {
  Vector3d d = Vector3d::Zero();
  if (p.a >= 0)
    d -= p.frame * (problem_.bodies[p.a].travel + problem_.bodies[p.a].turn.cross(p.arm_a));
  else
    d.noalias() -= part_rows_[p.rows_a] * w_travel_;
  if (p.b >= 0)
    d += p.frame * (problem_.bodies[p.b].travel + problem_.bodies[p.b].turn.cross(p.arm_b));
  else
    d.noalias() += part_rows_[p.rows_b] * w_travel_;
  return d;
}

Vector3d Sweeper::spin(const PairBlock& r) const {
  Vector3d u = Vector3d::Zero();
  u -= r.a >= 0 ? Vector3d(r.frame * problem_.bodies[r.a].angular_velocity)
                : Vector3d(part_rows_[r.rows_a] * w_);
  u += r.b >= 0 ? Vector3d(r.frame * problem_.bodies[r.b].angular_velocity)
                : Vector3d(part_rows_[r.rows_b] * w_);
  return u;
}

void Sweeper::apply(const PointBlock& p, const Vector3d& delta) {
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

void Sweeper::apply(const PairBlock& r, const Vector3d& delta) {
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

double Sweeper::row_target(const SuperBodyRow& row) const {
  if (row.kind == SuperBodyRow::Kind::motor) return row.target;
  const double gap = row.gap + row.jacobian.dot(w_travel_);
  return gap >= 0 ? -gap / h_ : -gap / row.recovery;
}

// Targets from the gaps and velocities reached, the outer forces' share, and the impulses to start from.
void Sweeper::begin_substep() {
  for (PointBlock& p : points_)
    p.target = spook_target(p.gap + displacement(p)[0], velocity(p)[0], p.law.upsilon, h_);
  for (SolverBody& body : problem_.bodies) body.velocity += body.push / substeps_;
  if (problem_.machine) {
    const std::vector<SuperBodyRow>& rows = problem_.machine->rows;
    w_ += w_push_;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      row_targets_[k] = row_target(rows[k]);
      w_ += rows[k].jacobian * row_impulses_[k];
    }
  }
  for (const PointBlock& p : points_) apply(p, p.impulse);
  for (const PairBlock& r : pairs_) apply(r, r.impulse);
}

double Sweeper::sweep(bool forward) {
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

void Sweeper::solve_machine_rows() {
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

void Sweeper::solve_point(PointBlock& p) {
  const Vector3d u = velocity(p);
  const Vector3d before = p.impulse;
  p.impulse[0] = std::max(0.0, before[0] - p.inverse_nn * (u[0] + p.law.sigma * before[0] - p.target));
  const double dn = p.impulse[0] - before[0];
  project_tangents(p.impulse, u[1] + p.W(1, 0) * dn, u[2] + p.W(2, 0) * dn, p.inverse_tt, p.inverse_rho,
                   p.friction * p.impulse[0]);
  const Vector3d delta = p.impulse - before;
  const double moved = delta.lpNorm<1>();
  if (moved == 0) return;
  change_ += moved;
  apply(p, delta);
}

void Sweeper::solve_pair(PairBlock& r) {
  double load = 0;
  for (int k = r.first; k < r.first + r.count; ++k) load += points_[k].impulse[0];
  if (r.rolling_arm == 0 && r.spinning_arm == 0) return;
  const Vector3d u = spin(r);
  const Vector3d before = r.impulse;
  const double limit = r.spinning_arm * load;
  r.impulse[0] = std::clamp(before[0] - r.inverse_nn * u[0], -limit, limit);
  const double dn = r.impulse[0] - before[0];
  project_tangents(r.impulse, u[1] + r.W(1, 0) * dn, u[2] + r.W(2, 0) * dn, r.inverse_tt, r.inverse_rho,
                   r.rolling_arm * load);
  apply(r, r.impulse - before);
}

void Sweeper::end_substep() {
  for (SolverBody& body : problem_.bodies) {
    body.travel += h_ * body.velocity;
    body.turn += h_ * body.angular_velocity;
  }
  if (problem_.machine) {
    w_travel_ += h_ * w_;
    for (std::size_t k = 0; k < row_totals_.size(); ++k) row_totals_[k] += row_impulses_[k];
  }
  for (PointBlock& p : points_) p.total += p.impulse;
  for (PairBlock& r : pairs_) r.total += r.impulse;
}

SuperBodySolution Sweeper::store() {
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

}  // namespace

SolverReport solve_sequentially(ContactProblem& problem, const SolverOptions& options) {
  Sweeper sweeper(problem, options.substeps);
  double change = 0;
  for (int s = 0; s < options.substeps; ++s) {
    sweeper.begin_substep();
    for (int k = 0; k < options.sweeps; ++k) change = sweeper.sweep(k % 2 == 0);
    sweeper.end_substep();
  }
  const double load = sweeper.normal_load();
  SolverReport report;
  report.last_change = load > 0 ? change / load : 0;
  report.machine = sweeper.store();
  return report;
}

}  // namespace drawpoint::engine::contact
