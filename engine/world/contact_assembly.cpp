// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/engine/world/contact_assembly.h>

#include <drawpoint/engine/base/prefetch.h>
#include <algorithm>
#include <bit>
#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/solver/contact_law.hpp>
#include <utility>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

constexpr int manifolds_per_block = 64;  // that a thread takes at a time
constexpr int pairs_ahead = 4;           // whose memory is prefetched

}  // namespace

ContactAssembly::ContactAssembly(const WorldOptions& options, const Scene& scene,
                                 std::shared_ptr<const ThreadPool> pool)
    : options_(options), scene_(scene), pool_(std::move(pool)), bodies_(options, scene) {}

void ContactAssembly::begin_step(double h, double last) {
  problem_.step = h;
  start_share_ = options_.warm_start;
  if (last > 0) start_share_ *= h > constants::most_growth * last ? 0.0 : h / last;
}

// Each manifold is looked at twice, first to see which points join, then to write them where they belong, so
// that threads may share the work.
void ContactAssembly::fill(const std::vector<Manifold>& manifolds) {
  bodies_.fill(*pool_, problem_);
  joining_.find(manifolds, scene_, bodies_, problem_.step, *pool_);
  inner_edges_.leave_out(scene_, static_cast<int>(manifolds.size()), joining_);
  fill_contacts(static_cast<int>(manifolds.size()));
}

void ContactAssembly::fill_contacts(int count) {
  places_.assign(static_cast<std::size_t>(count / manifolds_per_block + 1), ContactPlace());
  pool_->blocks(count, manifolds_per_block, [&](int first, int last) { count_joining(first, last); });
  ContactPlace end;
  for (ContactPlace& place : places_) {
    const ContactPlace block = std::exchange(place, end);
    end.pair += block.pair;
    end.point += block.point;
    end.prescribed += block.prescribed;
  }
  first_prescribed_ = static_cast<int>(problem_.bodies.size());
  problem_.bodies.resize(problem_.bodies.size() + static_cast<std::size_t>(end.prescribed));
  problem_.pairs.resize(static_cast<std::size_t>(end.pair));
  problem_.points.resize(static_cast<std::size_t>(end.point));
  slots_.resize(static_cast<std::size_t>(end.pair));
  pool_->blocks(count, manifolds_per_block, [&](int first, int last) { fill_pairs(first, last); });
}

void ContactAssembly::count_joining(int first, int last) {
  ContactPlace place;
  for (int k = first; k < last; ++k) {
    place.pair += joining_.points(k) != 0;
    place.point += std::popcount(joining_.points(k));
    place.prescribed += joining_.points(k) != 0 && has_prescribed(joining_.manifold(k));
  }
  places_[first / manifolds_per_block] = place;
}

void ContactAssembly::fill_pairs(int first, int last) {
  ContactPlace place = places_[first / manifolds_per_block];
  for (int k = first; k < last; ++k) {
    if (k + pairs_ahead < last) memory_.prefetch(joining_.manifold(k + pairs_ahead).slot);
    if (joining_.points(k) == 0) continue;
    fill_pair(k, place);
    ++place.pair;
    place.point += std::popcount(joining_.points(k));
    place.prescribed += has_prescribed(joining_.manifold(k));
  }
}

bool ContactAssembly::has_prescribed(const Manifold& m) const {
  return scene_.prescribed() && (scene_.surface(m.collider_a).owner == Owner::part ||
                                 scene_.surface(m.collider_b).owner == Owner::part);
}

// A pair's own body on the machine: its place is the middle of the pair's points, which it takes along their
// arc, so that what is carried round is pushed to the middle all the time.
void ContactAssembly::fill_prescribed(const ContactPair& pair, int body) {
  ContactPoint* const points = &problem_.points[static_cast<std::size_t>(pair.first)];
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int k = 0; k < pair.count; ++k) middle += points[k].position / pair.count;
  for (int k = 0; k < pair.count; ++k)
    (pair.a == body ? points[k].arm_a : points[k].arm_b) = points[k].position - middle;
  const PrescribedMotion& motion = *scene_.prescribed();
  SolverBody& moved = problem_.bodies[static_cast<std::size_t>(body)];
  moved = SolverBody();
  // A third of the step on: then the way of the step is right to the third order.
  const Eigen::Vector3d later =
      middle + problem_.step / 3 * motion.rigid.angular_velocity.cross(middle - motion.rigid.origin);
  moved.external_velocity_change = problem_.step * motion.acceleration_at(later);
  // In a substep it goes as fast as in the middle of it.
  moved.velocity = motion.rigid.at(middle) - 0.5 / options_.solver.substeps * moved.external_velocity_change;
  moved.angular_velocity = motion.rigid.angular_velocity;
}

SuperBodySolution ContactAssembly::felt_by_prescribed() const {
  SuperBodySolution felt;
  felt.part_impulses.assign(1, SpatialVector::Zero());
  SpatialVector& sum = felt.part_impulses.front();
  const Eigen::Vector3d& origin = scene_.prescribed()->rigid.origin;
  for (const ContactPair& pair : problem_.pairs) {
    if (std::max(pair.a, pair.b) < first_prescribed_) continue;
    const double sign = pair.b >= first_prescribed_ ? 1 : -1;
    sum.head<3>() += sign * pair.impulse;
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const ContactPoint& p = problem_.points[static_cast<std::size_t>(k)];
      sum.head<3>() += sign * (p.position - origin).cross(p.impulse);
      sum.tail<3>() += sign * p.impulse;
    }
  }
  return felt;
}

void ContactAssembly::fill_pair(int manifold, ContactPlace place) {
  const Manifold& m = joining_.manifold(manifold);
  const unsigned joins = joining_.points(manifold);
  const Surface &a = scene_.surface(m.collider_a), &b = scene_.surface(m.collider_b);
  const Material& material = scene_.materials().of(a.material, b.material);
  const Vector3d origin_a = bodies_.origin(a), origin_b = bodies_.origin(b);
  PairMemory::Start start = memory_.start(m.slot, m.collider_a, m.collider_b);
  slots_[place.pair] = m.slot;
  ContactPair& pair = problem_.pairs[place.pair];
  pair = ContactPair();
  pair.first = place.point;
  pair.count = std::popcount(joins);
  const int prescribed = has_prescribed(m) ? first_prescribed_ + place.prescribed : 0;
  pair.a = prescribed && a.owner == Owner::part ? prescribed : bodies_.index(a);
  pair.b = prescribed && b.owner == Owner::part ? prescribed : bodies_.index(b);
  pair.collider_a = m.collider_a;
  pair.collider_b = m.collider_b;
  pair.rolling_arm = material.rolling * m.radius;
  pair.spinning_arm = material.spinning * m.radius;
  pair.start = start_share_ * start.rolling();
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
    c.start = start_share_ * start.point(p.feature, p.position);
  }
  if (prescribed) fill_prescribed(pair, prescribed);
}

void ContactAssembly::keep_impulses() {
  memory_.begin_step(slots_, scene_.finder().slots());
  pool_->blocks(static_cast<int>(problem_.pairs.size()), manifolds_per_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      if (k + pairs_ahead < last) memory_.prefetch(slots_[static_cast<std::size_t>(k + pairs_ahead)]);
      memory_.store(problem_, k);
    }
  });
}

}  // namespace drawpoint::engine::detail
