// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/load_search.h>

#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/site.hpp>

namespace drawpoint::engine::loading {
namespace {

using engine::ConvexPolyhedron;

// The box that the machine fills behind its cutting edge, with 10 cm of room: rocks may not lie there at the
// start.
constexpr double machine_length = 12.2, least_half_width = 1.7, machine_top = 2.0, room = 0.1;
constexpr double calm = 0.25;  // of a load against its bucket [m/s]

// Layers come as fast as the last one falls its own thickness; where whole cycles are simulated, as piles are poured.
granular::EmitterOptions raise_of(const Scenario& scenario) {
  granular::EmitterOptions raise = emitter_of(scenario.drift);
  if (!scenario.whole_cycle) raise.interval = 0.35;
  return raise;
}

const ConvexPolyhedron& polyhedron(const engine::Rock& rock) {
  return std::get<ConvexPolyhedron>(*rock.body.shape);
}

}  // namespace

Site::Site(const Scenario& scenario, const SettledPile& pile)
    : drift_(scenario.drift),
      lhd_(sandvik_lh621(scenario.machine)),
      machine_(lhd_.spec),
      world_(scenario.world, material_table(scenario.materials)),
      driver_(lhd_, machine_),
      library_(scenario.pile.density, static_cast<int>(SurfaceKind::rock)),
      emitter_(raise_of(scenario), scenario.pile.density, scenario.seed, scenario.pile.sizes) {
  add_drift(world_, drift_);
  driver_.settle_alone(scenario.world, scenario.materials);
  add_machine(world_, lhd_, machine_);
  for (const granular::PlacedRock& rock : pile.rocks) {
    world_.add_rock(library_.body(rock.spec), rock.pose);
    specs_.push_back(rock.spec);
  }
  initial_mass_ = granular::present_mass(world_);
  initial_rocks_ = specs_.size();
}

std::vector<PosedRock> Site::rocks(bool with_bucket) const {
  std::vector<PosedRock> out;
  for (std::size_t k = 0; k < world_.rocks().size(); ++k) {
    const engine::Rock& rock = world_.rocks()[k];
    if (!rock.present || (!with_bucket && in_bucket(static_cast<int>(k)))) continue;
    out.push_back({&polyhedron(rock), rock.pose, rock.body.mass});
  }
  return out;
}

bool Site::in_bucket(int rock) const {
  return in_heaped_bucket(lhd_, driver_.in_bucket_frame(world_.rocks()[rock].pose.translation()));
}

double Site::mass_in_bucket() const {
  double mass = 0;
  for (std::size_t k = 0; k < world_.rocks().size(); ++k) {
    const engine::Rock& rock = world_.rocks()[k];
    if (rock.present && in_bucket(static_cast<int>(k))) mass += rock.body.mass;
  }
  return mass;
}

Site::Load Site::load(const std::vector<bool>& free_of_pile) const {
  std::vector<bool> allowed = free_of_pile;
  std::vector<int> heaped;
  for (std::size_t k = 0; k < allowed.size(); ++k) {
    if (!world_.rocks()[k].present || !in_bucket(static_cast<int>(k))) continue;
    allowed[k] = true;
    heaped.push_back(static_cast<int>(k));
  }
  LoadSearch search(allowed, heaped, world_.pair_forces());
  Load load;
  for (int rock : heaped) search.take(rock, load.in_bucket);
  search.take_on(lhd_.bucket, load.in_bucket);
  for (int part = 0; part < machine_.parts(); ++part) search.take_on(part, load.elsewhere);
  return load;
}

double Site::remove(const std::vector<int>& rocks) {
  for (int rock : rocks) world_.remove_rock(rock);
  return mass_of(rocks);
}

double Site::mass_of(const std::vector<int>& rocks) const {
  double mass = 0;
  for (int rock : rocks) mass += world_.rocks()[static_cast<std::size_t>(rock)].body.mass;
  return mass;
}

bool Site::bucket_is_clear() const {
  const Load load = this->load(std::vector<bool>(world_.rocks().size(), true));
  std::vector<bool> carried(world_.rocks().size());
  const Eigen::Vector3d velocity = machine_.point_velocity(lhd_.bucket, lhd_.G);
  for (const std::vector<int>* rocks : {&load.in_bucket, &load.elsewhere})
    for (int rock : *rocks) {
      carried[static_cast<std::size_t>(rock)] = true;
      if ((world_.rocks()[static_cast<std::size_t>(rock)].velocity - velocity).norm() > calm) return false;
    }
  const std::array<int, 4> arm = {lhd_.bucket, lhd_.boom, lhd_.bell_crank, lhd_.link};
  const auto leaves = [&](const engine::SurfaceOwner& side) {
    if (side.owner == engine::Owner::part) return std::find(arm.begin(), arm.end(), side.index) != arm.end();
    return side.owner == engine::Owner::rock && carried[static_cast<std::size_t>(side.index)];
  };
  for (const engine::PairForce& pair : world_.pair_forces())
    if (!pair.force.isZero() && leaves(pair.a) != leaves(pair.b)) return false;
  return true;
}

double Site::free_tip_x(double tip_x, double y, double farthest_back) const {
  double x = tip_x;
  for (const engine::Rock& rock : world_.rocks()) {
    const double left = rock.pose.translation().x() - polyhedron(rock).radius() - room;
    if (in_lane(rock, y) && left < x && left >= farthest_back) x = left;
  }
  return x;
}

bool Site::in_lane(const engine::Rock& rock, double y) const {
  const double half_width = std::max(least_half_width, 0.5 * lhd_.bucket_width + room);
  const Eigen::Vector3d& p = rock.pose.translation();
  return rock.present && std::abs(p.y() - y) < half_width + polyhedron(rock).radius() && p.z() < machine_top;
}

std::vector<int> Site::place_machine(double tip_x, double y, double speed) {
  std::vector<int> cleared;
  for (std::size_t k = 0; k < world_.rocks().size(); ++k) {
    const engine::Rock& rock = world_.rocks()[k];
    const double centre = rock.pose.translation().x(), reach = polyhedron(rock).radius() + room;
    if (in_lane(rock, y) && centre - reach < tip_x && centre + reach > tip_x - machine_length)
      cleared.push_back(static_cast<int>(k));
  }
  remove(cleared);
  driver_.place_standing(tip_x, y, speed);
  return cleared;
}

double Site::present_mass() const { return granular::present_mass(world_); }

double Site::missing_mass() const { return initial_mass_ - present_mass(); }

double Site::emitted_mass() const {
  double sum = 0;
  for (std::size_t k = initial_rocks_; k < world_.rocks().size(); ++k) sum += world_.rocks()[k].body.mass;
  return sum;
}

double Site::machine_energy() const { return machine_.energy(world_.options().gravity); }

double Site::rock_energy() const {
  double energy = world_.kinetic_energy();
  for (const engine::Rock& rock : world_.rocks())
    if (rock.present) energy -= rock.body.mass * world_.options().gravity.dot(rock.pose.translation());
  return energy;
}

bool Site::refill(double carried) {
  return !emitter_.emit(world_, library_, specs_, missing_mass() + carried).empty();
}

double Site::remove_escaped() {
  double escaped = 0;
  for (std::size_t k = 0; k < world_.rocks().size(); ++k) {
    const engine::Rock& rock = world_.rocks()[k];
    const Eigen::Vector3d& p = rock.pose.translation();
    const bool inside = p.z() > -0.5 && std::abs(p.y()) < drift_.width && p.x() < drift_.length + 1 &&
                        p.z() < 3 * drift_.raise_height;
    if (!rock.present || inside || !p.allFinite()) continue;
    escaped += rock.body.mass;
    world_.remove_rock(static_cast<int>(k));
  }
  return escaped;
}

std::string Site::trouble() const {
  const std::string when = " not finite at t = " + std::to_string(world_.time()) + " s; use a smaller step";
  for (std::size_t k = 0; k < world_.rocks().size(); ++k) {
    const engine::Rock& rock = world_.rocks()[k];
    if (rock.present && !(rock.pose.matrix().allFinite() && rock.velocity.allFinite()))
      return "rock " + std::to_string(k) + " is" + when;
  }
  if (!driver_.read().front_axle.allFinite()) return "the machine's position is" + when;
  return {};
}

}  // namespace drawpoint::engine::loading
