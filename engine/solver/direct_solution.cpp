// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/base/cross_matrix.h>
#include <drawpoint/engine/solver/direct_solution.h>
#include <drawpoint/engine/solver/islands.h>
#include <algorithm>
#include <cmath>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int most_rounds = 40, most_steps = 60, most_halvings = 60;
constexpr int steady_rounds = 10;  // after which bounds that jump to and fro are averaged
constexpr double relaxation_of_a_round = 1e-2, relaxation = 1e-8;  // of a point's own response; the last
constexpr double settled = 1e-8;      // change of the impulses in a round, relative to them
constexpr double least_gain = 1e-20;  // of a step, relative to the energy, which is round-off

}  // namespace

DirectSolution::DirectSolution(std::vector<SolverBody>& bodies, std::vector<PointBlock>& points,
                               std::vector<PairBlock>& pairs, double fastest)
    : bodies_(bodies), pairs_(pairs), fastest_(fastest) {
  int moving = 0;
  for (const SolverBody& body : bodies) place_.push_back(can_move(body) ? moving++ : -1);
  mass_ = MatrixXd::Zero(6 * moving, 6 * moving);
  free_.resize(6 * moving);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (place_[k] < 0) continue;
    const int row = 6 * place_[k];
    mass_.block<3, 3>(row, row) = Matrix3d::Identity() / bodies[k].inverse_mass;
    mass_.block<3, 3>(row + 3, row + 3) = bodies[k].inverse_inertia.inverse();
    free_.segment<6>(row) << bodies[k].velocity, bodies[k].angular_velocity;
  }
  for (PointBlock& p : points) {
    Rows a, b;
    a << -p.frame, p.frame * cross_matrix(p.arm_a);
    b << p.frame, -p.frame * cross_matrix(p.arm_b);
    add(p, &p, p.a, p.b, a, b);
  }
  for (PairBlock& r : pairs) {
    Rows b;
    b << Matrix3d::Zero(), r.frame;
    add(r, nullptr, r.a, r.b, -b, b);
  }
  free_ -= pushed();
}

void DirectSolution::add(ContactBlock& block, const PointBlock* point, int a, int b, const Rows& rows_a,
                         const Rows& rows_b) {
  Triple t;
  t.block = &block;
  t.point = point;
  t.a = place_[a];
  t.b = place_[b];
  t.rows_a = rows_a;
  t.rows_b = rows_b;
  t.impulse = block.impulse;
  for (const int side : {a, b}) {
    if (place_[side] >= 0) continue;
    Eigen::Matrix<double, 6, 1> motion;
    motion << bodies_[side].velocity, bodies_[side].angular_velocity;
    t.fixed += (side == a ? rows_a : rows_b) * motion;
  }
  triples_.push_back(t);
}

Vector3d DirectSolution::velocity(const Triple& t, const VectorXd& v) const {
  Vector3d u = t.fixed;
  if (t.a >= 0) u += t.rows_a * v.segment<6>(6 * t.a);
  if (t.b >= 0) u += t.rows_b * v.segment<6>(6 * t.b);
  return u;
}

// What the relaxed law answers to a velocity: λ within its bounds and r (λ - λ found) + u = what the law leaves.
DirectSolution::Answer DirectSolution::answer(const Triple& t, const Vector3d& u) const {
  Answer to{Vector3d::Zero(), Matrix3d::Zero()};
  const double r = t.relaxed_normal, found = t.impulse[0];
  if (t.point) {
    const double sigma = t.point->terms.sigma;
    const double soft = (r * found + t.point->target - u[0]) / (r + sigma),
                 hard = found + (fastest_ - u[0]) / r;
    to.impulse[0] = std::max(0.0, std::min(soft, hard));
    if (to.impulse[0] > 0) to.slope(0, 0) = soft < hard ? 1 / (r + sigma) : 1 / r;
  } else if (t.normal_bound > 0) {
    const double free = found - u[0] / r;
    to.impulse[0] = std::clamp(free, -t.normal_bound, t.normal_bound);
    if (free == to.impulse[0]) to.slope(0, 0) = 1 / r;
  }
  if (!(t.tangent_bound > 0)) return to;
  const Vector2d free = t.impulse.tail<2>() - u.tail<2>() / t.relaxed_tangent;
  const double factor = law::disc_factor(free.squaredNorm(), t.tangent_bound);
  to.impulse.tail<2>() = factor * free;
  Matrix2d slope = Matrix2d::Identity();
  if (factor < 1) slope -= free * free.transpose() / free.squaredNorm();
  to.slope.bottomRightCorner<2, 2>() = factor / t.relaxed_tangent * slope;
  return to;
}

VectorXd DirectSolution::gradient(const VectorXd& v) const {
  VectorXd g = mass_ * (v - free_);
  for (const Triple& t : triples_) {
    const Vector3d impulse = answer(t, velocity(t, v)).impulse;
    if (t.a >= 0) g.segment<6>(6 * t.a) -= t.rows_a.transpose() * impulse;
    if (t.b >= 0) g.segment<6>(6 * t.b) -= t.rows_b.transpose() * impulse;
  }
  return g;
}

MatrixXd DirectSolution::hessian(const VectorXd& v) const {
  MatrixXd H = mass_;
  for (const Triple& t : triples_) {
    const Matrix3d slope = answer(t, velocity(t, v)).slope;
    const Rows a = slope * t.rows_a, b = slope * t.rows_b;
    if (t.a >= 0) H.block<6, 6>(6 * t.a, 6 * t.a) += t.rows_a.transpose() * a;
    if (t.b >= 0) H.block<6, 6>(6 * t.b, 6 * t.b) += t.rows_b.transpose() * b;
    if (t.a < 0 || t.b < 0) continue;
    H.block<6, 6>(6 * t.a, 6 * t.b) += t.rows_a.transpose() * b;
    H.block<6, 6>(6 * t.b, 6 * t.a) += t.rows_b.transpose() * a;
  }
  return H;
}

// Where the function's slope along the step, which grows, passes zero; at most the whole step.
double DirectSolution::length_of_step(const VectorXd& v, const VectorXd& step) const {
  const auto slope = [&](double length) { return step.dot(gradient(v + length * step)); };
  if (slope(1) <= 0) return 1;
  double low = 0, high = 1;
  for (int k = 0; k < most_halvings && (low == 0 || high > 1.1 * low); ++k) {
    const double middle = 0.5 * (low + high);
    (slope(middle) > 0 ? high : low) = middle;
  }
  return low;
}

void DirectSolution::minimise(VectorXd& v) const {
  for (int k = 0; k < most_steps; ++k) {
    const VectorXd g = gradient(v), step = -hessian(v).ldlt().solve(g);
    const double gained = -g.dot(step), energy = (v - free_).dot(mass_ * (v - free_));
    if (!(gained > least_gain * energy)) return;
    const double length = length_of_step(v, step);
    if (length == 0) return;
    v += length * step;
  }
}

void DirectSolution::relax(int round) {
  const double share = std::max(relaxation, std::pow(relaxation_of_a_round, round + 1));
  for (Triple& t : triples_) {
    t.relaxed_normal = share * t.block->W(0, 0);
    t.relaxed_tangent = share * t.block->W.bottomRightCorner<2, 2>().trace();
  }
}

// A share of the way to what the loads allow.
void DirectSolution::set_bounds(double share) {
  const auto approach = [share](double& bound, double allowed) { bound += share * (allowed - bound); };
  for (Triple& t : triples_)
    if (t.point) approach(t.tangent_bound, t.point->friction * t.impulse[0]);
  const std::size_t points = triples_.size() - pairs_.size();
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    double load = 0;
    for (int p = pairs_[k].first; p < pairs_[k].first + pairs_[k].count; ++p) load += triples_[p].impulse[0];
    approach(triples_[points + k].tangent_bound, pairs_[k].rolling_arm * load);
    approach(triples_[points + k].normal_bound, pairs_[k].spinning_arm * load);
  }
}

// Returns how far the impulses moved, relative to them.
double DirectSolution::take_over(const VectorXd& v) {
  double moved = 0, all = 0;
  for (Triple& t : triples_) {
    const Vector3d impulse = answer(t, velocity(t, v)).impulse;
    if (t.point) moved += (impulse - t.impulse).lpNorm<1>(), all += impulse[0];
    t.impulse = impulse;
  }
  return all > 0 ? moved / all : moved;
}

// The velocities that the impulses make.
VectorXd DirectSolution::pushed() const {
  VectorXd momentum = VectorXd::Zero(free_.size());
  for (const Triple& t : triples_) {
    if (t.a >= 0) momentum.segment<6>(6 * t.a) += t.rows_a.transpose() * t.impulse;
    if (t.b >= 0) momentum.segment<6>(6 * t.b) += t.rows_b.transpose() * t.impulse;
  }
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (place_[k] < 0) continue;
    momentum.segment<3>(6 * place_[k]) *= bodies_[k].inverse_mass;
    const Vector3d angular = bodies_[k].inverse_inertia * momentum.segment<3>(6 * place_[k] + 3);
    momentum.segment<3>(6 * place_[k] + 3) = angular;
  }
  return momentum;
}

void DirectSolution::solve() {
  VectorXd v = free_ + pushed();
  for (int round = 0; round < most_rounds; ++round) {
    relax(round);
    set_bounds(round < steady_rounds ? 1 : 0.5);
    minimise(v);
    if (take_over(v) < settled) break;
  }
  v = free_ + pushed();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (place_[k] < 0) continue;
    bodies_[k].velocity = v.segment<3>(6 * place_[k]);
    bodies_[k].angular_velocity = v.segment<3>(6 * place_[k] + 3);
  }
  for (const Triple& t : triples_) t.block->impulse = t.impulse;
}

}  // namespace drawpoint::engine::detail
