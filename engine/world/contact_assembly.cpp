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

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int world_body = 0;            // problem().bodies[0] never moves
constexpr int awake_per_block = 128;     // that a thread takes at a time
constexpr int manifolds_per_block = 64;  // that a thread takes at a time
constexpr int pairs_ahead = 4;           // whose memory is prefetched

Matrix3d turned(const Matrix3d& R, const Vector3d& principal) {
  return R * principal.asDiagonal() * R.transpose();
}

}  // namespace

ContactAssembly::ContactAssembly(const WorldOptions& options, const Scene& scene,
                                 std::shared_ptr<const ThreadPool> pool)
    : options_(options), scene_(scene), pool_(std::move(pool)) {}

void ContactAssembly::begin_step(double h, double last) {
  problem_.step = h;
  start_share_ = options_.warm_start;
  if (last > 0) start_share_ *= h > constants::most_growth * last ? 0.0 : h / last;
}

void ContactAssembly::fill(const std::vector<Manifold>& manifolds, const std::vector<int>& awake) {
  manifolds_ = &manifolds;
  fill_bodies(awake);
  fill_contacts();
}

void ContactAssembly::fill_bodies(const std::vector<int>& awake) {
  const std::vector<Rock>& rocks = scene_.rocks();
  problem_.bodies.resize(awake.size() + 1);
  problem_.bodies[world_body] = SolverBody();
  sides_.resize(problem_.bodies.size());
  sides_[world_body] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  body_of_rock_.assign(rocks.size(), world_body);
  pool_->blocks(static_cast<int>(awake.size()), awake_per_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const Rock& rock = rocks[awake[k]];
      SolverBody& body = problem_.bodies[k + 1];
      body_of_rock_[awake[k]] = k + 1;
      body.inverse_mass = 1 / rock.body.mass;
      body.inverse_inertia = turned(rock.pose.linear(), rock.body.inertia.cwiseInverse());
      body.velocity = rock.velocity;
      body.external_velocity_change = problem_.step * options_.gravity;
      body.angular_velocity = rock.angular_velocity;
      sides_[k + 1] = {rock.pose.translation(), rock.velocity, rock.angular_velocity};
    }
  });
}

int ContactAssembly::solver_index(const Surface& surface) const {
  if (surface.owner == Owner::part) return machine_part(surface.index);
  return surface.owner == Owner::rock ? body_of_rock_[surface.index] : world_body;
}

// Frozen rocks stand, as the world does.
Side ContactAssembly::side_of(const Surface& surface) const {
  const int body = solver_index(surface);
  return body >= 0 ? sides_[static_cast<std::size_t>(body)] : scene_.side_of(surface);
}

Vector3d ContactAssembly::origin_of(const Surface& surface) const {
  const int body = solver_index(surface);
  return body > world_body ? sides_[static_cast<std::size_t>(body)].origin : scene_.origin_of(surface);
}

// Each manifold is looked at twice, first to see which points join, then to write them where they belong, so
// that threads may share the work.
void ContactAssembly::fill_contacts() {
  const int manifolds = static_cast<int>(manifolds_->size());
  joins_.resize(manifolds_->size());
  places_.assign(static_cast<std::size_t>(manifolds / manifolds_per_block + 1), ContactPlace());
  deepest_.assign(places_.size(), 0.0);
  pool_->blocks(manifolds, manifolds_per_block, [&](int first, int last) { count_joining(first, last); });
  ContactPlace end;
  for (ContactPlace& place : places_) {
    const ContactPlace block = std::exchange(place, end);
    end.pair += block.pair;
    end.point += block.point;
  }
  problem_.pairs.resize(static_cast<std::size_t>(end.pair));
  problem_.points.resize(static_cast<std::size_t>(end.point));
  slots_.resize(static_cast<std::size_t>(end.pair));
  pool_->blocks(manifolds, manifolds_per_block, [&](int first, int last) { fill_pairs(first, last); });
}

unsigned ContactAssembly::joining(const Manifold& m) const {
  unsigned joins = 0;
  for (int k = 0; k < m.count; ++k)
    joins |= static_cast<unsigned>(m.points[k].gap <= constants::resting_margin) << k;
  if (joins + 1 == 1u << m.count) return joins;  // most: no need to look at the sides
  const Surface &surface_a = scene_.surface(m.collider_a), &surface_b = scene_.surface(m.collider_b);
  const Side a = side_of(surface_a), b = side_of(surface_b);
  const double margin =
      constants::resting_margin + scene_.extra_reach_of(surface_a) + scene_.extra_reach_of(surface_b);
  for (int k = 0; k < m.count; ++k) {
    if (joins >> k & 1u) continue;
    const Vector3d u = b.at(m.points[k].position) - a.at(m.points[k].position);
    if (m.points[k].gap <= margin + 2 * problem_.step * u.norm()) joins |= 1u << k;
  }
  return joins;
}

void ContactAssembly::count_joining(int first, int last) {
  ContactPlace place;
  double deepest = 0;
  for (int k = first; k < last; ++k) {
    const Manifold& m = (*manifolds_)[k];
    joins_[k] = joining(m);
    place.pair += joins_[k] != 0;
    place.point += std::popcount(joins_[k]);
    if (scene_.surface(m.collider_a).owner == Owner::rock ||
        scene_.surface(m.collider_b).owner == Owner::rock)
      for (int i = 0; i < m.count; ++i) deepest = std::max(deepest, -m.points[i].gap);
  }
  places_[first / manifolds_per_block] = place;
  deepest_[first / manifolds_per_block] = deepest;
}

void ContactAssembly::fill_pairs(int first, int last) {
  ContactPlace place = places_[first / manifolds_per_block];
  for (int k = first; k < last; ++k) {
    if (k + pairs_ahead < last) memory_.prefetch((*manifolds_)[k + pairs_ahead].slot);
    if (joins_[k] == 0) continue;
    fill_pair((*manifolds_)[k], joins_[k], place);
    ++place.pair;
    place.point += std::popcount(joins_[k]);
  }
}

void ContactAssembly::fill_pair(const Manifold& m, unsigned joins, ContactPlace place) {
  const Surface &a = scene_.surface(m.collider_a), &b = scene_.surface(m.collider_b);
  const Material& material = scene_.materials().of(a.material, b.material);
  const Vector3d origin_a = origin_of(a), origin_b = origin_of(b);
  PairMemory::Start start = memory_.start(m.slot, m.collider_a, m.collider_b);
  slots_[place.pair] = m.slot;
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

double ContactAssembly::deepest_overlap() const {
  return *std::max_element(deepest_.begin(), deepest_.end());
}

}  // namespace drawpoint::engine::detail
