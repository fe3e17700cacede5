// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/problem_sizes.h>
#include <drawpoint/engine/solver/received_impulses.h>
#include <cassert>

namespace drawpoint::engine::detail {

using Eigen::Vector3d;

ReceivedImpulses received_impulses(const ContactProblem& problem, const SuperBodySolution& machine,
                                   const ImpulseChoice& choice) {
  assert(sides_exist(problem) && "each side of a pair is a body or a part of the machine");
  ReceivedImpulses sum;
  sum.linear.assign(problem.bodies.size(), Vector3d::Zero());
  sum.angular.assign(problem.bodies.size(), Vector3d::Zero());
  std::vector<SpatialVector> parts;
  if (problem.machine) parts.assign(problem.machine->part_maps.size(), SpatialVector::Zero());
  const auto add = [&](int side, const Vector3d& moment, const Vector3d& impulse) {
    if (side < 0) {
      parts[part_of(side)].head<3>() += moment;
      parts[part_of(side)].tail<3>() += impulse;
    } else {
      sum.linear[side] += impulse;
      sum.angular[side] += moment;
    }
  };
  for (const ContactPair& pair : problem.pairs) {
    const Vector3d moment = choice.factor * pair.*choice.pair;
    add(pair.a, -moment, Vector3d::Zero());
    add(pair.b, moment, Vector3d::Zero());
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const ContactPoint& p = problem.points[k];
      const Vector3d impulse = choice.factor * p.*choice.point;
      add(pair.a, -p.arm_a.cross(impulse), -impulse);
      add(pair.b, p.arm_b.cross(impulse), impulse);
    }
  }
  if (!problem.machine) return sum;
  const SuperBody& super = *problem.machine;
  assert((machine.*choice.rows).size() == super.rows.size() && "one impulse per row of the machine");
  sum.machine = Eigen::VectorXd::Zero(super.velocity.size());
  for (std::size_t p = 0; p < parts.size(); ++p) sum.machine += super.part_maps[p].transpose() * parts[p];
  for (std::size_t k = 0; k < super.rows.size(); ++k)
    sum.machine += choice.factor * (machine.*choice.rows)[k] * super.rows[k].jacobian;
  return sum;
}

}  // namespace drawpoint::engine::detail
