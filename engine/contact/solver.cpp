// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/contact/solver.hpp>

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
  double sigma, target, friction;
  double inverse_nn;     // 1 / (W_nn + Σ)
  double inverse_tt[3];  // of the 2 x 2 friction block: xx, xy, yy
  double inverse_rho;
  Vector3d impulse;              // in the frame
  int rows_a = -1, rows_b = -1;  // first column block in the machine's rows, if that side is a part
};

struct RollingBlock {
  int a, b, first, count;
  double arm, inverse_rho;
  Matrix3d inverse_W;
  Vector3d impulse;
  int rows_a = -1, rows_b = -1;
};

class Sweeper {
 public:
  explicit Sweeper(ContactProblem& problem) : problem_(problem) {
    if (problem.machine) {
      w_ = problem.machine->velocity;
      for (const SuperBodyRow& row : problem.machine->rows) {
        const double square = row.jacobian.squaredNorm();
        inverse_rows_.push_back(square + row.sigma > 0 ? 1.0 / (square + row.sigma) : 0.0);
        row_impulses_.push_back(std::clamp(row.start, row.lower, row.upper));
        w_ += row.jacobian * row_impulses_.back();
      }
    }
    points_.reserve(problem.points.size());
    for (const ContactPoint& point : problem.points) add_point(point);
    for (const RollingRow& row : problem.rolling) add_rolling(row);
  }

  double sweep(bool forward) {
    change_ = 0;
    solve_machine_rows();
    const int n = static_cast<int>(points_.size());
    for (int k = 0; k < n; ++k) solve_point(points_[forward ? k : n - 1 - k]);
    for (RollingBlock& row : rolling_) solve_rolling(row);
    return change_;
  }

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
  int add_angular_rows(int part) {
    part_rows_.push_back(problem_.machine->part_maps[part].topRows<3>());
    return static_cast<int>(part_rows_.size()) - 1;
  }

  Matrix3d response(int index, const Vector3d& arm, const Matrix3d& frame) const {
    const SolverBody& body = problem_.bodies[index];
    const Matrix3d X = cross_matrix(arm);
    return frame * (body.inverse_mass * Matrix3d::Identity() - X * body.inverse_inertia * X) *
           frame.transpose();
  }

  void add_point(const ContactPoint& point);
  void add_rolling(const RollingRow& row);
  void solve_machine_rows();
  void solve_point(PointBlock& p);
  void solve_rolling(RollingBlock& r);
  Vector3d relative_velocity(const PointBlock& p) const;
  void apply(const PointBlock& p, const Vector3d& delta);
  void apply(const RollingBlock& r, const Vector3d& delta);

  ContactProblem& problem_;
  Eigen::VectorXd w_;
  std::vector<double> inverse_rows_, row_impulses_;
  std::vector<PointBlock> points_;
  std::vector<RollingBlock> rolling_;
  std::vector<PartRows> part_rows_;
  double change_ = 0;
};

void Sweeper::add_point(const ContactPoint& point) {
  const Frame t = tangents(point.normal);
  PointBlock p;
  p.a = point.a;
  p.b = point.b;
  p.arm_a = point.arm_a;
  p.arm_b = point.arm_b;
  p.frame << point.normal.transpose(), t.t1.transpose(), t.t2.transpose();
  p.sigma = point.sigma;
  p.target = point.target;
  p.friction = point.friction;
  p.W.setZero();
  if (p.a < 0) p.rows_a = add_rows(part_of(p.a), p.arm_a, p.frame);
  if (p.b < 0) p.rows_b = add_rows(part_of(p.b), p.arm_b, p.frame);
  if (p.a >= 0) p.W += response(p.a, p.arm_a, p.frame);
  if (p.b >= 0) p.W += response(p.b, p.arm_b, p.frame);
  if (p.rows_a >= 0) p.W += part_rows_[p.rows_a] * part_rows_[p.rows_a].transpose();
  if (p.rows_b >= 0) p.W += part_rows_[p.rows_b] * part_rows_[p.rows_b].transpose();
  p.inverse_nn = inverse_or_zero(p.W(0, 0) + p.sigma);
  const double a = p.W(1, 1), b = p.W(1, 2), d = p.W(2, 2), rho = largest_eigenvalue(a, b, d);
  p.inverse_rho = inverse_or_zero(rho);
  // A part with few freedoms may not answer in some direction; then the scalar step stands for the 2 x 2
  // inverse.
  const double det = a * d - b * b;
  const bool regular = det > singular * rho * rho;
  p.inverse_tt[0] = regular ? d / det : p.inverse_rho;
  p.inverse_tt[1] = regular ? -b / det : 0;
  p.inverse_tt[2] = regular ? a / det : p.inverse_rho;
  p.impulse = p.frame * point.impulse;
  p.impulse[0] = std::max(0.0, p.impulse[0]);
  const double slip = p.impulse.tail<2>().norm(), limit = p.friction * p.impulse[0];
  if (slip > limit) p.impulse.tail<2>() *= limit / slip;
  apply(p, p.impulse);
  points_.push_back(p);
}

void Sweeper::add_rolling(const RollingRow& row) {
  RollingBlock r;
  r.a = row.a;
  r.b = row.b;
  r.first = row.first;
  r.count = row.count;
  r.arm = row.arm;
  Matrix3d W = Matrix3d::Zero();
  if (r.a < 0) r.rows_a = add_angular_rows(part_of(r.a));
  if (r.b < 0) r.rows_b = add_angular_rows(part_of(r.b));
  if (r.a >= 0) W += problem_.bodies[r.a].inverse_inertia;
  if (r.b >= 0) W += problem_.bodies[r.b].inverse_inertia;
  if (r.rows_a >= 0) W += part_rows_[r.rows_a] * part_rows_[r.rows_a].transpose();
  if (r.rows_b >= 0) W += part_rows_[r.rows_b] * part_rows_[r.rows_b].transpose();
  // The largest absolute row sum bounds the largest eigenvalue from above, within a factor 3: a safe step.
  const double rho = W.cwiseAbs().rowwise().sum().maxCoeff();
  r.inverse_rho = inverse_or_zero(rho);
  const bool regular = W.determinant() > singular * rho * rho * rho;
  r.inverse_W = regular ? W.inverse().eval() : r.inverse_rho * Matrix3d::Identity();
  r.impulse = row.impulse;
  apply(r, r.impulse);
  rolling_.push_back(r);
}

Vector3d Sweeper::relative_velocity(const PointBlock& p) const {
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

void Sweeper::apply(const RollingBlock& r, const Vector3d& delta) {
  if (r.a >= 0)
    problem_.bodies[r.a].angular_velocity -= problem_.bodies[r.a].inverse_inertia * delta;
  else
    w_.noalias() -= part_rows_[r.rows_a].transpose() * delta;
  if (r.b >= 0)
    problem_.bodies[r.b].angular_velocity += problem_.bodies[r.b].inverse_inertia * delta;
  else
    w_.noalias() += part_rows_[r.rows_b].transpose() * delta;
}

void Sweeper::solve_machine_rows() {
  if (!problem_.machine) return;
  for (std::size_t k = 0; k < problem_.machine->rows.size(); ++k) {
    const SuperBodyRow& row = problem_.machine->rows[k];
    const double rest = row.jacobian.dot(w_) + row.sigma * row_impulses_[k] - row.target;
    const double next = std::clamp(row_impulses_[k] - inverse_rows_[k] * rest, row.lower, row.upper);
    const double delta = next - row_impulses_[k];
    if (delta == 0) continue;
    row_impulses_[k] = next;
    w_.noalias() += row.jacobian * delta;
  }
}

void Sweeper::solve_point(PointBlock& p) {
  const Vector3d u = relative_velocity(p);
  const Vector3d before = p.impulse;
  p.impulse[0] = std::max(0.0, before[0] - p.inverse_nn * (u[0] + p.sigma * before[0] - p.target));
  const double dn = p.impulse[0] - before[0];
  const double u1 = u[1] + p.W(1, 0) * dn, u2 = u[2] + p.W(2, 0) * dn;
  const double limit = p.friction * p.impulse[0];
  double t1 = before[1] - (p.inverse_tt[0] * u1 + p.inverse_tt[1] * u2);
  double t2 = before[2] - (p.inverse_tt[1] * u1 + p.inverse_tt[2] * u2);
  if (t1 * t1 + t2 * t2 > limit * limit) {
    t1 = before[1] - p.inverse_rho * u1;
    t2 = before[2] - p.inverse_rho * u2;
    const double length = std::sqrt(t1 * t1 + t2 * t2);
    if (length > limit) {
      t1 *= limit / length;
      t2 *= limit / length;
    }
  }
  p.impulse[1] = t1;
  p.impulse[2] = t2;
  const Vector3d delta = p.impulse - before;
  const double moved = std::abs(delta[0]) + std::abs(delta[1]) + std::abs(delta[2]);
  if (moved == 0) return;
  change_ += moved;
  apply(p, delta);
}

void Sweeper::solve_rolling(RollingBlock& r) {
  Vector3d u = Vector3d::Zero();
  u -= r.a >= 0 ? problem_.bodies[r.a].angular_velocity : Vector3d(part_rows_[r.rows_a] * w_);
  u += r.b >= 0 ? problem_.bodies[r.b].angular_velocity : Vector3d(part_rows_[r.rows_b] * w_);
  double load = 0;
  for (int k = r.first; k < r.first + r.count; ++k) load += points_[k].impulse[0];
  const double limit = r.arm * load;
  Vector3d next = r.impulse - r.inverse_W * u;
  if (next.squaredNorm() > limit * limit) {
    next = r.impulse - r.inverse_rho * u;
    const double length = next.norm();
    if (length > limit) next *= limit / length;
  }
  const Vector3d delta = next - r.impulse;
  r.impulse = next;
  apply(r, delta);
}

SuperBodySolution Sweeper::store() {
  SuperBodySolution solution;
  if (problem_.machine) {
    solution.velocity = w_;
    solution.row_impulses = row_impulses_;
    solution.part_impulses.assign(problem_.machine->part_maps.size(), SpatialVector::Zero());
  }
  const auto add = [&](int part, double sign, const Vector3d& arm, const Vector3d& impulse,
                       const Vector3d& moment) {
    solution.part_impulses[part].head<3>() += sign * (arm.cross(impulse) + moment);
    solution.part_impulses[part].tail<3>() += sign * impulse;
  };
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const PointBlock& p = points_[k];
    const Vector3d impulse = p.frame.transpose() * p.impulse;
    problem_.points[k].impulse = impulse;
    if (p.a < 0) add(part_of(p.a), -1, p.arm_a, impulse, Vector3d::Zero());
    if (p.b < 0) add(part_of(p.b), +1, p.arm_b, impulse, Vector3d::Zero());
  }
  for (std::size_t k = 0; k < rolling_.size(); ++k) {
    const RollingBlock& r = rolling_[k];
    problem_.rolling[k].impulse = r.impulse;
    if (r.a < 0) add(part_of(r.a), -1, Vector3d::Zero(), Vector3d::Zero(), r.impulse);
    if (r.b < 0) add(part_of(r.b), +1, Vector3d::Zero(), Vector3d::Zero(), r.impulse);
  }
  return solution;
}

}  // namespace

SolverReport solve(ContactProblem& problem, const SolverOptions& options) {
  Sweeper sweeper(problem);
  SolverReport report;
  for (; report.sweeps < options.sweeps; ++report.sweeps)
    report.last_change = sweeper.sweep(report.sweeps % 2 == 0);
  const double load = sweeper.normal_load();
  report.last_change = load > 0 ? report.last_change / load : 0;
  report.machine = sweeper.store();
  return report;
}

}  // namespace drawpoint::engine::contact
