// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

// What can be asked about a world between steps: forces in its contacts, surfaces on a ray.

#include <drawpoint/engine/world/world_impl.h>
#include <drawpoint/engine/base/checks.hpp>

#include <stdexcept>
#include <string>

namespace drawpoint::engine {
namespace {

using Eigen::Vector3d;

// Where the points of a pair are in the mean, by the size of their impulses; of points without any, in the middle.
class Centre {
 public:
  void add(const Vector3d& position, const Vector3d& impulse) {
    const double weight = impulse.norm();
    weighted_ += weight * position;
    sum_ += position;
    weight_ += weight;
    ++count_;
  }
  Vector3d position() const {
    if (weight_ > 0) return weighted_ / weight_;
    return count_ > 0 ? Vector3d(sum_ / count_) : Vector3d(Vector3d::Zero());
  }

 private:
  Vector3d weighted_ = Vector3d::Zero(), sum_ = Vector3d::Zero();
  double weight_ = 0;
  int count_ = 0;
};

// Impulse on B over the step, with its moment about `position`.
struct PairImpulse {
  int collider_a, collider_b;
  Vector3d position, impulse, moment;
};

PairImpulse solved_pair(const ContactProblem& problem, const ContactPair& pair) {
  Centre centre;
  Vector3d impulse = Vector3d::Zero(), moment = pair.impulse;
  for (int k = pair.first; k < pair.first + pair.count; ++k) {
    const ContactPoint& p = problem.points[static_cast<std::size_t>(k)];
    centre.add(p.position, p.impulse);
    impulse += p.impulse;
  }
  for (int k = pair.first; k < pair.first + pair.count; ++k) {
    const ContactPoint& p = problem.points[static_cast<std::size_t>(k)];
    moment += (p.position - centre.position()).cross(p.impulse);
  }
  return {pair.collider_a, pair.collider_b, centre.position(), impulse, moment};
}

}  // namespace

// The pairs of colliders that `of` wants.
template <class Wanted>
std::vector<PairForce> World::Impl::forces_of(const Wanted& of) const {
  std::vector<PairForce> forces;
  if (last_step == 0) return forces;
  for (const ContactPair& pair : contacts.problem().pairs) {
    if (!of(pair.collider_a) && !of(pair.collider_b)) continue;
    const PairImpulse solved = solved_pair(contacts.problem(), pair);
    forces.push_back({scene.owner(solved.collider_a), scene.owner(solved.collider_b), solved.position,
                      solved.impulse / last_step, solved.moment / last_step});
  }
  return forces;
}

std::vector<PairForce> World::Impl::pair_forces() const {
  return forces_of([](int) { return true; });
}

Wrench World::Impl::wrench_on(const SurfaceOwner& body, const Vector3d& about) const {
  Wrench sum;
  for (const PairForce& pair : forces_of([&](int collider) { return scene.owner(collider) == body; })) {
    const double sign = (pair.b == body ? 1 : 0) - (pair.a == body ? 1 : 0);
    sum.force += sign * pair.force;
    sum.moment += sign * (pair.moment + (pair.position - about).cross(pair.force));
  }
  return sum;
}

std::vector<PairForce> World::pair_forces() const { return impl_->pair_forces(); }

Wrench World::rock_wrench(int rock) const {
  return impl_->wrench_on({Owner::rock, rock},
                          impl_->scene.present_rock(rock, "rock_wrench").pose.translation());
}

Wrench World::part_wrench(int part) const {
  const int parts = machine() ? machine()->parts() : 0;
  if (part < 0 || part >= parts)
    throw std::invalid_argument("engine::World::part_wrench: there is no part " + std::to_string(part) +
                                "; the attached machine has " + std::to_string(parts));
  return impl_->wrench_on({Owner::part, part}, machine()->part_pose(part).translation());
}

std::optional<RayHit> World::cast_ray(const Ray& ray, double most) const {
  if (!ray.origin.allFinite() || !detail::is_unit(ray.direction) || !(most >= 0))
    throw std::invalid_argument(
        std::string(
            "engine::World::cast_ray: the ray needs a finite origin, a direction of length 1 within ") +
        detail::unit_length.text + " and a distance of 0 m or more; use direction.normalized()");
  return impl_->scene.cast_ray(ray, most);
}

}  // namespace drawpoint::engine
