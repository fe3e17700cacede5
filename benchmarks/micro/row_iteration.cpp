// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/contact_law_scalar.h>
#include <algorithm>
#include <drawpoint/benchmarks/micro/row_iteration.hpp>

namespace drawpoint::benchmarks {
namespace {

using namespace engine;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

namespace law = engine::detail::law;

// Row of the matrix times x.
double product(const Rows& matrix, Index row, const Eigen::VectorXd& x) {
  double sum = 0;
  for (Rows::InnerIterator entry(matrix, row); entry; ++entry) sum += entry.value() * x[entry.col()];
  return sum;
}

// Of rows of two matrices.
double product(const Rows& a, Index row_of_a, const Rows& b, Index row_of_b) {
  double sum = 0;
  Rows::InnerIterator entry(a, row_of_a), other(b, row_of_b);
  while (entry && other) {
    if (entry.col() == other.col()) sum += entry.value() * other.value();
    const bool behind = entry.col() <= other.col();
    if (other.col() <= entry.col()) ++other;
    if (behind) ++entry;
  }
  return sum;
}

void add_row(const Rows& matrix, Index row, double factor, Eigen::VectorXd& x) {
  for (Rows::InnerIterator entry(matrix, row); entry; ++entry) x[entry.col()] += factor * entry.value();
}

// The tangents' step with the velocity that the normal's change leaves.
void step_tangents(Vector3d& impulse, const Vector3d& before, const Vector3d& u, const Matrix3d& W,
                   double limit) {
  const double dn = impulse[0] - before[0];
  law::tangent_step(impulse[1], impulse[2], u[1] + W(1, 0) * dn, u[2] + W(2, 0) * dn,
                    law::invert_tangents(W(1, 1), W(1, 2), W(2, 2)), limit);
}

}  // namespace

RowIteration::RowIteration(const ContactProblem& problem, const MatrixForm& form)
    : impulses(form.start), problem_(problem), form_(form), response_(form.J * form.inverse_mass) {
  for (Index row = 0; row < form.machine_begin; row += 3) {
    Matrix3d& W = blocks_.emplace_back();
    for (Index i = 0; i < 3; ++i)
      for (Index j = 0; j < 3; ++j) W(i, j) = product(response_, row + i, form.J, row + j);
  }
  project();
}

void RowIteration::project() {
  form_.project(problem_, impulses);
  velocities = form_.x_free + response_.transpose() * impulses;
}

Vector3d RowIteration::velocity(Index row) const {
  return {product(form_.J, row, velocities), product(form_.J, row + 1, velocities),
          product(form_.J, row + 2, velocities)};
}

void RowIteration::apply(Index row, const Vector3d& delta) {
  for (Index k = 0; k < 3; ++k)
    if (delta[k] != 0) add_row(response_, row + k, delta[k], velocities);
  impulses.segment<3>(row) += delta;
}

void RowIteration::iterate(bool forth) {
  iterate_machine();
  const std::size_t pairs = problem_.pairs.size();
  for (std::size_t k = 0; k < pairs; ++k) iterate_pair(forth ? k : pairs - 1 - k);
}

void RowIteration::iterate_machine() {
  for (Index row = form_.machine_begin; row < form_.rows; ++row) {
    const double error = product(form_.J, row, velocities) - form_.b[row], before = impulses[row];
    impulses[row] = std::clamp(before - form_.step_size[row] * error, form_.lower[row], form_.upper[row]);
    add_row(response_, row, impulses[row] - before, velocities);
  }
}

void RowIteration::iterate_pair(std::size_t index) {
  const ContactPair& pair = problem_.pairs[index];
  if (pair.count == 0) return;
  double load = 0;
  for (int k = pair.first; k < pair.first + pair.count; ++k) {
    solve_point(form_.point_row(k), problem_.points[pair.first].friction);
    load += impulses[form_.point_row(k)];
  }
  if (pair.rolling_arm > 0 || pair.spinning_arm > 0) solve_moment(index, load);
}

void RowIteration::solve_point(Index row, double friction) {
  const Matrix3d& W = blocks_[row / 3];
  const Vector3d u = velocity(row), before = impulses.segment<3>(row);
  const double sigma = form_.sigma[row];
  Vector3d after = before;
  after[0] = law::normal_step(before[0], u[0], sigma, form_.b[row], law::inverse_or_zero(W(0, 0) + sigma),
                              constants::push_out_speed);
  step_tangents(after, before, u, W, friction * after[0]);
  apply(row, after - before);
}

void RowIteration::solve_moment(std::size_t index, double load) {
  const ContactPair& pair = problem_.pairs[index];
  const Index row = form_.pair_row(index);
  const Matrix3d& W = blocks_[row / 3];
  const Vector3d u = velocity(row), before = impulses.segment<3>(row);
  Vector3d after = before;
  after[0] = law::spin_step(before[0], u[0], law::inverse_or_zero(W(0, 0)), pair.spinning_arm * load);
  step_tangents(after, before, u, W, pair.rolling_arm * load);
  apply(row, after - before);
}

}  // namespace drawpoint::benchmarks
