// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/base/cross_matrix.h>
#include <drawpoint/engine/solver/contact_frame.h>
#include <drawpoint/engine/solver/contact_law_scalar.h>
#include <drawpoint/engine/solver/received_impulses.h>
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/solver/residual.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
namespace law = detail::law;

// A rigid motion or its rate: of a body about its centre of mass, of a part about its origin.
struct Twist {
  Vector3d angular, linear;
  Vector3d at(const Vector3d& arm) const { return linear + angular.cross(arm); }
};

// One side of a contact in the last substep, rigid body or machine part alike.
struct Side {
  Twist before, after, shift;  // velocities at its start and end; motion until its start
  bool part = false;
};

// Projection of x on the disc of the radius.
Vector3d in_disc(const Vector3d& x, double radius) { return law::disc_factor(x.squaredNorm(), radius) * x; }

// What a symmetric 3 x 3 response answers along n, and the most across it, without choosing tangents: with t
// the trace of the block across n and D the rest of it without its mean, λ_max = t/2 + |D| / √2.
struct Answers {
  double along, most_across;
};

Answers answers(const Matrix3d& W, const Vector3d& n) {
  const Vector3d column = W * n;
  const double along = n.dot(column), half_trace = 0.5 * (W.trace() - along);
  const Matrix3d D = W - n * column.transpose() - column * n.transpose() +
                     (along + half_trace) * n * n.transpose() - half_trace * Matrix3d::Identity();
  return {along, half_trace + D.norm() * std::sqrt(0.5)};
}

class LastSubstep {
 public:
  LastSubstep(const ContactProblem& problem, const SuperBodySolution& machine, int substeps)
      : problem_(problem), machine_(machine), substeps_(substeps), h_(problem.step / substeps) {
    const auto received = received_impulses(problem, machine, detail::of_the_last_substep(substeps));
    add_bodies(received);
    if (problem.machine) add_parts(*problem.machine, received.machine);
  }

  Residual residual();

 private:
  void add_bodies(const detail::ReceivedImpulses& received);
  void add_parts(const SuperBody& machine, const Eigen::VectorXd& received);
  const Side& side(int index) const { return index < 0 ? parts_[part_of(index)] : bodies_[index]; }
  Matrix3d response(int index, const Vector3d& arm) const;
  Matrix3d angular_response(int index) const;
  double evaluate(const ContactPair& pair, const ContactPoint& point);  // returns λ_n
  void evaluate_moment(const ContactPair& pair, double load);
  double evaluate_rows() const;

  const ContactProblem& problem_;
  const SuperBodySolution& machine_;
  int substeps_;
  double h_;
  std::vector<Side> bodies_, parts_;
  std::vector<Eigen::Matrix<double, 6, 6>> part_responses_;
  double load_ = 0, normal_ = 0, friction_ = 0, moment_ = 0;
};

void LastSubstep::add_bodies(const detail::ReceivedImpulses& received) {
  for (std::size_t k = 0; k < problem_.bodies.size(); ++k) {
    const SolverBody& b = problem_.bodies[k];
    Side s;
    s.after = {b.angular_velocity, b.velocity};
    s.before = {b.angular_velocity - b.inverse_inertia * received.angular[k],
                b.velocity - b.external_velocity_change / substeps_ - b.inverse_mass * received.linear[k]};
    s.shift = {b.rotation_vector - h_ * b.angular_velocity, b.displacement - h_ * b.velocity};
    bodies_.push_back(s);
  }
}

void LastSubstep::add_parts(const SuperBody& super, const Eigen::VectorXd& received) {
  const Eigen::VectorXd before =
      machine_.velocity - (super.velocity - super.velocity_before) / substeps_ - received;
  const Eigen::VectorXd shift = problem_.step * machine_.mean_velocity - h_ * machine_.velocity;
  const auto twist = [](const SpatialVector& V) { return Twist{V.head<3>(), V.tail<3>()}; };
  for (const SpatialMap& map : super.part_maps) {
    parts_.push_back({twist(map * before), twist(map * machine_.velocity), twist(map * shift), true});
    part_responses_.push_back(map * map.transpose());
  }
}

Matrix3d LastSubstep::response(int index, const Vector3d& arm) const {
  const Matrix3d X = cross_matrix(arm);
  if (index >= 0) {
    const SolverBody& body = problem_.bodies[index];
    return body.inverse_mass * Matrix3d::Identity() - X * body.inverse_inertia * X;
  }
  const auto& A = part_responses_[part_of(index)];
  return A.bottomRightCorner<3, 3>() - X * A.topRightCorner<3, 3>() + A.bottomLeftCorner<3, 3>() * X -
         X * A.topLeftCorner<3, 3>() * X;
}

Matrix3d LastSubstep::angular_response(int index) const {
  return index >= 0 ? problem_.bodies[index].inverse_inertia
                    : Matrix3d(part_responses_[part_of(index)].topLeftCorner<3, 3>());
}

double LastSubstep::evaluate(const ContactPair& pair, const ContactPoint& p) {
  const Side &a = side(pair.a), &b = side(pair.b);
  const Vector3d& n = p.normal;
  const Vector3d impulse = p.start / substeps_, u = b.after.at(p.arm_b) - a.after.at(p.arm_a);
  const Answers W = answers(response(pair.a, p.arm_a) + response(pair.b, p.arm_b), n);
  const SpookTerms terms = law::spook_terms(p, problem_.step, substeps_);
  const double gap = p.gap + n.dot(b.shift.at(p.arm_b) - a.shift.at(p.arm_a));
  const double approach = n.dot(b.before.at(p.arm_b) - a.before.at(p.arm_a));
  const double target = law::bias_velocity(gap, approach, terms.upsilon, -1 / h_);

  const double normal = n.dot(impulse);
  const double next =
      law::normal_step(normal, n.dot(u), terms.sigma, target, law::inverse_or_zero(W.along + terms.sigma),
                       constants::push_out_speed);
  normal_ += std::abs(normal - next);
  load_ += std::max(normal, next);

  const Vector3d tangent = impulse - normal * n, slip = u - n.dot(u) * n;
  const Vector3d stepped = tangent - law::inverse_or_zero(W.most_across) * slip;
  const double friction = problem_.points[pair.first].friction;
  friction_ += (tangent - in_disc(stepped, friction * std::max(0.0, normal))).norm();
  return normal;
}

void LastSubstep::evaluate_moment(const ContactPair& pair, double load) {
  const Vector3d& n = problem_.points[pair.first].normal;
  const Vector3d moment = pair.start / substeps_, u = side(pair.b).after.angular - side(pair.a).after.angular;
  const Answers W = answers(angular_response(pair.a) + angular_response(pair.b), n);
  if (pair.rolling_arm > 0) {
    const Vector3d tangent = moment - n.dot(moment) * n;
    const Vector3d stepped = tangent - law::inverse_or_zero(W.most_across) * (u - n.dot(u) * n);
    moment_ += (tangent - in_disc(stepped, pair.rolling_arm * load)).norm() / pair.rolling_arm;
  }
  if (pair.spinning_arm > 0) {
    const double normal = n.dot(moment);
    const double next =
        law::spin_step(normal, n.dot(u), law::inverse_or_zero(W.along), pair.spinning_arm * load);
    moment_ += std::abs(normal - next) / pair.spinning_arm;
  }
}

// A row's impulse λ changes w by J λ, so |J| r has one unit for slides and hinges.
double LastSubstep::evaluate_rows() const {
  const Eigen::VectorXd& w = machine_.velocity;
  const Eigen::VectorXd shift = problem_.step * machine_.mean_velocity - h_ * w;
  double off = 0, all = 0;
  for (std::size_t k = 0; k < problem_.machine->rows.size(); ++k) {
    const SuperBodyRow& row = problem_.machine->rows[k];
    const double impulse = machine_.row_starts[k] / substeps_, response = row.jacobian.squaredNorm();
    const double target = law::bias_velocity(row, row.gap + row.jacobian.dot(shift), h_);
    const double rest = row.jacobian.dot(w) - target;
    const double next = std::clamp(impulse - rest * law::inverse_or_zero(response), row.lower / substeps_,
                                   row.upper / substeps_);
    off += response * (impulse - next) * (impulse - next);
    all += response * std::max(impulse * impulse, next * next);
  }
  return all > 0 ? std::sqrt(off / all) : 0;
}

Residual LastSubstep::residual() {
  for (const ContactPair& pair : problem_.pairs) {
    if (pair.count == 0) continue;
    double load = 0;
    for (int k = pair.first; k < pair.first + pair.count; ++k) load += evaluate(pair, problem_.points[k]);
    evaluate_moment(pair, std::max(0.0, load));
  }
  Residual r;
  if (load_ > 0) r = {normal_ / load_, friction_ / load_, moment_ / load_, 0};
  if (problem_.machine) r.rows = evaluate_rows();
  return r;
}

}  // namespace

Residual residual(const ContactProblem& solved, const SuperBodySolution& machine, int substeps) {
  if (substeps < 1)
    throw std::invalid_argument("engine::residual: substeps is " + std::to_string(substeps) +
                                "; allowed: at least 1; give the number that the solve used");
  return LastSubstep(solved, machine, substeps).residual();
}

}  // namespace drawpoint::engine
