// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <drawpoint/engine/contact/coloured_solver.hpp>

namespace drawpoint::engine::contact::detail {
namespace {

constexpr int batches_a_block = 3, bodies_a_block = 256;  // that a thread claims at a time: microseconds

Eigen::Vector3d vector(const float (&v)[4]) { return {v[0], v[1], v[2]}; }

// A body in free flight, exactly as the substeps would move it.
void fly(SolverBody& body, double h, int substeps) {
  body.travel = h * (body.velocity + (substeps + 1) / (2.0 * substeps) * body.push);
  body.turn = h * body.angular_velocity;
  body.velocity += body.push;
}

}  // namespace

SolverReport ColouredSolver::solve(ContactProblem& problem) {
  problem_ = &problem;
  batches_.fill(problem, colour(problem, batch_lanes), options_.substeps, parallel_);
  machine_.emplace(problem, options_.substeps);
  team_.emplace(options_.threads);
  travel_.assign(problem.bodies.size(), BodyRow());
  everywhere([this](BatchRange range) { prepare_batches(batches_.arrays(), range); });
  for (int s = 0; s < options_.substeps; ++s) run_substep(s);
  each_body([this](int k) { travel(k); });
  SolverReport solved = report();
  store_bodies();
  team_.reset();
  batches_.store(problem, options_.substeps, parallel_);
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
void ColouredSolver::over(BatchRange range, const Kernel& kernel) {
  const int blocks = (range.end - range.begin + batches_a_block - 1) / batches_a_block;
  if (options_.threads == 1 || blocks < 2) return kernel(range);
  team_->run(blocks, [&](int block) {
    const int begin = range.begin + block * batches_a_block;
    kernel(BatchRange{begin, std::min(begin + batches_a_block, range.end)});
  });
}

template <class Kernel>
void ColouredSolver::everywhere(const Kernel& kernel) {
  over({0, batches_.count()}, kernel);
}

template <class Work>
void ColouredSolver::each_body(const Work& work) {
  const int bodies = static_cast<int>(problem_->bodies.size());
  team_->run((bodies + bodies_a_block - 1) / bodies_a_block, [&](int block) {
    const int last = std::min(bodies, (block + 1) * bodies_a_block);
    for (int k = block * bodies_a_block; k < last; ++k) work(k);
  });
}

template <class Kernel>
void ColouredSolver::each_colour(bool forward, const Kernel& kernel) {
  const std::vector<BatchRange>& colours = batches_.colours();
  for (std::size_t c = 0; c < colours.size(); ++c)
    over(colours[forward ? c : colours.size() - 1 - c], kernel);
}

void ColouredSolver::run_substep(int number) {
  machine_->refresh(batches_.bodies);
  if (number == 0)
    start();
  else
    extrapolate();
  const int most = most_sweeps(options_, problem_->points.size());
  const bool hands_over = number + 1 < options_.substeps;
  Sweep of{substep(), true, false, number == 0};
  for (int k = 0; k < most; ++k, of.first = false) {
    const bool converged = k >= options_.sweeps && change() <= options_.tolerance * normal_load();
    if (converged) break;
    of.last = hands_over && k + 1 == most;
    sweep(k % 2 == 0, of);
  }
  if (hands_over && !of.last)
    each_colour(true, [this](BatchRange range) { hand_over_batches(batches_.arrays(), range); });
  machine_->finish();
}

void ColouredSolver::start() {
  for (std::size_t k = 0; k < problem_->bodies.size(); ++k)
    for (int i = 0; i < 3; ++i)
      batches_.bodies[k].velocity[i] += static_cast<float>(problem_->bodies[k].push[i] / options_.substeps);
  machine_->start(batches_.bodies);
  each_colour(true, [this](BatchRange range) { start_batches(batches_.arrays(), range); });
}

// What changed a body in the last substep acts again: outer forces and contact impulses, but for blows.
void ColouredSolver::extrapolate() {
  machine_->extrapolate();
  each_body([this](int k) {
    travel(k);
    BodyRow &now = batches_.bodies[k], &begin = batches_.begin[k], &correction = batches_.corrections[k];
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

void ColouredSolver::sweep(bool forward, const Sweep& of) {
  machine_change_ = machine_->sweep(batches_.bodies, forward);
  each_colour(forward, [&](BatchRange range) { sweep_batches(batches_.arrays(), range, of); });
}

// The way of the substep that has ended.
void ColouredSolver::travel(int body) {
  const float h = substep();
  for (int i = 0; i < 4; ++i) {
    travel_[body].velocity[i] += h * batches_.bodies[body].velocity[i];
    travel_[body].angular_velocity[i] += h * batches_.bodies[body].angular_velocity[i];
  }
}

void ColouredSolver::store_bodies() {
  touched_.assign(problem_->bodies.size(), 0);
  for (const ContactPair& pair : problem_->pairs)
    for (const int body : {pair.a, pair.b})
      if (body >= 0) touched_[body] = 1;
  each_body([this](int k) {
    SolverBody& body = problem_->bodies[k];
    if (!touched_[k]) return fly(body, problem_->step, options_.substeps);
    body.velocity = vector(batches_.bodies[k].velocity);
    body.angular_velocity = vector(batches_.bodies[k].angular_velocity);
    body.travel = vector(travel_[k].velocity);
    body.turn = vector(travel_[k].angular_velocity);
  });
}

}  // namespace drawpoint::engine::contact::detail
