// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/received_impulses.h>
#include <cassert>
#include <cmath>
#include <drawpoint/engine/solver/solution_distance.hpp>

namespace drawpoint::engine {
namespace {

using Eigen::Vector3d;

// Twice the kinetic energy of a change of velocity.
double kinetic(const SolverBody& body, const Vector3d& v, const Vector3d& w) {
  double sum = body.inverse_mass > 0 ? v.squaredNorm() / body.inverse_mass : 0.0;
  if (body.inverse_inertia.determinant() > 0) sum += w.dot(body.inverse_inertia.inverse() * w);
  return sum;
}

double contact_energy(const ContactProblem& problem, const SuperBodySolution& machine) {
  const auto received = received_impulses(problem, machine, detail::of_the_step);
  double sum = problem.machine ? received.machine.squaredNorm() : 0.0;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const SolverBody& body = problem.bodies[k];
    sum += body.inverse_mass * received.linear[k].squaredNorm() +
           received.angular[k].dot(body.inverse_inertia * received.angular[k]);
  }
  return sum;
}

double relative(double off, double all) { return std::sqrt(all > 0 ? off / all : off); }

}  // namespace

Distance distance(const ContactProblem& from, const SuperBodySolution& from_machine, const ContactProblem& to,
                  const SuperBodySolution& to_machine) {
  assert(from.points.size() == to.points.size() && from.bodies.size() == to.bodies.size() &&
         "two solutions of one problem");
  double off = 0, all = 0;
  for (std::size_t k = 0; k < to.points.size(); ++k) {
    off += (from.points[k].impulse - to.points[k].impulse).squaredNorm();
    all += to.points[k].impulse.squaredNorm();
  }
  double moved = to.machine ? (from_machine.velocity - to_machine.velocity).squaredNorm() : 0.0;
  for (std::size_t k = 0; k < to.bodies.size(); ++k)
    moved += kinetic(to.bodies[k], from.bodies[k].velocity - to.bodies[k].velocity,
                     from.bodies[k].angular_velocity - to.bodies[k].angular_velocity);
  return {relative(off, all), relative(moved, contact_energy(to, to_machine))};
}

double momentum_defect(const ContactProblem& unsolved, const ContactProblem& solved,
                       const SuperBodySolution& machine) {
  const auto received = received_impulses(solved, machine, detail::of_the_step);
  double off =
      solved.machine ? (machine.velocity - unsolved.machine->velocity - received.machine).squaredNorm() : 0.0;
  for (std::size_t k = 0; k < solved.bodies.size(); ++k) {
    const SolverBody &before = unsolved.bodies[k], &after = solved.bodies[k];
    off += kinetic(
        after,
        after.velocity - before.velocity - before.external_velocity_change -
            after.inverse_mass * received.linear[k],
        after.angular_velocity - before.angular_velocity - after.inverse_inertia * received.angular[k]);
  }
  return relative(off, contact_energy(solved, machine));
}

}  // namespace drawpoint::engine
