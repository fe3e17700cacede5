// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/world/joining_points.h>

#include <algorithm>
#include <drawpoint/engine/base/constants.hpp>
#include <limits>

namespace drawpoint::engine::detail {
namespace {

using Eigen::Vector3d;

double least_gap(const Manifold& m) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < m.count; ++k) least = std::min(least, m.points[static_cast<std::size_t>(k)].gap);
  return least;
}

bool of_rock(const Scene& scene, const Manifold& m) {
  return scene.surface(m.collider_a).owner == Owner::rock || scene.surface(m.collider_b).owner == Owner::rock;
}

template <class Joins>
unsigned points_that(const Manifold& m, const Joins& joins) {
  unsigned points = 0;
  for (int k = 0; k < m.count; ++k)
    points |= static_cast<unsigned>(joins(m.points[static_cast<std::size_t>(k)])) << k;
  return points;
}

// Diameter of the smaller shape of a pair, by the radius about its body's origin; fixed surfaces are never smaller.
double size_of(const Surface& a, const Surface& b) {
  if (a.owner == Owner::fixed) return 2 * b.radius;
  if (b.owner == Owner::fixed) return 2 * a.radius;
  return 2 * std::min(a.radius, b.radius);
}

constexpr double passing_slack = 1 + 1e-5;  // above single precision, in which impulses are sought

// By how much b can come nearer to a at this point along n in a time h, with the acceleration or, where motors and
// contacts hold it, without. Substeps have all of what speeds them up at their beginnings.
double most_closing(const Vector3d& velocity, const Vector3d& acceleration, const Vector3d& n, double h) {
  return -h * n.dot(velocity) + std::max(0.0, -h * h * n.dot(acceleration));
}

}  // namespace

void JoiningPoints::find(const std::vector<Manifold>& manifolds, const Scene& scene, const StepBodies& bodies,
                         double h, const ThreadPool& pool) {
  manifolds_ = &manifolds;
  const int count = static_cast<int>(manifolds.size());
  joins_.resize(manifolds.size());
  touch_.resize(manifolds.size());
  const std::size_t blocks = manifolds.size() / block + 1;
  if (touches_.size() < blocks) touches_.resize(blocks);
  deepest_.assign(blocks, 0.0);
  const Step step{scene, bodies, h};
  pool.blocks_by_thread(count, block, [&](int begin, int end, int thread) {
    for (int first = begin; first < end; first += block)
      find_block(step, first, std::min(end, first + block), thread);
  });
}

void JoiningPoints::find_block(const Step& step, int first, int last, int thread) {
  std::vector<FirstTouch>& touches = touches_[static_cast<std::size_t>(first / block)];
  touches.clear();
  double& deepest = deepest_[static_cast<std::size_t>(first / block)];
  for (int k = first; k < last; ++k) {
    const auto place = static_cast<std::size_t>(k);
    const std::size_t before = touches.size();
    const Manifold& m = (*manifolds_)[place];
    const double least = least_gap(m);
    if (of_rock(step.scene, m)) deepest = std::max(deepest, -least);
    joins_[place] = joining(step, m, least, thread, touches);
    touch_[place] = touches.size() > before ? static_cast<int>(before) : -1;
  }
}

double JoiningPoints::deepest_overlap() const { return *std::max_element(deepest_.begin(), deepest_.end()); }

Vector3d JoiningPoints::Step::acceleration(const Surface& surface, const RigidMotion& motion,
                                           const Vector3d& at) const {
  return surface.owner == Owner::part ? scene.part_acceleration(surface.index, at, h) : motion.acceleration;
}

unsigned JoiningPoints::joining(const Step& step, const Manifold& m, double least, int thread,
                                std::vector<FirstTouch>& touches) const {
  constexpr double margin = constants::resting_margin;
  const double h = step.h;
  const unsigned near = points_that(m, [](const ManifoldPoint& p) { return p.gap <= margin; });
  if (least <= 0 && near + 1 == 1u << m.count && !step.scene.prescribed())
    return near;  // most: no need to look at the bodies
  const Surface &surface_a = step.scene.surface(m.collider_a), &surface_b = step.scene.surface(m.collider_b);
  if (step.scene.prescribed() && surface_a.owner != Owner::rock && surface_b.owner != Owner::rock)
    return 0;  // neither gives way
  const RigidMotion a = step.bodies.motion(surface_a), b = step.bodies.motion(surface_b);
  const double reach = margin + step.scene.extra_reach_of(surface_a) + step.scene.extra_reach_of(surface_b);
  const Vector3d &first = m.points[0].position, acceleration = step.acceleration(surface_b, b, first) -
                                                               step.acceleration(surface_a, a, first);
  const auto velocity = [&](const ManifoldPoint& p) -> Vector3d {
    return b.at(p.position) - a.at(p.position);
  };
  const bool with_part = surface_a.owner == Owner::part || surface_b.owner == Owner::part;
  const double speeding_up =
      with_part ? h * h * acceleration.norm() : 0;  // of rocks it is weight: in the margin
  const unsigned within = near | points_that(m, [&](const ManifoldPoint& p) {
                            return p.gap <= reach + speeding_up + 2 * h * velocity(p).norm();
                          });
  if (within == 0 || least <= 0 || step.scene.finder().with_half_space(m)) return within;
  const double turning =
      size_of(surface_a, surface_b) * (b.angular_velocity - a.angular_velocity).cross(m.normal).norm();
  if (h * turning + most_closing(velocity(m.points[0]), acceleration, m.normal, h) < least) return within;
  for (int k = 0; k < m.count; ++k) {
    const Vector3d shift = h * (velocity(m.points[static_cast<std::size_t>(k)]) + 0.5 * h * acceleration);
    if (within >> k & 1u && step.scene.finder().meets_face(m, a, b, h, k, shift)) return within;
  }
  touches.emplace_back();
  FirstTouch& touch = touches.back();
  if (step.scene.finder().first_touch(m, a, b, h, thread, touch)) return (1u << touch.manifold.count) - 1;
  // They pass each other: only what is pushed farther than their motion goes may meet here.
  touch.manifold = m;
  for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
    ManifoldPoint& p = touch.manifold.points[k];
    touch.on_a[k] = p.position - 0.5 * p.gap * m.normal, touch.on_b[k] = p.position + 0.5 * p.gap * m.normal;
    p.gap = std::max(p.gap, passing_slack * most_closing(velocity(p), acceleration, m.normal, h));
  }
  return within;
}

}  // namespace drawpoint::engine::detail
