// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/heavy_islands.h>
#include <drawpoint/engine/solver/impact_stage.h>
#include <drawpoint/engine/solver/sequential_iteration.h>
#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <drawpoint/engine/base/constants.hpp>

namespace drawpoint::engine::detail {
namespace {

constexpr int pairs_per_block = 256;  // that a thread takes at a time
constexpr double rigid = 1e300;       // [N/m]
constexpr int halvings = 10;          // of the range of a scale: to 1e-3
constexpr double round_off = 1e-9;    // of the energy that impacts turn over

Eigen::Vector3d relative_velocity(const ContactProblem& problem, const Eigen::VectorXd& w,
                                  const ContactPair& pair, const ContactPoint& point) {
  const auto at = [&](int index, const Eigen::Vector3d& arm) -> Eigen::Vector3d {
    if (index >= 0) return problem.bodies[index].velocity + problem.bodies[index].angular_velocity.cross(arm);
    const SpatialVector V = problem.machine->part_maps[part_of(index)] * w;
    return V.tail<3>() + V.head<3>().cross(arm);
  };
  return at(pair.b, point.arm_b) - at(pair.a, point.arm_a);
}

}  // namespace

double ImpactStage::normal_speed(const ContactProblem& problem, const ContactPair& pair,
                                 const ContactPoint& point) const {
  const Eigen::VectorXd none;
  return point.normal.dot(
      relative_velocity(problem, problem.machine ? problem.machine->velocity_before : none, pair, point));
}

// Whether a point of the pair strikes within the step and springs back.
bool ImpactStage::rebounds(const ContactProblem& problem, const ContactPair& pair) const {
  for (int k = pair.first; k < pair.first + pair.count; ++k) {
    const ContactPoint& point = problem.points[k];
    if (point.restitution <= 0) continue;
    const double speed = normal_speed(problem, pair, point);
    if (speed < -constants::impact_speed && point.gap + problem.step * speed <= 0) return true;
  }
  return false;
}

bool ImpactStage::needed(const ContactProblem& problem, const ThreadPool& pool) const {
  std::atomic<bool> found{false};
  pool.blocks(static_cast<int>(problem.pairs.size()), pairs_per_block, [&](int first, int last) {
    for (int k = first; k < last && !found.load(std::memory_order_relaxed); ++k)
      if (rebounds(problem, problem.pairs[k])) found.store(true, std::memory_order_relaxed);
  });
  return found;
}

// The points that touch or close within the step.
void ImpactStage::choose_points(const ContactProblem& problem) {
  stage_.pairs.clear();
  stage_.points.clear();
  members_.clear();
  targets_.clear();
  for (ContactPair pair : problem.pairs) {
    const int first = static_cast<int>(stage_.points.size());
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const double speed = normal_speed(problem, pair, problem.points[k]);
      if (problem.points[k].gap + problem.step * std::min(speed, 0.0) > constants::touching_gap) continue;
      ContactPoint point = problem.points[k];
      point.stiffness = rigid;
      members_.push_back(k);
      targets_.push_back(speed < -constants::impact_speed ? -point.restitution * speed : 0.0);
      stage_.points.push_back(point);
    }
    pair.first = first;
    pair.count = static_cast<int>(stage_.points.size()) - first;
    pair.rolling_arm = pair.spinning_arm = 0;
    if (pair.count > 0) stage_.pairs.push_back(pair);
  }
}

void ImpactStage::solve(const ContactProblem& problem, const std::vector<double>& scales) {
  stage_.bodies = problem.bodies;
  for (ContactPoint& point : stage_.points) point.start.setZero();
  for (ContactPair& pair : stage_.pairs) pair.start.setZero();
  std::vector<double> targets = targets_;
  for (std::size_t k = 0; k < stage_.pairs.size(); ++k)
    for (int p = stage_.pairs[k].first; p < stage_.pairs[k].first + stage_.pairs[k].count; ++p)
      targets[p] *= scales[groups_.of_pair[k]];
  SequentialIteration iteration(stage_, 1);
  iteration.set_bias_velocities(targets);
  double change = 1;
  for (int k = 0; k < constants::impact_iterations; ++k) {
    if (change <= constants::impact_tolerance * iteration.normal_load()) break;
    change = iteration.iteration();
  }
  if (solvable_directly(stage_)) iteration.solve_directly();
  iteration.finish();
  solution_ = iteration.store();
}

// An impulse does the work p (u⁻ + u⁺) / 2.
std::vector<bool> ImpactStage::groups_that_gain(const ContactProblem& problem) const {
  std::vector<double> gain(groups_.count), turned_over(groups_.count);
  const Eigen::VectorXd none;
  for (std::size_t k = 0; k < stage_.pairs.size(); ++k) {
    const ContactPair& pair = stage_.pairs[k];
    for (int p = pair.first; p < pair.first + pair.count; ++p) {
      const ContactPoint& point = stage_.points[p];
      const double before = point.impulse.dot(
          relative_velocity(problem, machine_ ? machine_->velocity_before : none, pair, point));
      const double after = point.impulse.dot(relative_velocity(stage_, solution_.velocity, pair, point));
      gain[groups_.of_pair[k]] += 0.5 * (before + after);
      turned_over[groups_.of_pair[k]] += std::abs(before);
    }
  }
  std::vector<bool> gains(groups_.count);
  for (int g = 0; g < groups_.count; ++g) gains[g] = gain[g] > round_off * turned_over[g];
  return gains;
}

// Bisection in the groups that gain; the others keep the whole of Newton's law.
void ImpactStage::solve_without_gain(const ContactProblem& problem) {
  std::vector<double> low(groups_.count, 1), high(groups_.count, 1);
  solve(problem, low);
  std::vector<bool> gains = groups_that_gain(problem);
  const std::vector<bool> gained = gains;
  if (std::none_of(gained.begin(), gained.end(), [](bool g) { return g; })) return;
  for (int g = 0; g < groups_.count; ++g)
    if (gained[g]) low[g] = 0;
  for (int k = 0; k < halvings; ++k) {
    std::vector<double> middle(groups_.count);
    for (int g = 0; g < groups_.count; ++g) middle[g] = 0.5 * (low[g] + high[g]);
    solve(problem, middle);
    gains = groups_that_gain(problem);
    for (int g = 0; g < groups_.count; ++g)
      if (gained[g]) (gains[g] ? high : low)[g] = middle[g];
  }
  solve(problem, low);
}

void ImpactStage::run(ContactProblem& problem, const ThreadPool& pool) {
  machine_ = problem.machine;
  ran_ = needed(problem, pool);
  if (!ran_) return;
  choose_points(problem);
  groups_ = find_islands(problem, stage_.pairs);
  stage_.step = problem.step;
  if (machine_) bare_ = struck_ = *machine_;
  bare_.rows.clear();
  stage_.machine = machine_ ? &bare_ : nullptr;
  solve_without_gain(problem);
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    problem.bodies[k].velocity = stage_.bodies[k].velocity;
    problem.bodies[k].angular_velocity = stage_.bodies[k].angular_velocity;
  }
  if (!machine_) return;
  struck_.velocity += solution_.velocity - struck_.velocity_before;
  struck_.velocity_before = solution_.velocity;
  problem.machine = &struck_;
}

void ImpactStage::finish(ContactProblem& problem, SuperBodySolution& solution) const {
  if (!ran_) return;
  assert(members_.size() == stage_.points.size() && "one point of the problem for each of the stage");
  problem.machine = machine_;
  for (std::size_t k = 0; k < members_.size(); ++k)
    problem.points[members_[k]].impulse += stage_.points[k].impulse;
  for (std::size_t part = 0; part < solution.part_impulses.size(); ++part)
    solution.part_impulses[part] += solution_.part_impulses[part];
}

}  // namespace drawpoint::engine::detail
