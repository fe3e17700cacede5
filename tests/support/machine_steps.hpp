// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/machine/machine.hpp>

/// Steps a machine by itself: no contacts, and motors and stops that are idle.
namespace drawpoint::support {

inline engine::SuperBodySolution free_solution(const engine::SuperBody& super) {
  engine::SuperBodySolution solution;
  solution.velocity = solution.mean_velocity = super.velocity;
  solution.part_impulses.assign(super.part_maps.size(), engine::SpatialVector::Zero());
  solution.row_impulses.assign(super.rows.size(), 0.0);
  solution.row_starts = solution.row_impulses;
  return solution;
}

inline void step_alone(engine::machine::Machine& machine, double h, const Eigen::Vector3d& gravity) {
  machine.advance(free_solution(machine.linearise(h, gravity)));
}

/// Sets the machine moving so that part `part` turns with `rate` about `axis` (unit vector), the other
/// freedoms at rest in the sense of least squares. An impulse of no duration: the pose moves by 1e-12 rad.
inline void set_turning(engine::machine::Machine& machine, int part, const Eigen::Vector3d& axis,
                        double rate) {
  const auto& super = machine.linearise(1e-12, Eigen::Vector3d::Zero());
  auto solution = free_solution(super);
  const Eigen::RowVectorXd row = axis.transpose() * super.part_maps[part].topRows<3>();
  solution.velocity = solution.mean_velocity = row.transpose() * (rate / row.squaredNorm());
  machine.advance(solution);
}

}  // namespace drawpoint::support
