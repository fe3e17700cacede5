// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/base/cross_matrix.h>
#include <drawpoint/engine/solver/contact_frame.h>
#include <drawpoint/engine/solver/contact_law_scalar.h>
#include <drawpoint/engine/solver/super_body_motion.h>
#include <algorithm>
#include <cassert>
#include <limits>

namespace drawpoint::engine::detail {
namespace {

// An impulse λ on a part changes its speed along a row R by |R|² λ: along its easiest axis it has the mass 1/|R|²,
// and where it turns on the spot that of its inertia a metre away.
double heaviest_root_mass(const SuperBody& machine) {
  constexpr double least_share =
      1e-3;  // of the row of the part that gives way most: no part is a million times as heavy
  double most = 0, least = std::numeric_limits<double>::infinity();
  for (const SpatialMap& map : machine.part_maps) {
    const double easiest = map.rowwise().norm().maxCoeff();
    if (easiest > 0) most = std::max(most, easiest), least = std::min(least, easiest);
  }
  return most > 0 ? 1 / std::max(least, least_share * most) : 0;
}

}  // namespace

SuperBodyMotion::SuperBodyMotion(const SuperBody* machine, double step, int substeps)
    : machine_(machine), step_(step), h_(step / substeps), substeps_(substeps) {
  if (!machine) return;
  w_ = begin_ = watched_ = machine->velocity_before;
  root_mass_ = heaviest_root_mass(*machine);
  push_ = (machine->velocity - machine->velocity_before) / substeps;
  travel_ = Eigen::VectorXd::Zero(w_.size());
  for (const SuperBodyRow& row : machine->rows) {
    const double square = row.jacobian.squaredNorm();
    rows_.push_back({law::inverse_or_zero(square), std::clamp(row.start, row.lower, row.upper) / substeps});
  }
}

int SuperBodyMotion::add_rows(int part, const Eigen::Vector3d& arm, const Eigen::Matrix3d& axes) {
  assert(machine_ && part >= 0 && part < static_cast<int>(machine_->part_maps.size()) &&
         "a part of the machine");
  const SpatialMap& map = machine_->part_maps[part];
  return add(axes * (map.bottomRows<3>() - cross_matrix(arm) * map.topRows<3>()));
}

int SuperBodyMotion::add_angular_rows(int part, const Eigen::Matrix3d& axes) {
  return add(axes * machine_->part_maps[part].topRows<3>());
}

int SuperBodyMotion::add(const Eigen::Matrix<double, 3, Eigen::Dynamic>& rows) {
  const auto index = part_rows_.size() / static_cast<std::size_t>(std::max<Eigen::Index>(1, rows.size()));
  part_rows_.insert(part_rows_.end(), rows.data(), rows.data() + rows.size());
  return static_cast<int>(index);
}

void SuperBodyMotion::set_bias_velocities() {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const SuperBodyRow& row = machine_->rows[k];
    rows_[k].target = law::bias_velocity(row, row.gap + row.jacobian.dot(travel_), h_);
  }
}

void SuperBodyMotion::start() {
  w_ += push_;
  for (std::size_t k = 0; k < rows_.size(); ++k) w_ += machine_->rows[k].jacobian * rows_[k].impulse;
}

void SuperBodyMotion::extrapolate() {
  const Eigen::VectorXd next = 2 * w_ - begin_;
  begin_ = w_;
  w_ = next;
}

void SuperBodyMotion::add_momentum(double share) {
  const Eigen::VectorXd without = w_;
  if (share > 0) w_ += share * (w_ - previous_);
  previous_ = without;
  for (Row& row : rows_) {
    const double impulse = row.impulse;
    if (share > 0) row.impulse += share * (impulse - row.previous);
    row.previous = impulse;
  }
}

void SuperBodyMotion::iteration() {
  assert((!machine_ || rows_.size() == machine_->rows.size()) && "a step per row of the machine");
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const SuperBodyRow& row = machine_->rows[k];
    Row& r = rows_[k];
    const double rest = row.jacobian.dot(w_) - r.target;
    const double next =
        std::clamp(r.impulse - r.inverse * rest, row.lower / substeps_, row.upper / substeps_);
    const double delta = next - r.impulse;
    if (delta == 0) continue;
    r.impulse = next;
    w_.noalias() += row.jacobian * delta;
  }
}

double SuperBodyMotion::moved() {
  if (!machine_) return 0;
  const double moved = root_mass_ * (w_ - watched_).norm();
  watched_ = w_;
  return moved;
}

void SuperBodyMotion::finish() {
  travel_ += h_ * w_;
  for (Row& row : rows_) row.total += row.impulse;
}

// Not by |w|: it counts mass, and what weighs 50 t would never stand.
bool SuperBodyMotion::slower(const Eigen::VectorXd& w, double speed) const {
  return !machine_ ||
         std::all_of(machine_->part_maps.begin(), machine_->part_maps.end(),
                     [&](const SpatialMap& map) { return (map * w).cwiseAbs().maxCoeff() <= speed; });
}

void SuperBodyMotion::repeat(int substeps) {
  travel_ += substeps * h_ * w_;
  for (Row& row : rows_) row.total += substeps * row.impulse;
}

SuperBodySolution SuperBodyMotion::store() const {
  SuperBodySolution solution;
  if (!machine_) return solution;
  solution.velocity = w_;
  solution.mean_velocity = travel_ / step_;
  solution.steady_share = 0.5 * (1 + 1.0 / substeps_);
  for (const Row& row : rows_) {
    solution.row_impulses.push_back(row.total);
    solution.row_starts.push_back(substeps_ * row.impulse);
  }
  solution.part_impulses.assign(machine_->part_maps.size(), SpatialVector::Zero());
  return solution;
}

}  // namespace drawpoint::engine::detail
