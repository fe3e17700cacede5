// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <drawpoint/engine/solver/contact_law.hpp>
#include <drawpoint/engine/base/prefetch.h>
#include <drawpoint/engine/world/world.hpp>
#include <utility>

// From manifolds to the contacts of the solve, and from its impulses to what the next step starts from.
namespace drawpoint::engine {
namespace {

using Eigen::Vector3d;

// A point this far apart [m] joins the solve even when it does not close in; with the travel of two steps
// added it covers whatever the solve itself may set moving.
constexpr double resting_margin = 1e-3;
constexpr int manifolds_a_block = 64;  // that a thread takes at a time
constexpr int pairs_ahead = 4;         // whose rocks are fetched

}  // namespace

int World::solver_index(const Surface& surface) const {
  if (surface.owner == Owner::part) return machine_part(surface.index);
  return surface.owner == Owner::rock ? body_of_rock_[surface.index] : world_body;
}

Vector3d World::origin_of(const Surface& surface) const {
  if (surface.owner == Owner::rock) return rocks_[surface.index].pose.translation();
  return surface.owner == Owner::part ? super_->origins[surface.index] : Vector3d(Vector3d::Zero());
}

World::Side World::side_of(const Surface& surface) const {
  if (surface.owner == Owner::part) {
    const SpatialVector V = super_->part_maps[surface.index] * super_->velocity_before;
    return {super_->origins[surface.index], V.tail<3>(), V.head<3>()};
  }
  if (surface.owner == Owner::fixed) return {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  const Rock& rock = rocks_[surface.index];
  return {rock.pose.translation(), rock.velocity, rock.angular_velocity};
}

[[gnu::always_inline]] inline void World::fetch_origins(const Manifold& m) const {
  for (const int collider : {m.collider_a, m.collider_b}) {
    const Surface& surface = surfaces_[collider];
    if (surface.owner == Owner::rock)
      detail::fetch(rocks_[surface.index].pose.translation().data(), sizeof(Vector3d));
  }
}

// Points that may come to bear within the step join the solve: each manifold is looked at twice, first to see
// which do, then to write them where they belong, so that threads may share the work.
void World::fill_contacts() {
  const int manifolds = static_cast<int>(manifolds_->size());
  joins_.resize(manifolds_->size());
  places_.assign(static_cast<std::size_t>(manifolds / manifolds_a_block + 1), ContactPlace());
  parallel_->blocks(manifolds, manifolds_a_block, [&](int first, int last) { count_joining(first, last); });
  ContactPlace end;
  for (ContactPlace& place : places_) {
    const ContactPlace block = std::exchange(place, end);
    end.pair += block.pair;
    end.point += block.point;
  }
  problem_.step = options_.step;
  problem_.pairs.resize(static_cast<std::size_t>(end.pair));
  problem_.points.resize(static_cast<std::size_t>(end.point));
  parallel_->blocks(manifolds, manifolds_a_block, [&](int first, int last) { fill_pairs(first, last); });
}

unsigned World::joining(const Manifold& m) const {
  unsigned joins = 0;
  for (int k = 0; k < m.count; ++k)
    if (m.points[k].gap <= resting_margin) joins |= 1u << k;
  if (joins + 1 == 1u << m.count) return joins;  // most: no need to look at the sides
  const Side a = side_of(surfaces_[m.collider_a]), b = side_of(surfaces_[m.collider_b]);
  for (int k = 0; k < m.count; ++k) {
    const Vector3d u = b.at(m.points[k].position) - a.at(m.points[k].position);
    if (m.points[k].gap <= resting_margin + 2 * options_.step * u.norm()) joins |= 1u << k;
  }
  return joins;
}

void World::count_joining(int first, int last) {
  for (int k = first; k < last; ++k) {
    joins_[k] = joining((*manifolds_)[k]);
    ContactPlace& block = places_[k / manifolds_a_block];
    block.pair += joins_[k] != 0;
    block.point += std::popcount(joins_[k]);
  }
}

void World::fill_pairs(int first, int last) {
  WarmStart::Reader reader(warm_start_);
  ContactPlace place = places_[first / manifolds_a_block];
  for (int k = first; k < last; ++k) {
    if (k + pairs_ahead < last) fetch_origins((*manifolds_)[k + pairs_ahead]);
    if (joins_[k] == 0) continue;
    fill_pair((*manifolds_)[k], joins_[k], place, reader);
    ++place.pair;
    place.point += std::popcount(joins_[k]);
  }
}

void World::fill_pair(const Manifold& m, unsigned joins, ContactPlace place, WarmStart::Reader& reader) {
  const Surface &a = surfaces_[m.collider_a], &b = surfaces_[m.collider_b];
  const Material& material = materials_.of(a.material, b.material);
  const Vector3d origin_a = origin_of(a), origin_b = origin_of(b);
  reader.begin_pair(m.collider_a, m.collider_b);
  ContactPair& pair = problem_.pairs[place.pair];
  pair = ContactPair();
  pair.first = place.point;
  pair.count = std::popcount(joins);
  pair.a = solver_index(a);
  pair.b = solver_index(b);
  pair.collider_a = m.collider_a;
  pair.collider_b = m.collider_b;
  pair.rolling_arm = material.rolling * m.radius;
  pair.spinning_arm = material.spinning * m.radius;
  pair.start = options_.warm_start * reader.rolling();
  const int touching = std::max<int>(1, std::count_if(m.points.begin(), m.points.begin() + m.count,
                                                      [](const ManifoldPoint& p) { return p.gap <= 0; }));
  for (int k = 0; k < m.count; ++k) {
    if (!(joins >> k & 1u)) continue;
    const ManifoldPoint& p = m.points[k];
    ContactPoint& c = problem_.points[place.point++];
    c.feature = p.feature;
    c.position = p.position;
    c.arm_a = p.position - origin_a;
    c.arm_b = p.position - origin_b;
    c.normal = m.normal;
    c.gap = p.gap;
    const double stiffness = material.law == NormalLaw::linear
                                 ? material.stiffness
                                 : hertz_stiffness(material.stiffness, m.radius, -p.gap);
    c.stiffness = stiffness / touching;
    c.damping_time = material.damping_time;
    c.friction = material.friction;
    c.restitution = material.restitution;
    c.start = options_.warm_start * reader.point(p.feature, p.position);
  }
}

void World::keep_impulses() {
  warm_start_.begin_store(problem_.pairs.size(), problem_.points.size());
  parallel_->blocks(static_cast<int>(problem_.pairs.size()), manifolds_a_block, [&](int first, int last) {
    for (int index = first; index < last; ++index) {
      const ContactPair& pair = problem_.pairs[index];
      warm_start_.store_pair(
          index, {pair.collider_a, pair.collider_b, pair.start, static_cast<std::size_t>(pair.first),
                  static_cast<std::size_t>(pair.count)});
      for (int k = pair.first; k < pair.first + pair.count; ++k) {
        const ContactPoint& p = problem_.points[k];
        warm_start_.store_point(k, {p.feature, p.position, p.carried * p.start, false});
      }
    }
  });
  warm_start_.end_store();
}

// Of a rock in anything, at the start of the step.
double World::deepest_overlap() {
  const int manifolds = static_cast<int>(manifolds_->size());
  deepest_.assign(static_cast<std::size_t>(manifolds / manifolds_a_block + 1), 0.0);
  parallel_->blocks(manifolds, manifolds_a_block, [&](int first, int last) {
    double& deepest = deepest_[static_cast<std::size_t>(first / manifolds_a_block)];
    for (int i = first; i < last; ++i) {
      const Manifold& m = (*manifolds_)[i];
      if (surfaces_[m.collider_a].owner != Owner::rock && surfaces_[m.collider_b].owner != Owner::rock)
        continue;
      for (int k = 0; k < m.count; ++k) deepest = std::max(deepest, -m.points[k].gap);
    }
  });
  return *std::max_element(deepest_.begin(), deepest_.end());
}

}  // namespace drawpoint::engine
