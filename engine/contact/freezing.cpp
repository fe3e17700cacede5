// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/contact/freezing.hpp>
#include <drawpoint/engine/contact/world.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::contact {
namespace {

using Eigen::Vector3d;

constexpr int no_rock = -1;

void require(bool fine, const char* name, double value, const char* allowed) {
  if (!fine)
    throw std::invalid_argument(std::string("contact::Freezing: ") + name + " is " + std::to_string(value) +
                                "; allowed: " + allowed);
}

void insert_sorted(std::vector<int>& list, int value) {
  const auto place = std::lower_bound(list.begin(), list.end(), value);
  if (place == list.end() || *place != value) list.insert(place, value);
}

void erase_sorted(std::vector<int>& list, int value) {
  const auto place = std::lower_bound(list.begin(), list.end(), value);
  if (place != list.end() && *place == value) list.erase(place);
}

std::pair<int, int> ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

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

std::vector<int> Freezing::remove(int rock) {
  std::vector<int> neighbours;
  Body& body = bodies_[static_cast<std::size_t>(rock)];
  for (const int partner : std::vector<int>(body.partners)) {
    const auto pair = ordered(body.collider, partner);
    const bool bears = state_.held.at(pair).impulse != Vector3d::Zero();
    drop(pair);
    const int other = rock_of(partner);
    if (other == no_rock) continue;
    sum_held(other);
    if (bears) neighbours.push_back(other);
  }
  present_[static_cast<std::size_t>(rock)] = false;
  state_.rocks[static_cast<std::size_t>(rock)] = {};
  rock_of_collider_[static_cast<std::size_t>(body.collider)] = no_rock;
  list_awake();
  std::sort(neighbours.begin(), neighbours.end());
  return neighbours;
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
  const bool machine = pair.a < 0 || pair.b < 0;
  const auto add = [&](int rock, const Vector3d& f, const Vector3d& m) {
    if (rock == no_rock) return;
    Load& load = load_of(rock);
    load.impulse += f;
    load.moment += m;
    load.carried += 0.5 * f.norm();
    load.machine |= machine;
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

std::vector<int> Freezing::struck(int reach) const {
  std::vector<int> found;
  for (const int rock : weighed_)
    if (frozen(rock) && unbalance(rock) > options_.impact) found.push_back(rock);
  return spread_from(std::move(found), reach);
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

// The rocks and the frozen ones that they bear or that bear them, over `reach` contacts; ascending.
std::vector<int> Freezing::spread_from(std::vector<int> rocks, int reach) const {
  std::sort(rocks.begin(), rocks.end());
  rocks.erase(std::unique(rocks.begin(), rocks.end()), rocks.end());
  std::vector<int> front = rocks, next;
  for (int k = 0; k < reach && !front.empty(); ++k) {
    next.clear();
    for (const int rock : front) {
      const Body& body = bodies_[static_cast<std::size_t>(rock)];
      for (const int partner : body.partners) {
        const int other = rock_of(partner);
        if (other == no_rock || std::binary_search(rocks.begin(), rocks.end(), other)) continue;
        if (state_.held.at(ordered(body.collider, partner)).impulse == Vector3d::Zero()) continue;
        insert_sorted(rocks, other);
        next.push_back(other);
      }
    }
    front.swap(next);
  }
  return rocks;
}

void Freezing::sum_held(int rock) {
  Body& body = bodies_[static_cast<std::size_t>(rock)];
  body.held = {};
  for (const int partner : body.partners) {
    const HeldPair& pair = state_.held.at(ordered(body.collider, partner));
    const bool is_b = partner < body.collider;
    if (is_b)
      body.held.impulse += pair.impulse;
    else
      body.held.impulse -= pair.impulse;
    body.held.moment += is_b ? pair.moment_b : pair.moment_a;
    body.held.carried += 0.5 * pair.impulse.norm();
  }
}

void Freezing::drop(const std::pair<int, int>& pair) {
  for (const auto& [own, other] : {pair, std::pair(pair.second, pair.first)})
    if (const int rock = rock_of(own); rock != no_rock)
      erase_sorted(bodies_[static_cast<std::size_t>(rock)].partners, other);
  state_.held.erase(pair);
}

std::vector<WarmStart::Entry> Freezing::thaw(const std::vector<int>& rocks) {
  std::vector<WarmStart::Entry> revived;
  std::vector<int> changed;
  for (const int rock : rocks) {
    if (!frozen(rock)) continue;
    FreezingState::Stand& stand = state_.rocks[static_cast<std::size_t>(rock)];
    stand = {.frozen = false, .calm = 0, .anchor = stand.anchor};
    Body& body = bodies_[static_cast<std::size_t>(rock)];
    for (const int partner : std::vector<int>(body.partners)) {
      const auto pair = ordered(body.collider, partner);
      revived.push_back(std::move(state_.held.at(pair).start));
      drop(pair);
      if (const int other = rock_of(partner); other != no_rock) changed.push_back(other);
    }
    body.held = {};
  }
  for (const int rock : changed) sum_held(rock);
  std::sort(revived.begin(), revived.end(),
            [](const auto& x, const auto& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
  if (!rocks.empty()) list_awake();
  return revived;
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

std::vector<int> Freezing::freeze(const std::vector<Rock>& rocks, const ContactProblem& problem) {
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
  hold(problem);
  list_awake();
  return frozen_now;
}

// Leaves out rocks that touch one in motion, or a frozen one in the middle of a tick, which would be held
// with it.
void Freezing::veto(std::vector<int>& candidates, const ContactProblem& problem) const {
  if (candidates.empty()) return;
  std::vector<int> kept;
  const auto restless = [&](int rock) {
    if (rock == no_rock) return false;
    if (frozen(rock)) return unbalance(rock) > options_.tolerance;
    return 2 * state_.rocks[static_cast<std::size_t>(rock)].calm < hold_steps_;
  };
  for (const ContactPair& pair : problem.pairs) {
    const int a = rock_of(pair.collider_a), b = rock_of(pair.collider_b);
    if (restless(a)) kept.push_back(b);
    if (restless(b)) kept.push_back(a);
  }
  std::sort(kept.begin(), kept.end());
  std::erase_if(candidates, [&](int rock) { return std::binary_search(kept.begin(), kept.end(), rock); });
}

// Holds the contacts of the step whose sides both stand now.
void Freezing::hold(const ContactProblem& problem) {
  std::vector<int> changed;
  for (const ContactPair& pair : problem.pairs) {
    const bool machine = pair.a < 0 || pair.b < 0;
    if (machine || !stands(pair.collider_a) || !stands(pair.collider_b)) continue;
    HeldPair held{
        Vector3d::Zero(), -pair.impulse, pair.impulse, {pair.collider_a, pair.collider_b, pair.start, {}}};
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const ContactPoint& p = problem.points[static_cast<std::size_t>(k)];
      held.impulse += p.impulse;
      held.moment_a -= p.arm_a.cross(p.impulse);
      held.moment_b += p.arm_b.cross(p.impulse);
      held.start.points.push_back({p.feature, p.position, p.start, false});
    }
    state_.held.insert_or_assign({pair.collider_a, pair.collider_b}, std::move(held));
    for (const auto& [own, other] :
         {std::pair(pair.collider_a, pair.collider_b), std::pair(pair.collider_b, pair.collider_a)})
      if (const int rock = rock_of(own); rock != no_rock) {
        insert_sorted(bodies_[static_cast<std::size_t>(rock)].partners, other);
        changed.push_back(rock);
      }
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const int rock : changed) sum_held(rock);
}

void Freezing::restore(const FreezingState& state) {
  const auto refuse = [](const std::string& what) {
    throw std::runtime_error("contact::Freezing::restore: " + what +
                             "; restore into a world that was built as the saved one was");
  };
  if (state.rocks.size() != bodies_.size())
    refuse("the state is of " + std::to_string(state.rocks.size()) + " rocks, not of " +
           std::to_string(bodies_.size()));
  const auto awake = [&](int collider) {
    const int rock = rock_of(collider);
    return rock != no_rock && !state.rocks[static_cast<std::size_t>(rock)].frozen;
  };
  for (const auto& [pair, held] : state.held)
    if (pair.first >= pair.second || awake(pair.first) || awake(pair.second))
      refuse("it holds the contact of colliders " + std::to_string(pair.first) + " and " +
             std::to_string(pair.second) + ", which are not two that stand still");
  state_ = state;
  for (Body& body : bodies_) body.partners.clear();
  for (const auto& [pair, held] : state_.held)
    for (const auto& [own, other] : {pair, std::pair(pair.second, pair.first)})
      if (const int rock = rock_of(own); rock != no_rock)
        insert_sorted(bodies_[static_cast<std::size_t>(rock)].partners, other);
  for (std::size_t k = 0; k < bodies_.size(); ++k) sum_held(static_cast<int>(k));
  for (const int rock : weighed_) loads_[static_cast<std::size_t>(rock)] = {};
  weighed_.clear();
  list_awake();
}

}  // namespace drawpoint::engine::contact
