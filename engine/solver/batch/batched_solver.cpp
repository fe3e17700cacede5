// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/batch/batched_solver.h>
#include <drawpoint/engine/solver/flight.h>
#include <drawpoint/engine/solver/momentum.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace drawpoint::engine::detail {
namespace {

constexpr double last_bit = 0x1p-23;  // of single precision

Eigen::Vector3d vector(const float (&v)[4]) { return {v[0], v[1], v[2]}; }

using Four = Eigen::Array4f;

Four four(const float (&v)[4]) { return Eigen::Map<const Four, Eigen::Aligned16>(v); }

// By how much velocities, angular velocities differ from `before`, which they become, and how large they are.
struct Watched {
  Four moved = Four::Zero(), size = Four::Zero();

  [[gnu::always_inline]] void add(const float (&now)[4], float (&before)[4], const float (&weight)[4]) {
    moved += four(weight) * (four(now) - four(before)).abs();
    size += four(weight) * four(now).abs();
    Eigen::Map<Four, Eigen::Aligned16>{before} = four(now);
  }
};

}  // namespace

SolverReport BatchedSolver::solve(ContactProblem& problem) {
  const ThreadPool::Region region(*pool_);
  problem_ = &problem;
  batches_.fill(problem, iteration_order(problem, batch_lanes, constants::pairs_per_subdomain, *pool_),
                options_.substeps, *pool_);
  machine_.emplace(problem, batches_.row_of, options_.substeps);
  threads_ = std::min(pool_->threads(), most_parts());
  travel_.assign(problem.bodies.size(), BodyRow());
  previous_.resize(problem.bodies.size());
  everywhere([this](BatchRange range) { prepare_batches(batches_.arrays(), range); });
  find_touched();
  if (watches()) weigh();
  iterations_ = 0;
  run_substep(0);
  const bool standing = stands();
  for (int s = 1; s < options_.substeps && !standing; ++s) run_substep(s);
  if (standing) stand();
  assert(batches_.row_of.size() == problem.bodies.size() && "each body has a row");
  each_row([this](int row) { displacement(row); });
  SolverReport solved = report();
  batches_.store(problem, options_.substeps, *pool_);
  solved.machine = machine_->store(problem);
  pushed_ = pushed_bodies(problem);
  store_bodies();
  return solved;
}

SolverReport BatchedSolver::report() {
  SolverReport solved;
  solved.iterations = iterations_;
  const double load = normal_load();
  if (load > 0) solved.last_change = change() / load;
  everywhere([this](BatchRange range) { evaluate_batches(batches_.arrays(), range); });
  ResidualSums sum = batches_.residual_sums();
  const ResidualSums machine = machine_->residual_sums(batches_.bodies);
  sum.normal += machine.normal;
  sum.tangent += machine.tangent;
  sum.load += machine.load;
  report_residual(sum, solved);
  return solved;
}

template <class Kernel>
void BatchedSolver::everywhere(const Kernel& kernel) {
  const int batches = batches_.count();
  pool_->run((batches + batches_per_block - 1) / batches_per_block, threads_, [&](int block) {
    kernel(BatchRange{block * batches_per_block, std::min((block + 1) * batches_per_block, batches)});
  });
}

template <class Kernel>
void BatchedSolver::each_stage(const Kernel& kernel) {
  const IterationOrder& order = batches_.order();
  for (std::size_t stage = 0; stage + 1 < order.stages.size(); ++stage) {
    const int first = order.stages[stage];
    pool_->run(order.stages[stage + 1] - first, threads_, [&](int part) {
      kernel(BatchRange{order.tasks[first + part], order.tasks[first + part + 1]});
    });
  }
}

// The most parts of a stage: more threads than that would wait in the iterations, which are most of the work.
int BatchedSolver::most_parts() const {
  const std::vector<int>& stages = batches_.order().stages;
  int most = 1;
  for (std::size_t k = 0; k + 1 < stages.size(); ++k) most = std::max(most, stages[k + 1] - stages[k]);
  return most;
}

template <class Work>
void BatchedSolver::each_block_of_rows(const Work& work) {
  const int bodies = static_cast<int>(problem_->bodies.size());
  pool_->run((bodies + bodies_per_block - 1) / bodies_per_block, threads_, [&](int block) {
    work(block * bodies_per_block, std::min(bodies, (block + 1) * bodies_per_block));
  });
}

template <class Work>
void BatchedSolver::each_row(const Work& work) {
  each_block_of_rows([&](int first, int last) {
    for (int row = first; row < last; ++row) work(row);
  });
}

void BatchedSolver::run_substep(int number) {
  machine_->refresh(batches_.bodies);
  if (number == 0)
    start();
  else
    extrapolate();
  const int most = most_iterations(options_, problem_->points.size());
  const bool hands_over = number + 1 < options_.substeps;
  Iteration this_iteration{substep(), true, false, number == 0};
  if (watches()) begin_to_watch();
  for (int k = 0; goes_on(options_, problem_->points.size(), k, motion_change_, normal_load());
       ++k, this_iteration.first = false) {
    this_iteration.last = hands_over && k + 1 == most;
    if (most > 1) add_momentum(k, this_iteration);
    iteration(this_iteration);
    if (watches()) watch();
  }
  if (hands_over && !this_iteration.last)
    each_stage([this](BatchRange range) { end_substep_batches(batches_.arrays(), range); });
  machine_->finish();
}

// Only where more iterations than asked for may be made does it matter what one changes.
bool BatchedSolver::watches() const {
  return most_iterations(options_, problem_->points.size()) > options_.iterations;
}

void BatchedSolver::weigh() {
  weights_.resize(problem_->bodies.size());
  watched_.resize(problem_->bodies.size());
  each_row([this](int row) {
    const MotionWeight weight = MotionWeight::of(problem_->bodies[batches_.order().bodies[row]]);
    for (int i = 0; i < 3; ++i)
      weights_[row].velocity[i] = weight.mass, weights_[row].angular_velocity[i] = weight.turning;
  });
}

void BatchedSolver::begin_to_watch() {
  std::copy_n(batches_.bodies.begin(), watched_.size(), watched_.begin());
  machine_->moved();
}

void BatchedSolver::watch() {
  changes_.assign(weights_.size() / bodies_per_block + 1, MotionChange());
  each_block_of_rows([this](int first, int last) {
    Watched watched;
    for (int row = first; row < last; ++row) {
      const BodyRow &now = batches_.bodies[row], &weight = weights_[row];
      watched.add(now.velocity, watched_[row].velocity, weight.velocity);
      watched.add(now.angular_velocity, watched_[row].angular_velocity, weight.angular_velocity);
    }
    changes_[static_cast<std::size_t>(first / bodies_per_block)] = {watched.moved.sum(),
                                                                    watched.size.sum() * last_bit};
  });
  MotionChange sum;
  for (const MotionChange& change : changes_) sum += change;
  motion_change_ = sum.beyond() + machine_->moved();
}

// Whether the first substep has left everything as it was: then so will the others. Bodies in free flight do
// not count, and a machine that touches nothing that moves is on its own: the pile stands while it drives by.
bool BatchedSolver::stands() const {
  if (options_.substeps == 1) return false;
  const bool alone = !machine_->touches_bodies();
  if (!alone && !machine_->stands(constants::standing_speed)) return false;
  const double changed = alone ? batches_.change() : change(),
               load = alone ? batches_.normal_load() : normal_load();
  if (changed > constants::standing_change * load) return false;
  return bodies_stand(batches_.begin) && bodies_stand(batches_.bodies);
}

bool BatchedSolver::bodies_stand(const std::vector<BodyRow>& rows) const {
  double squares = 0;
  int count = 0;
  for (std::size_t row = 0; row < problem_->bodies.size(); ++row) {
    if (!touched_[static_cast<std::size_t>(batches_.order().bodies[row])]) continue;
    double fastest = 0;  // of linear and angular velocity by component
    for (int i = 0; i < 3; ++i)
      fastest = std::max<double>(
          {fastest, std::abs(rows[row].velocity[i]), std::abs(rows[row].angular_velocity[i])});
    if (!(fastest <= constants::standing_speed_of_one)) return false;
    squares += fastest * fastest, ++count;
  }
  return squares <= count * constants::standing_speed * constants::standing_speed;
}

// The other substeps, with the impulses of the first. What little speed there is would grow by round-off, since the
// substeps that damp it are not made: it is taken away.
void BatchedSolver::stand() {
  const int left = options_.substeps - 1;
  everywhere([&](BatchRange range) { repeat_batches(batches_.arrays(), range, left - 1); });
  each_row([&](int row) { batches_.bodies[row] = BodyRow(); });
  if (machine_->stands(constants::standing_speed))
    machine_->repeat(left);
  else
    for (int s = 1; s <= left; ++s) run_machine_alone();
}

void BatchedSolver::run_machine_alone() {
  machine_->refresh(batches_.bodies);
  machine_->extrapolate();
  machine_->correct(batches_.bodies);
  machine_->moved();
  double moved = 0;
  for (int k = 0; goes_on(options_, machine_->points(), k, moved, machine_->normal_load()); ++k) {
    if (remembers(k)) machine_->add_momentum(momentum_of(k));
    machine_change_ = machine_->iteration(batches_.bodies);
    moved = machine_->moved();
  }
  machine_->finish();
}

void BatchedSolver::add_momentum(int k, Iteration& iteration) {
  iteration.remember = remembers(k);
  iteration.momentum = iteration.remember ? static_cast<float>(momentum_of(k)) : 0;
  if (!iteration.remember) return;
  each_row([&](int row) {
    BodyRow &now = batches_.bodies[row], &previous = previous_[row];
    const BodyRow without = now;
    for (int i = 0; i < 4 && k > 0; ++i) {
      now.velocity[i] += iteration.momentum * (now.velocity[i] - previous.velocity[i]);
      now.angular_velocity[i] +=
          iteration.momentum * (now.angular_velocity[i] - previous.angular_velocity[i]);
    }
    previous = without;
  });
  machine_->add_momentum(momentum_of(k));
}

void BatchedSolver::start() {
  each_row([this](int row) {
    const SolverBody& body = problem_->bodies[batches_.order().bodies[row]];
    for (int i = 0; i < 3; ++i)
      batches_.bodies[row].velocity[i] +=
          static_cast<float>(body.external_velocity_change[i] / options_.substeps);
  });
  machine_->start(batches_.bodies);
  each_stage([this](BatchRange range) { start_batches(batches_.arrays(), range); });
}

// What changed a body in the last substep acts again: outer forces and contact impulses, but for impacts.
void BatchedSolver::extrapolate() {
  machine_->extrapolate();
  each_row([this](int row) {
    displacement(row);
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

void BatchedSolver::iteration(const Iteration& this_iteration) {
  ++iterations_;
  machine_change_ = machine_->iteration(batches_.bodies);
  each_stage([&](BatchRange range) { iterate_batches(batches_.arrays(), range, this_iteration); });
}

// The way of the substep that has ended.
void BatchedSolver::displacement(int row) {
  const float h = substep();
  for (int i = 0; i < 4; ++i) {
    travel_[row].velocity[i] += h * batches_.bodies[row].velocity[i];
    travel_[row].angular_velocity[i] += h * batches_.bodies[row].angular_velocity[i];
  }
}

void BatchedSolver::find_touched() {
  touched_.assign(problem_->bodies.size(), 0);
  for (const ContactPair& pair : problem_->pairs)
    for (const int body : {pair.a, pair.b})
      if (body >= 0) touched_[body] = 1;
}

void BatchedSolver::store_bodies() {
  pool_->blocks(static_cast<int>(problem_->bodies.size()), bodies_per_block, [this](int first, int last) {
    for (int body = first; body < last; ++body) store_body(body);
  });
}

void BatchedSolver::store_body(int index) {
  SolverBody& body = problem_->bodies[index];
  if (!pushed_[static_cast<std::size_t>(index)]) return fly(body, body.velocity, problem_->step);
  const int row = batches_.row_of[index];
  assert(batches_.order().bodies[row] == index && "a body's row holds the body");
  body.velocity = vector(batches_.bodies[row].velocity);
  body.angular_velocity = vector(batches_.bodies[row].angular_velocity);
  body.displacement = vector(travel_[row].velocity);
  body.rotation_vector = vector(travel_[row].angular_velocity);
}

}  // namespace drawpoint::engine::detail
