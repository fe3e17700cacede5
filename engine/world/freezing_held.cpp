// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The contacts that are held between bodies that stand still: kept, handed back, followed from rock to rock.
#include <drawpoint/engine/world/freezing.h>
#include <algorithm>
#include <stdexcept>
#include <string>

namespace drawpoint::engine {
namespace {

using Eigen::Vector3d;

constexpr int no_rock = -1;

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

// The rocks and the frozen ones that they bear or that bear them, over `contacts_away` contacts; ascending.
std::vector<int> Freezing::spread_from(std::vector<int> rocks, int contacts_away) const {
  std::sort(rocks.begin(), rocks.end());
  rocks.erase(std::unique(rocks.begin(), rocks.end()), rocks.end());
  std::vector<int> front = rocks, next;
  for (int k = 0; k < contacts_away && !front.empty(); ++k) {
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
    throw std::runtime_error("engine::Freezing::restore: " + what +
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

}  // namespace drawpoint::engine
