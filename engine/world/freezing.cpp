// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/world/freezing.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace drawpoint::engine {
namespace {

using Eigen::Vector3d;

void require(bool fine, const char* name, double value, const char* allowed) {
  if (!fine)
    throw std::invalid_argument(std::string("engine::Freezing: ") + name + " is " + std::to_string(value) +
                                "; allowed: " + allowed);
}

}  // namespace

Freezing::Freezing(const FreezingOptions& options, double step, const Vector3d& gravity)
    : options_(options),
      hold_steps_(static_cast<int>(std::ceil(std::min(options.hold / step, 1e9)))),
      weight_(step * gravity),
      slow_(options.distance / options.hold),
      share_(std::min(1.0, step / options.average)) {
  require(options.hold > 0 && options.hold < 1e6, "hold [s]", options.hold, "above 0 s");
  require(options.distance > 0 && options.distance < 1, "distance [m]", options.distance,
          "above 0, below 1 m; rocks of 0.3 m stand within 0.0005 m");
  require(options.tolerance > 0 && options.tolerance <= 1, "tolerance", options.tolerance,
          "above 0, at most 1 of the load that a rock carries");
  require(options.average > 0 && options.average < 1e6, "average [s]", options.average, "above 0 s");
  require(options.impact >= options.tolerance && options.impact < 1e9, "impact", options.impact,
          "at least the tolerance");
  require(options.nudge > 0 && options.nudge < 1e6, "nudge [m/s]", options.nudge, "above 0 m/s");
  require(options.spread >= 0 && options.spread <= 100, "spread", options.spread, "0 to 100 contacts");
}

int Freezing::rock_of(int collider) const {
  const auto k = static_cast<std::size_t>(collider);
  return k < rock_of_collider_.size() ? rock_of_collider_[k] : no_rock;
}

bool Freezing::stands(int collider) const {
  const int rock = rock_of(collider);
  return rock == no_rock || frozen(rock);
}

void Freezing::add(int rock, const Rock& body) {
  const auto k = static_cast<std::size_t>(rock), collider = static_cast<std::size_t>(body.collider);
  bodies_.resize(k + 1);
  present_.resize(k + 1, true);
  loads_.resize(k + 1);
  state_.rocks.resize(k + 1);
  bodies_[k].collider = body.collider;
  bodies_[k].mass = body.body.mass;
  bodies_[k].arm = std::sqrt(0.5 * body.body.inertia.sum() / body.body.mass);
  state_.rocks[k].anchor = body.pose;
  rock_of_collider_.resize(std::max(rock_of_collider_.size(), collider + 1), no_rock);
  rock_of_collider_[collider] = rock;
  awake_.push_back(rock);
}

void Freezing::list_awake() {
  awake_.clear();
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (present_[k] && !state_.rocks[k].frozen) awake_.push_back(static_cast<int>(k));
}

std::vector<int> Freezing::near_machine(const std::vector<Manifold>& manifolds) {
  std::vector<int> found;
  near_.clear();
  for (const Manifold& m : manifolds) {
    if (m.body_a >= 0 && m.body_b >= 0) continue;
    const int rock = rock_of(m.body_a < 0 ? m.collider_b : m.collider_a);
    if (rock == no_rock) continue;
    near_.push_back(rock);
    if (frozen(rock)) found.push_back(rock);
  }
  std::sort(near_.begin(), near_.end());
  return spread_from(std::move(found), options_.spread);
}

Freezing::Load& Freezing::load_of(int rock) {
  const auto k = static_cast<std::size_t>(rock);
  Load& load = loads_[k];
  if (!load.solved) {
    load = bodies_[k].held;
    load.solved = true;
    weighed_.push_back(rock);
  }
  return load;
}

void Freezing::add_pair(const ContactProblem& problem, const ContactPair& pair) {
  Vector3d impulse = Vector3d::Zero(), moment_a = -pair.impulse, moment_b = pair.impulse;
  for (int k = pair.first; k < pair.first + pair.count; ++k) {
    const ContactPoint& p = problem.points[static_cast<std::size_t>(k)];
    impulse += p.impulse;
    moment_a -= p.arm_a.cross(p.impulse);
    moment_b += p.arm_b.cross(p.impulse);
  }
  const auto add = [&](int rock, const Vector3d& f, const Vector3d& m) {
    if (rock == no_rock) return;
    Load& load = load_of(rock);
    load.impulse += f;
    load.moment += m;
    load.carried += 0.5 * f.norm();
  };
  add(rock_of(pair.collider_a), -impulse, moment_a);
  add(rock_of(pair.collider_b), impulse, moment_b);
}

void Freezing::weigh(const ContactProblem& problem) {
  for (const int rock : weighed_) loads_[static_cast<std::size_t>(rock)] = {};
  weighed_.clear();
  for (const ContactPair& pair : problem.pairs) add_pair(problem, pair);
}

double Freezing::relative(int rock, const Vector3d& P, const Vector3d& L) const {
  const Body& body = bodies_[static_cast<std::size_t>(rock)];
  const double carried = std::max(loads_[static_cast<std::size_t>(rock)].carried, body.mass * weight_.norm());
  return carried > 0 ? std::max(P.norm(), L.norm() / body.arm) / carried : 0;
}

double Freezing::unbalance(int rock) const {
  const auto k = static_cast<std::size_t>(rock);
  if (frozen(rock) && !loads_[k].solved) return 0;
  return relative(rock, loads_[k].impulse + bodies_[k].mass * weight_, loads_[k].moment);
}

std::vector<int> Freezing::struck(int contacts_away) const {
  std::vector<int> found;
  for (const int rock : weighed_)
    if (frozen(rock) && unbalance(rock) > options_.impact) found.push_back(rock);
  return spread_from(std::move(found), contacts_away);
}

std::vector<int> Freezing::unbalanced() {
  std::vector<int> found;
  for (const int rock : weighed_) {
    const auto k = static_cast<std::size_t>(rock);
    FreezingState::Stand& stand = state_.rocks[k];
    if (!stand.frozen) continue;
    stand.impulse += share_ * (loads_[k].impulse + bodies_[k].mass * weight_ - stand.impulse);
    stand.moment += share_ * (loads_[k].moment - stand.moment);
    if (relative(rock, stand.impulse, stand.moment) > options_.tolerance) found.push_back(rock);
  }
  return spread_from(std::move(found), options_.spread);
}

double Freezing::speed(int rock, const Rock& body) const {
  return body.velocity.norm() + bodies_[static_cast<std::size_t>(rock)].arm * body.angular_velocity.norm();
}

// Counts the steps for which a rock has stayed where it was.
void Freezing::watch(int rock, const Rock& body) {
  FreezingState::Stand& stand = state_.rocks[static_cast<std::size_t>(rock)];
  const double arm = bodies_[static_cast<std::size_t>(rock)].arm;
  const double moved = (body.pose.translation() - stand.anchor.translation()).norm() +
                       arm * (body.pose.linear() - stand.anchor.linear()).norm() / std::numbers::sqrt2;
  if (moved <= options_.distance) {
    stand.calm = std::min(stand.calm + 1, hold_steps_);
  } else {
    stand.anchor = body.pose;
    stand.calm = 0;
  }
}

std::vector<int> Freezing::nudged(const std::vector<Rock>& rocks, const ContactProblem& problem) const {
  std::vector<int> found;
  const auto moves = [&](int rock) {
    return rock != no_rock && !frozen(rock) &&
           speed(rock, rocks[static_cast<std::size_t>(rock)]) > options_.nudge;
  };
  for (const ContactPair& pair : problem.pairs) {
    const int a = rock_of(pair.collider_a), b = rock_of(pair.collider_b);
    if (a == no_rock || b == no_rock || frozen(a) == frozen(b)) continue;
    if (moves(a)) found.push_back(b);
    if (moves(b)) found.push_back(a);
  }
  return spread_from(std::move(found), options_.spread - 1);
}

std::vector<int> Freezing::freeze(const std::vector<Rock>& rocks, const ContactProblem& problem,
                                  detail::PairMemory& memory) {
  std::vector<int> frozen_now;
  for (const int rock : awake_) {
    const Rock& body = rocks[static_cast<std::size_t>(rock)];
    watch(rock, body);
    if (state_.rocks[static_cast<std::size_t>(rock)].calm < hold_steps_ || speed(rock, body) > slow_)
      continue;
    const Load& load = loads_[static_cast<std::size_t>(rock)];
    if (load.carried > 0 && !std::binary_search(near_.begin(), near_.end(), rock) &&
        unbalance(rock) <= 0.5 * options_.tolerance)
      frozen_now.push_back(rock);
  }
  veto(frozen_now, problem);
  if (frozen_now.empty()) return frozen_now;
  for (const int rock : frozen_now) state_.rocks[static_cast<std::size_t>(rock)].frozen = true;
  hold(problem, memory);
  list_awake();
  return frozen_now;
}

// Leaves out rocks that touch one in motion, or a frozen one in the middle of a tick, which would be held
// with it.
void Freezing::veto(std::vector<int>& candidates, const ContactProblem& problem) const {
  if (candidates.empty()) return;
  std::vector<int> kept;
  const auto unsteady = [&](int rock) {
    if (rock == no_rock) return false;
    if (frozen(rock)) return unbalance(rock) > options_.tolerance;
    return 2 * state_.rocks[static_cast<std::size_t>(rock)].calm < hold_steps_;
  };
  for (const ContactPair& pair : problem.pairs) {
    const int a = rock_of(pair.collider_a), b = rock_of(pair.collider_b);
    if (unsteady(a)) kept.push_back(b);
    if (unsteady(b)) kept.push_back(a);
  }
  std::sort(kept.begin(), kept.end());
  std::erase_if(candidates, [&](int rock) { return std::binary_search(kept.begin(), kept.end(), rock); });
}

}  // namespace drawpoint::engine
