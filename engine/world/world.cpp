// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <drawpoint/engine/world/free_rotation.h>
#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/engine/world/checks.h>
#include <sstream>
#include <stdexcept>
#include <string>

namespace drawpoint::engine {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int bodies_a_block = 128;  // that a thread takes at a time

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Matrix3d turned(const Matrix3d& R, const Vector3d& principal) {
  return R * principal.asDiagonal() * R.transpose();
}

}  // namespace

World::World(const WorldOptions& options, const MaterialTable& materials)
    : options_((detail::check(options), options)),
      materials_((detail::check(materials), materials)),
      parallel_(std::make_shared<const detail::Parallel>(options.solver.threads)),
      finder_(options.contacts, parallel_),
      solver_(options.solver, parallel_),
      freezing_(options.freezing, options.step, options.gravity) {}

// How far beyond the margin a surface may go in a step: a pair closes by no more than the sum of its reaches
// and the margin, so no contact is missed at any speed. In steps of `reach_step`, so that a speed that
// wavers does not make contacts be searched anew.
double World::reach_of(const Surface& surface) const {
  constexpr double reach_step = 5e-3;  // [m]
  const double fall = options_.step * options_.gravity.norm();
  double speed = 0;
  if (surface.owner == Owner::rock) {
    const Rock& rock = rocks_[surface.index];
    speed = rock.velocity.norm() + rock.angular_velocity.norm() * surface.radius + fall;
  } else if (surface.owner == Owner::part) {
    const SpatialVector V = super_->part_maps[surface.index] * super_->velocity_before;
    speed = V.tail<3>().norm() + V.head<3>().norm() * surface.radius + fall;
  }
  return reach_step *
         std::ceil(std::max(0.0, options_.step * speed - 0.5 * options_.contacts.margin) / reach_step);
}

void World::place_colliders() {
  const std::vector<int>& awake = freezing_.awake();
  moves_.resize(awake.size());
  parallel_->blocks(static_cast<int>(awake.size()), bodies_a_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const Rock& rock = rocks_[awake[k]];
      moves_[k] = {rock.collider, rock.pose, reach_of(surfaces_[rock.collider])};
    }
  });
  for (std::size_t id = 0; id < surfaces_.size(); ++id)
    if (surfaces_[id].owner == Owner::part)
      moves_.push_back(
          {static_cast<int>(id), machine_->part_pose(surfaces_[id].index), reach_of(surfaces_[id])});
  finder_.move(moves_);
}

void World::fill_bodies() {
  const std::vector<int>& awake = freezing_.awake();
  problem_.bodies.resize(awake.size() + 1);
  problem_.bodies[world_body] = SolverBody();
  body_of_rock_.assign(rocks_.size(), world_body);
  parallel_->blocks(static_cast<int>(awake.size()), bodies_a_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const Rock& rock = rocks_[awake[k]];
      SolverBody& body = problem_.bodies[k + 1];
      body_of_rock_[awake[k]] = k + 1;
      body.inverse_mass = 1 / rock.body.mass;
      body.inverse_inertia = turned(rock.pose.linear(), rock.body.inertia.cwiseInverse());
      body.velocity = rock.velocity;
      body.push = options_.step * options_.gravity;
      body.angular_velocity = rock.angular_velocity;
    }
  });
}

void World::move_rocks() {
  const std::vector<int>& awake = freezing_.awake();
  parallel_->blocks(static_cast<int>(awake.size()), bodies_a_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) move(rocks_[awake[k]], problem_.bodies[k + 1]);
  });
}

void World::move(Rock& rock, const SolverBody& body) const {
  rock.velocity = body.velocity;
  rock.angular_velocity = body.angular_velocity;
  rock.pose.translation() += body.travel;
  if (body.turn.squaredNorm() == 0) return;
  Eigen::Quaterniond q(rock.pose.linear());
  turn_freely(q, rock.body.inertia, rock.angular_velocity, body.turn, options_.step);
  rock.pose.linear() = q.toRotationMatrix();
}

[[noreturn]] void World::fail(const std::string& what) const {
  throw SolutionBroken("engine::World::step: step " + std::to_string(steps_ + 1) + " at t = " +
                       std::to_string(time_) + " s: " + what + "; use a smaller step or more sweeps");
}

void World::check_solution(int rock, const SolverBody& body) const {
  const double speed = body.velocity.norm(), spin = body.angular_velocity.norm();
  const double way = body.travel.norm() + body.turn.norm();
  if (speed <= detail::fastest_solution && spin <= 10 * detail::fastest_solution && std::isfinite(way))
    return;
  std::ostringstream what;
  what << "rock " << rock << " comes out with " << speed << " m/s and " << spin << " rad/s";
  fail(what.str());
}

// The solution as it is before anything has moved.
void World::check_solution(const SuperBodySolution& machine) const {
  const std::vector<int>& awake = freezing_.awake();
  parallel_->blocks(static_cast<int>(awake.size()), bodies_a_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) check_solution(awake[k], problem_.bodies[k + 1]);
  });
  if (machine_ && !(machine.velocity.allFinite() && machine.mean_velocity.allFinite()))
    fail("the machine's speeds come out not finite");
}

void World::find_contacts(StepReport& report) {
  place_colliders();
  manifolds_ = &finder_.find();
  report.broad_s += finder_.times().broad;
  report.narrow_s += finder_.times().narrow;
}

SolverReport World::solve_contacts(StepReport& report) {
  fill_bodies();
  warm_start_.rewind();
  fill_contacts();
  if (before_solve_) before_solve_(problem_);
  const auto start = std::chrono::steady_clock::now();
  const SolverReport solved = solver_.solve(problem_);
  report.solver_s += seconds_since(start);
  ++report.solves;
  return solved;
}

void World::thaw(const std::vector<int>& rocks) {
  for (const int rock : rocks) finder_.set_moves(rocks_[rock].collider, true);
  warm_start_.insert(freezing_.thaw(rocks));
}

void World::thaw_all() {
  std::vector<int> rocks;
  for (std::size_t k = 0; k < rocks_.size(); ++k)
    if (rocks_[k].present && frozen(static_cast<int>(k))) rocks.push_back(static_cast<int>(k));
  thaw(rocks);
}

void World::thaw_near_machine(StepReport& report) {
  if (!options_.freezing.on) return;
  const std::vector<int> near = freezing_.near_machine(*manifolds_);
  if (near.empty()) return;
  thaw(near);
  find_contacts(report);
}

// Whether the step must be solved again: frozen rocks took up more than they may, and are awake now.
bool World::thaw_struck(int round) {
  if (!options_.freezing.on) return false;
  freezing_.weigh(problem_);
  const std::vector<int> rocks = freezing_.struck(options_.freezing.spread << std::min(round - 1, 8));
  thaw(rocks);
  return !rocks.empty();
}

void World::settle_frozen() {
  if (!options_.freezing.on) return;
  thaw(freezing_.unbalanced());
  thaw(freezing_.nudged(rocks_, problem_));
  for (const int rock : freezing_.freeze(rocks_, problem_)) {
    finder_.set_moves(rocks_[rock].collider, false);
    rocks_[rock].velocity.setZero();
    rocks_[rock].angular_velocity.setZero();
  }
}

StepReport World::step() {
  const detail::Parallel::Shift shift(*parallel_);
  const auto start = std::chrono::steady_clock::now();
  StepReport report;
  super_ = machine_ ? &machine_->linearise(options_.step, options_.gravity) : nullptr;
  problem_.machine = super_;
  report.machine_s = machine_ ? seconds_since(start) : 0;
  SolverReport solved;
  do {
    find_contacts(report);
    thaw_near_machine(report);
    solved = solve_contacts(report);
    check_solution(solved.machine);
  } while (thaw_struck(report.solves));
  keep_impulses();
  if (machine_) {
    const auto advance_start = std::chrono::steady_clock::now();
    machine_->advance(solved.machine);
    report.machine_s += seconds_since(advance_start);
  }
  move_rocks();
  ++steps_;
  time_ += options_.step;
  report.awake = static_cast<int>(freezing_.awake().size());
  settle_frozen();
  report.manifolds = static_cast<int>(problem_.pairs.size());
  report.points = static_cast<int>(problem_.points.size());
  report.last_change = solved.last_change;
  report.complementarity = solved.complementarity;
  report.cone = solved.cone;
  report.max_overlap = deepest_overlap();
  report.rest_s =
      seconds_since(start) - report.broad_s - report.narrow_s - report.machine_s - report.solver_s;
  return report;
}

double World::kinetic_energy() const {
  double sum = 0;
  for (const Rock& rock : rocks_) {
    if (!rock.present) continue;
    const Vector3d w = rock.pose.linear().transpose() * rock.angular_velocity;
    sum +=
        0.5 * rock.body.mass * rock.velocity.squaredNorm() + 0.5 * w.dot(rock.body.inertia.cwiseProduct(w));
  }
  return sum;
}

double World::fastest_rock() const {
  double fastest = 0;
  for (const Rock& rock : rocks_)
    if (rock.present) fastest = std::max(fastest, rock.velocity.norm());
  return fastest;
}

}  // namespace drawpoint::engine
