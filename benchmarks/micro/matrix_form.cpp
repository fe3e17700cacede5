// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/base/cross_matrix.h>
#include <drawpoint/engine/solver/contact_frame.h>
#include <drawpoint/engine/solver/contact_law_scalar.h>
#include <algorithm>
#include <drawpoint/benchmarks/micro/matrix_form.hpp>

namespace drawpoint::benchmarks {
namespace {

using namespace engine;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Entries = std::vector<Eigen::Triplet<double>>;

namespace law = engine::detail::law;

void into_disc(Eigen::Ref<VectorXd> tangents, double radius) {
  tangents *= law::disc_factor(tangents.squaredNorm(), radius);
}

void add_block(Entries& entries, Index row, Index column, const Eigen::MatrixXd& block) {
  for (Index i = 0; i < block.rows(); ++i)
    for (Index j = 0; j < block.cols(); ++j)
      if (block(i, j) != 0) entries.emplace_back(row + i, column + j, block(i, j));
}

// Adds rows · (linear; angular velocity) of a side, 3 x 3 each.
void add_side(Entries& entries, const ContactProblem& problem, Index row, int side, const Matrix3d& linear,
              const Matrix3d& angular) {
  if (side >= 0) {
    add_block(entries, row, 6 * side, linear);
    add_block(entries, row, 6 * side + 3, angular);
  } else {
    const SpatialMap& map = problem.machine->part_maps[part_of(side)];
    add_block(entries, row, 6 * static_cast<Index>(problem.bodies.size()),
              angular * map.topRows<3>() + linear * map.bottomRows<3>());
  }
}

Entries jacobian(const ContactProblem& problem, const MatrixForm& form) {
  Entries entries;
  const Matrix3d zero = Matrix3d::Zero();
  for (std::size_t q = 0; q < problem.pairs.size(); ++q) {
    const ContactPair& pair = problem.pairs[q];
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const ContactPoint& p = problem.points[k];
      const Matrix3d& F = form.frames[k];
      add_side(entries, problem, form.point_row(k), pair.a, -F, F * cross_matrix(p.arm_a));
      add_side(entries, problem, form.point_row(k), pair.b, F, -F * cross_matrix(p.arm_b));
    }
    const Matrix3d& F = form.frames[problem.points.size() + q];
    add_side(entries, problem, form.pair_row(q), pair.a, zero, -F);
    add_side(entries, problem, form.pair_row(q), pair.b, zero, F);
  }
  if (!problem.machine) return entries;
  for (std::size_t k = 0; k < problem.machine->rows.size(); ++k)
    add_block(entries, form.machine_begin + static_cast<Index>(k),
              6 * static_cast<Index>(problem.bodies.size()), problem.machine->rows[k].jacobian.transpose());
  return entries;
}

Entries inverse_masses(const ContactProblem& problem) {
  Entries entries;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const auto at = static_cast<Index>(6 * k);
    add_block(entries, at, at, problem.bodies[k].inverse_mass * Matrix3d::Identity());
    add_block(entries, at + 3, at + 3, problem.bodies[k].inverse_inertia);
  }
  if (problem.machine) {
    const Index freedoms = problem.machine->velocity.size(),
                at = 6 * static_cast<Index>(problem.bodies.size());
    add_block(entries, at, at, Eigen::MatrixXd::Identity(freedoms, freedoms));
  }
  return entries;
}

// Velocities before the step, or after its outer forces.
VectorXd velocities(const ContactProblem& problem, bool pushed) {
  const Index freedoms = problem.machine ? problem.machine->velocity.size() : 0;
  VectorXd x(6 * static_cast<Index>(problem.bodies.size()) + freedoms);
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const SolverBody& body = problem.bodies[k];
    x.segment<3>(6 * k) = pushed ? Vector3d(body.velocity + body.external_velocity_change) : body.velocity;
    x.segment<3>(6 * k + 3) = body.angular_velocity;
  }
  if (freedoms > 0) x.tail(freedoms) = pushed ? problem.machine->velocity : problem.machine->velocity_before;
  return x;
}

}  // namespace

MatrixForm::MatrixForm(const ContactProblem& problem) {
  const std::size_t points = problem.points.size(), pairs = problem.pairs.size();
  const std::size_t machine_rows = problem.machine ? problem.machine->rows.size() : 0;
  pairs_begin = point_row(points);
  machine_begin = pair_row(pairs);
  rows = machine_begin + static_cast<Index>(machine_rows);
  for (const ContactPoint& p : problem.points) frames.push_back(contact_frame(p.normal));
  for (const ContactPair& pair : problem.pairs)
    frames.push_back(contact_frame(pair.count > 0 ? problem.points[pair.first].normal : Vector3d::UnitX()));

  x_free = velocities(problem, true);
  J.resize(rows, x_free.size());
  const Entries in_J = jacobian(problem, *this), in_mass = inverse_masses(problem);
  J.setFromTriplets(in_J.begin(), in_J.end());
  inverse_mass.resize(x_free.size(), x_free.size());
  inverse_mass.setFromTriplets(in_mass.begin(), in_mass.end());

  const VectorXd approach = J * velocities(problem, false);
  sigma = b = start = lower = upper = VectorXd::Zero(rows);
  for (std::size_t k = 0; k < points; ++k) {
    const ContactPoint& p = problem.points[k];
    const SpookTerms terms = law::spook_terms(p, problem.step, 1);
    sigma[point_row(k)] = terms.sigma;
    b[point_row(k)] = law::bias_velocity(p.gap, approach[point_row(k)], terms.upsilon, -1 / problem.step);
    start.segment<3>(point_row(k)) = frames[k] * p.start;
  }
  for (std::size_t q = 0; q < pairs; ++q)
    start.segment<3>(pair_row(q)) = frames[points + q] * problem.pairs[q].start;
  for (std::size_t k = 0; k < machine_rows; ++k) {
    const SuperBodyRow& row = problem.machine->rows[k];
    const Index at = machine_begin + static_cast<Index>(k);
    b[at] = law::bias_velocity(row, row.gap, problem.step);
    lower[at] = row.lower;
    upper[at] = row.upper;
    start[at] = row.start;
  }
  const Eigen::SparseMatrix<double, Eigen::RowMajor> K = J * inverse_mass;
  const VectorXd response = K.cwiseProduct(J) * VectorXd::Ones(x_free.size()) + sigma;
  step_size = response.unaryExpr(&law::inverse_or_zero<double>);
  for (Index row = 0; row < machine_begin; row += 3)
    step_size.segment<2>(row + 1).setConstant(law::inverse_or_zero(response[row + 1] + response[row + 2]));
}

void MatrixForm::project(const ContactProblem& problem, VectorXd& impulses) const {
  for (std::size_t q = 0; q < problem.pairs.size(); ++q) {
    const ContactPair& pair = problem.pairs[q];
    double load = 0;
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      double& normal = impulses[point_row(k)];
      normal = std::max(0.0, normal);
      load += normal;
      into_disc(impulses.segment(point_row(k) + 1, 2), problem.points[pair.first].friction * normal);
    }
    const double limit = pair.spinning_arm * load;
    double& spin = impulses[pair_row(q)];
    spin = std::clamp(spin, -limit, limit);
    into_disc(impulses.segment(pair_row(q) + 1, 2), pair.rolling_arm * load);
  }
  for (Index row = machine_begin; row < rows; ++row)
    impulses[row] = std::clamp(impulses[row], lower[row], upper[row]);
}

VectorXd MatrixForm::errors(const VectorXd& impulses, const VectorXd& x) const {
  const VectorXd u = J * x;
  VectorXd g = u + sigma.cwiseProduct(impulses) - b;
  for (Index row = 0; row < pairs_begin; row += 3)
    g[row] = std::max(g[row], u[row] - constants::push_out_speed);
  return g;
}

SolverReport MatrixForm::store(ContactProblem& problem, const VectorXd& impulses, const VectorXd& x) const {
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    SolverBody& body = problem.bodies[k];
    body.velocity = x.segment<3>(6 * k);
    body.angular_velocity = x.segment<3>(6 * k + 3);
    body.displacement = problem.step * body.velocity;
    body.rotation_vector = problem.step * body.angular_velocity;
  }
  const std::size_t points = problem.points.size();
  for (std::size_t k = 0; k < points; ++k)
    problem.points[k].start = problem.points[k].impulse =
        frames[k].transpose() * impulses.segment<3>(point_row(k));
  for (std::size_t q = 0; q < problem.pairs.size(); ++q)
    problem.pairs[q].start = problem.pairs[q].impulse =
        frames[points + q].transpose() * impulses.segment<3>(pair_row(q));
  SolverReport report;
  if (!problem.machine) return report;
  SuperBodySolution& machine = report.machine;
  machine.velocity = machine.mean_velocity = x.tail(problem.machine->velocity.size());
  machine.row_impulses.assign(impulses.data() + machine_begin, impulses.data() + rows);
  machine.row_starts = machine.row_impulses;
  machine.part_impulses.assign(problem.machine->part_maps.size(), SpatialVector::Zero());
  const auto add = [&](int side, const Vector3d& moment, const Vector3d& impulse) {
    if (side >= 0) return;
    machine.part_impulses[part_of(side)].head<3>() += moment;
    machine.part_impulses[part_of(side)].tail<3>() += impulse;
  };
  for (const ContactPair& pair : problem.pairs) {
    add(pair.a, -pair.impulse, Vector3d::Zero());
    add(pair.b, pair.impulse, Vector3d::Zero());
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const ContactPoint& p = problem.points[k];
      add(pair.a, -p.arm_a.cross(p.impulse), -p.impulse);
      add(pair.b, p.arm_b.cross(p.impulse), p.impulse);
    }
  }
  return report;
}

}  // namespace drawpoint::benchmarks
