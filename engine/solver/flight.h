// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_problem.hpp>
#include <vector>

/// Bodies that no contact pushed in a step: they fly a parabola, exactly.
///
/// Substeps would add the outer forces' share before each of them and move the body by v t + a t²/2 (1 + 1/S): in the
/// mean of a flight nothing, but a ball that bounces would fall with other energy than it rises.
namespace drawpoint::engine::detail {

/// By body: whether a contact's impulse or moment acts on it.
inline std::vector<char> pushed_bodies(const ContactProblem& problem) {
  std::vector<char> pushed(problem.bodies.size(), 0);
  for (const ContactPair& pair : problem.pairs) {
    bool acts = !pair.impulse.isZero(0);
    for (int k = pair.first; k < pair.first + pair.count && !acts; ++k)
      acts = !problem.points[static_cast<std::size_t>(k)].impulse.isZero(0);
    if (!acts) continue;
    for (const int body : {pair.a, pair.b})
      if (body >= 0) pushed[static_cast<std::size_t>(body)] = 1;
  }
  return pushed;
}

/// `velocity`: as before the step.
inline void fly(SolverBody& body, const Eigen::Vector3d& velocity, double h) {
  body.displacement = h * (velocity + 0.5 * body.external_velocity_change);
  body.rotation_vector = h * body.angular_velocity;
  body.velocity = velocity + body.external_velocity_change;
}

}  // namespace drawpoint::engine::detail
