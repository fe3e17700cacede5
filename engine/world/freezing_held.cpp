// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The contacts that are held between bodies that stand still: held, released, followed from rock to rock.
#include <drawpoint/engine/world/freezing.h>
#include <algorithm>
#include <stdexcept>
#include <string>

namespace drawpoint::engine {

using detail::HeldLoad;
using detail::PairMemory;
using detail::RememberedPair;
using Eigen::Vector3d;

namespace {

void insert_sorted(std::vector<int>& list, int value) {
  const auto place = std::lower_bound(list.begin(), list.end(), value);
  if (place == list.end() || *place != value) list.insert(place, value);
}

// Where a collider is or would be among partners.
template <class Partners>
auto place_of(Partners& partners, int collider) {
  return std::lower_bound(partners.begin(), partners.end(), collider,
                          [](const auto& partner, int c) { return partner.collider < c; });
}

HeldLoad load_through(const ContactProblem& problem, const ContactPair& pair) {
  HeldLoad load{Vector3d::Zero(), -pair.impulse, pair.impulse};
  for (int k = pair.first; k < pair.first + pair.count; ++k) {
    const ContactPoint& p = problem.points[static_cast<std::size_t>(k)];
    load.impulse += p.impulse;
    load.moment_a -= p.arm_a.cross(p.impulse);
    load.moment_b += p.arm_b.cross(p.impulse);
  }
  return load;
}

}  // namespace

std::vector<int> Freezing::remove(int rock, PairMemory& memory) {
  std::vector<int> neighbours;
  Body& body = bodies_[static_cast<std::size_t>(rock)];
  for (const Partner& partner : std::vector<Partner>(body.partners)) {
    part(body.collider, partner.collider);
    memory.release(partner.slot);
    const int other = rock_of(partner.collider);
    if (other == no_rock) continue;
    sum_held(other, memory);
    if (partner.bears) neighbours.push_back(other);
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
    for (const int rock : front)
      for (const Partner& partner : bodies_[static_cast<std::size_t>(rock)].partners) {
        const int other = rock_of(partner.collider);
        if (other == no_rock || !partner.bears || std::binary_search(rocks.begin(), rocks.end(), other))
          continue;
        insert_sorted(rocks, other);
        next.push_back(other);
      }
    front.swap(next);
  }
  return rocks;
}

void Freezing::sum_held(int rock, const PairMemory& memory) {
  Body& body = bodies_[static_cast<std::size_t>(rock)];
  body.held = {};
  for (const Partner& partner : body.partners) {
    const HeldLoad& load = memory.load(partner.slot);
    const bool is_b = partner.collider < body.collider;
    if (is_b)
      body.held.impulse += load.impulse;
    else
      body.held.impulse -= load.impulse;
    body.held.moment += is_b ? load.moment_b : load.moment_a;
    body.held.carried += 0.5 * load.impulse.norm();
  }
}

// Makes each the other's partner, where it is a rock.
void Freezing::join(int a, int b, int slot, const HeldLoad& load) {
  for (const auto& [own, other] : {std::pair(a, b), std::pair(b, a)}) {
    const int rock = rock_of(own);
    if (rock == no_rock) continue;
    std::vector<Partner>& partners = bodies_[static_cast<std::size_t>(rock)].partners;
    const auto place = place_of(partners, other);
    const Partner partner{other, slot, load.impulse != Vector3d::Zero()};
    if (place != partners.end() && place->collider == other)
      *place = partner;
    else
      partners.insert(place, partner);
  }
}

void Freezing::part(int a, int b) {
  for (const auto& [own, other] : {std::pair(a, b), std::pair(b, a)}) {
    const int rock = rock_of(own);
    if (rock == no_rock) continue;
    std::vector<Partner>& partners = bodies_[static_cast<std::size_t>(rock)].partners;
    const auto place = place_of(partners, other);
    if (place != partners.end() && place->collider == other) partners.erase(place);
  }
}

void Freezing::thaw(const std::vector<int>& rocks, PairMemory& memory) {
  std::vector<int> changed;
  for (const int rock : rocks) {
    if (!frozen(rock)) continue;
    FreezingState::Stand& stand = state_.rocks[static_cast<std::size_t>(rock)];
    stand = {.frozen = false, .calm = 0, .anchor = stand.anchor};
    Body& body = bodies_[static_cast<std::size_t>(rock)];
    for (const Partner& partner : std::vector<Partner>(body.partners)) {
      part(body.collider, partner.collider);
      memory.release(partner.slot);
      if (const int other = rock_of(partner.collider); other != no_rock) changed.push_back(other);
    }
    body.held = {};
  }
  for (const int rock : changed) sum_held(rock, memory);
  if (!rocks.empty()) list_awake();
}

// Holds the contacts of the step whose sides both stand now.
void Freezing::hold(const ContactProblem& problem, PairMemory& memory) {
  std::vector<int> changed;
  for (std::size_t k = 0; k < problem.pairs.size(); ++k) {
    const ContactPair& pair = problem.pairs[k];
    const bool machine = pair.a < 0 || pair.b < 0;
    if (machine || !stands(pair.collider_a) || !stands(pair.collider_b)) continue;
    const int slot = memory.slot(static_cast<int>(k));
    memory.hold(slot, load_through(problem, pair));
    join(pair.collider_a, pair.collider_b, slot, memory.load(slot));
    for (const int own : {pair.collider_a, pair.collider_b})
      if (const int rock = rock_of(own); rock != no_rock) changed.push_back(rock);
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const int rock : changed) sum_held(rock, memory);
}

void Freezing::restore(const FreezingState& state, const PairMemory& memory) {
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
  const std::vector<int> held = memory.held();
  for (const int slot : held)
    if (const RememberedPair& pair = memory.pair(slot); awake(pair.a) || awake(pair.b))
      refuse("it holds the contact of colliders " + std::to_string(pair.a) + " and " +
             std::to_string(pair.b) + ", which are not two that stand still");
  state_ = state;
  for (Body& body : bodies_) body.partners.clear();
  for (const int slot : held) join(memory.pair(slot).a, memory.pair(slot).b, slot, memory.load(slot));
  for (std::size_t k = 0; k < bodies_.size(); ++k) sum_held(static_cast<int>(k), memory);
  for (const int rock : weighed_) loads_[static_cast<std::size_t>(rock)] = {};
  weighed_.clear();
  list_awake();
}

}  // namespace drawpoint::engine
