// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <drawpoint/engine/solver/batch/batched_solver.h>

namespace drawpoint::engine::detail {
namespace {

constexpr int batches_a_block = 8, bodies_a_block = 256;  // that a thread claims at a time: microseconds

Eigen::Vector3d vector(const float (&v)[4]) { return {v[0], v[1], v[2]}; }

// A body in free flight, exactly as the substeps would move it.
void fly(SolverBody& body, double h, int substeps) {
  body.travel = h * (body.velocity + (substeps + 1) / (2.0 * substeps) * body.push);
  body.turn = h * body.angular_velocity;
  body.velocity += body.push;
}

}  // namespace

SolverReport ColouredSolver::solve(ContactProblem& problem) {
  const Parallel::Shift shift(*parallel_);
  problem_ = &problem;
  batches_.fill(problem, sweep_order(problem, batch_lanes, pairs_a_zone, *parallel_), options_.substeps,
                *parallel_);
  machine_.emplace(problem, batches_.row_of, options_.substeps);
  threads_ = std::min(parallel_->threads(), most_parts());
  travel_.assign(problem.bodies.size(), BodyRow());
  everywhere([this](BatchRange range) { prepare_batches(batches_.arrays(), range); });
  for (int s = 0; s < options_.substeps; ++s) run_substep(s);
  each_row([this](int row) { travel(row); });
  SolverReport solved = report();
  store_bodies();
  batches_.store(problem, options_.substeps, *parallel_);
  solved.machine = machine_->store(problem);
  return solved;
}

SolverReport ColouredSolver::report() {
  SolverReport solved;
  const double load = normal_load();
  if (load > 0) solved.last_change = change() / load;
  everywhere([this](BatchRange range) { judge_batches(batches_.arrays(), range); });
  Misfit sum = batches_.misfit();
  const Misfit machine = machine_->misfit(batches_.bodies);
  sum.normal += machine.normal;
  sum.tangent += machine.tangent;
  sum.load += machine.load;
  report_misfit(sum, solved);
  return solved;
}

template <class Kernel>
void ColouredSolver::everywhere(const Kernel& kernel) {
  const int batches = batches_.count();
  parallel_->run((batches + batches_a_block - 1) / batches_a_block, threads_, [&](int block) {
    kernel(BatchRange{block * batches_a_block, std::min((block + 1) * batches_a_block, batches)});
  });
}

template <class Kernel>
void ColouredSolver::each_stage(bool forward, const Kernel& kernel) {
  const SweepOrder& order = batches_.order();
  const int stages = static_cast<int>(order.stages.size()) - 1;
  for (int k = 0; k < stages; ++k) {
    const int stage = forward ? k : stages - 1 - k, first = order.stages[stage];
    parallel_->run(order.stages[stage + 1] - first, threads_, [&](int part) {
      kernel(BatchRange{order.parts[first + part], order.parts[first + part + 1], forward});
    });
  }
}

// Of a stage: more threads than that would wait in the sweeps, which are most of the work.
int ColouredSolver::most_parts() const {
  const std::vector<int>& stages = batches_.order().stages;
  int most = 1;
  for (std::size_t k = 0; k + 1 < stages.size(); ++k) most = std::max(most, stages[k + 1] - stages[k]);
  return most;
}

template <class Work>
void ColouredSolver::each_row(const Work& work) {
  const int bodies = static_cast<int>(problem_->bodies.size());
  parallel_->run((bodies + bodies_a_block - 1) / bodies_a_block, threads_, [&](int block) {
    const int last = std::min(bodies, (block + 1) * bodies_a_block);
    for (int k = block * bodies_a_block; k < last; ++k) work(k);
  });
}

void ColouredSolver::run_substep(int number) {
  machine_->refresh(batches_.bodies);
  if (number == 0)
    start();
  else
    extrapolate();
  const int most = most_sweeps(options_, problem_->points.size());
  const bool hands_over = number + 1 < options_.substeps;
  Sweep this_sweep{substep(), true, false, number == 0};
  for (int k = 0; k < most; ++k, this_sweep.first = false) {
    const bool converged = k >= options_.sweeps && change() <= options_.tolerance * normal_load();
    if (converged) break;
    this_sweep.last = hands_over && k + 1 == most;
    sweep(k % 2 == 0, this_sweep);
  }
  if (hands_over && !this_sweep.last)
    each_stage(true, [this](BatchRange range) { hand_over_batches(batches_.arrays(), range); });
  machine_->finish();
}

void ColouredSolver::start() {
  each_row([this](int row) {
    const SolverBody& body = problem_->bodies[batches_.order().bodies[row]];
    for (int i = 0; i < 3; ++i)
      batches_.bodies[row].velocity[i] += static_cast<float>(body.push[i] / options_.substeps);
  });
  machine_->start(batches_.bodies);
  each_stage(true, [this](BatchRange range) { start_batches(batches_.arrays(), range); });
}

// What changed a body in the last substep acts again: outer forces and contact impulses, but for blows.
void ColouredSolver::extrapolate() {
  machine_->extrapolate();
  each_row([this](int row) {
    travel(row);
    BodyRow &now = batches_.bodies[row], &begin = batches_.begin[row],
            &correction = batches_.corrections[row];
    const BodyRow end = now;
    for (int i = 0; i < 4; ++i) {
      now.velocity[i] = 2 * end.velocity[i] - begin.velocity[i] + correction.velocity[i];
      now.angular_velocity[i] =
          2 * end.angular_velocity[i] - begin.angular_velocity[i] + correction.angular_velocity[i];
    }
    begin = end;
    correction = BodyRow();
  });
  machine_->correct(batches_.bodies);
}

void ColouredSolver::sweep(bool forward, const Sweep& this_sweep) {
  machine_change_ = machine_->sweep(batches_.bodies, forward);
  each_stage(forward, [&](BatchRange range) { sweep_batches(batches_.arrays(), range, this_sweep); });
}

// The way of the substep that has ended.
void ColouredSolver::travel(int row) {
  const float h = substep();
  for (int i = 0; i < 4; ++i) {
    travel_[row].velocity[i] += h * batches_.bodies[row].velocity[i];
    travel_[row].angular_velocity[i] += h * batches_.bodies[row].angular_velocity[i];
  }
}

void ColouredSolver::store_bodies() {
  touched_.assign(problem_->bodies.size(), 0);
  for (const ContactPair& pair : problem_->pairs)
    for (const int body : {pair.a, pair.b})
      if (body >= 0) touched_[body] = 1;
  parallel_->blocks(static_cast<int>(problem_->bodies.size()), bodies_a_block, [this](int first, int last) {
    for (int body = first; body < last; ++body) store_body(body);
  });
}

void ColouredSolver::store_body(int index) {
  SolverBody& body = problem_->bodies[index];
  if (!touched_[index]) return fly(body, problem_->step, options_.substeps);
  const int row = batches_.row_of[index];
  body.velocity = vector(batches_.bodies[row].velocity);
  body.angular_velocity = vector(batches_.bodies[row].angular_velocity);
  body.travel = vector(travel_[row].velocity);
  body.turn = vector(travel_[row].angular_velocity);
}

}  // namespace drawpoint::engine::detail
