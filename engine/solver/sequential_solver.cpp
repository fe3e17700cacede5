// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/flight.h>
#include <drawpoint/engine/solver/momentum.h>
#include <drawpoint/engine/solver/motion_change.h>
#include <drawpoint/engine/solver/sequential_iteration.h>
#include <drawpoint/engine/solver/sequential_solver.h>

namespace drawpoint::engine {
namespace {

struct Motion {
  Eigen::Vector3d velocity, angular_velocity;
};

void add_push(std::vector<SolverBody>& bodies, int substeps) {
  for (SolverBody& body : bodies) body.velocity += body.external_velocity_change / substeps;
}

// What changed a body in the last substep acts again: outer forces and contact impulses.
void extrapolate(std::vector<SolverBody>& bodies, const std::vector<Motion>& begin) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    bodies[k].velocity = 2 * bodies[k].velocity - begin[k].velocity;
    bodies[k].angular_velocity = 2 * bodies[k].angular_velocity - begin[k].angular_velocity;
  }
}

void add_momentum(std::vector<SolverBody>& bodies, double share, std::vector<Motion>& previous) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    SolverBody& body = bodies[k];
    const Motion without{body.velocity, body.angular_velocity};
    if (share > 0) {
      body.velocity += share * (body.velocity - previous[k].velocity);
      body.angular_velocity += share * (body.angular_velocity - previous[k].angular_velocity);
    }
    previous[k] = without;
  }
}

// Since `last`, which becomes the present motion.
double motion_change(const std::vector<SolverBody>& bodies, const std::vector<detail::MotionWeight>& weights,
                     std::vector<Motion>& last) {
  double sum = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    sum += weights[k].mass * (bodies[k].velocity - last[k].velocity).lpNorm<1>() +
           weights[k].turning * (bodies[k].angular_velocity - last[k].angular_velocity).lpNorm<1>();
    last[k] = {bodies[k].velocity, bodies[k].angular_velocity};
  }
  return sum;
}

SolverReport solve(ContactProblem& problem, const SolverOptions& options, bool directly) {
  const double h = problem.step / options.substeps;
  for (SolverBody& body : problem.bodies) body.displacement.setZero(), body.rotation_vector.setZero();
  detail::SequentialIteration iteration(problem, options.substeps);
  std::vector<Motion> begin(problem.bodies.size()), now(problem.bodies.size()),
      previous(problem.bodies.size()), last(problem.bodies.size());
  std::vector<detail::MotionWeight> weights;
  for (const SolverBody& body : problem.bodies) weights.push_back(detail::MotionWeight::of(body));
  double change = 0, moved = 0;
  SolverReport report;
  for (int s = 0; s < options.substeps; ++s) {
    iteration.refresh();
    for (std::size_t k = 0; k < now.size(); ++k)
      now[k] = {problem.bodies[k].velocity, problem.bodies[k].angular_velocity};
    if (s == 0) {
      add_push(problem.bodies, options.substeps);
      iteration.start();
    } else {
      extrapolate(problem.bodies, begin);
      iteration.extrapolate();
      iteration.correct();
    }
    begin.swap(now);
    motion_change(problem.bodies, weights, last);
    iteration.machine_moved();
    for (int k = 0; goes_on(options, problem.points.size(), k, moved, iteration.normal_load()); ++k) {
      if (detail::remembers(k)) {
        add_momentum(problem.bodies, detail::momentum_of(k), previous);
        iteration.add_momentum(detail::momentum_of(k));
      }
      change = iteration.iteration();
      moved = motion_change(problem.bodies, weights, last) + iteration.machine_moved();
      ++report.iterations;
    }
    if (directly) iteration.solve_directly();
    iteration.finish();
    for (SolverBody& body : problem.bodies) {
      body.displacement += h * body.velocity;
      body.rotation_vector += h * body.angular_velocity;
    }
  }
  const double load = iteration.normal_load();
  if (load > 0) report.last_change = change / load;
  detail::report_residual(iteration.residual_sums(), report);
  report.machine = iteration.store();
  const std::vector<char> pushed = detail::pushed_bodies(problem);
  for (std::size_t k = 0; k < pushed.size(); ++k) {
    SolverBody& body = problem.bodies[k];
    if (!pushed[k]) detail::fly(body, body.velocity - body.external_velocity_change, problem.step);
  }
  return report;
}

}  // namespace

SolverReport solve_sequentially(ContactProblem& problem, const SolverOptions& options) {
  return solve(problem, options, false);
}

SolverReport solve_directly(ContactProblem& problem, const SolverOptions& options) {
  return solve(problem, options, true);
}

}  // namespace drawpoint::engine
