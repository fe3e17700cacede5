// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/solver/impact_stage.h>
#include <drawpoint/engine/solver/sequential_iteration.h>
#include <atomic>
#include <cassert>
#include <drawpoint/engine/base/constants.hpp>

namespace drawpoint::engine::detail {
namespace {

constexpr int pairs_per_block = 256;  // that a thread takes at a time
constexpr double rigid = 1e300;       // [N/m]

}  // namespace

double ImpactStage::normal_speed(const ContactProblem& problem, const ContactPair& pair,
                                 const ContactPoint& point) const {
  const auto at = [&](int index, const Eigen::Vector3d& arm) -> Eigen::Vector3d {
    if (index >= 0) return problem.bodies[index].velocity + problem.bodies[index].angular_velocity.cross(arm);
    const SpatialVector V = problem.machine->part_maps[part_of(index)] * problem.machine->velocity_before;
    return V.tail<3>() + V.head<3>().cross(arm);
  };
  return point.normal.dot(at(pair.b, point.arm_b) - at(pair.a, point.arm_a));
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
      point.start.setZero();
      members_.push_back(k);
      targets_.push_back(speed < -constants::impact_speed ? -point.restitution * speed : 0.0);
      stage_.points.push_back(point);
    }
    pair.first = first;
    pair.count = static_cast<int>(stage_.points.size()) - first;
    pair.rolling_arm = pair.spinning_arm = 0;
    pair.start.setZero();
    if (pair.count > 0) stage_.pairs.push_back(pair);
  }
}

void ImpactStage::run(ContactProblem& problem, const ThreadPool& pool) {
  machine_ = problem.machine;
  ran_ = needed(problem, pool);
  if (!ran_) return;
  choose_points(problem);
  stage_.step = problem.step;
  stage_.bodies = problem.bodies;
  stage_.machine = nullptr;
  if (machine_) {
    bare_ = struck_ = *machine_;
    bare_.rows.clear();
    stage_.machine = &bare_;
  }
  SequentialIteration iteration(stage_, 1);
  iteration.set_bias_velocities(targets_);
  double change = 1;
  for (int k = 0; k < constants::impact_iterations; ++k) {
    if (change <= constants::impact_tolerance * iteration.normal_load()) break;
    change = iteration.iteration();
  }
  iteration.finish();
  solution_ = iteration.store();
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
