// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/world/extra_reach.h>

#include <algorithm>
#include <atomic>

namespace drawpoint::engine::detail {
namespace {

constexpr int rocks_per_reach_block = 256;  // that a thread takes at a time

// Least distance of the surface from a point in the shape.
double inner_radius(const Shape& shape, const Eigen::Vector3d& from) {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return std::min(cylinder->radius, cylinder->half_width);
  return std::get<ConvexPolyhedron>(shape).depth(from);
}

}  // namespace

void ExtraReach::add(const Shape& shape) {
  allowed_.push_back(inner_radius(shape, Eigen::Vector3d::Zero()));
  reach_.push_back(0);
}

void ExtraReach::add_part(int part, const Shape& shape, double radius) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  if (const auto* polyhedron = std::get_if<ConvexPolyhedron>(&shape))
    for (const Eigen::Vector3d& p : polyhedron->vertices())
      middle += p / static_cast<double>(polyhedron->vertices().size());
  if (part >= static_cast<int>(parts_.size())) parts_.resize(static_cast<std::size_t>(part) + 1);
  Part& of = parts_[static_cast<std::size_t>(part)];
  of.allowed = std::min(of.allowed, inner_radius(shape, middle));
  of.radius = std::max(of.radius, radius);
}

void ExtraReach::begin_step() {
  if (any_) std::fill(reach_.begin(), reach_.end(), 0.0);
  for (Part& part : parts_) part.reach = 0;
  any_ = false;
}

bool ExtraReach::grow(const std::vector<Rock>& rocks, const SolvedRocks& solved, double h) {
  const auto beyond = [&](int k) {
    const auto rock = static_cast<std::size_t>(solved.present[k]);
    const SolverBody& body = solved.problem.bodies[k + 1];
    const double way = (body.displacement - h * rocks[rock].velocity).norm();
    const double fall = h * body.external_velocity_change.norm();
    return way > allowed_[rock] + reach_[rock] + fall ? way : 0.0;
  };
  std::atomic<bool> found{false};
  const int count = static_cast<int>(solved.present.size());
  solved.pool.blocks(count, rocks_per_reach_block, [&](int first, int last) {
    for (int k = first; k < last; ++k)
      if (beyond(k) > 0) found.store(true, std::memory_order_relaxed);
  });
  if (!found) return false;
  for (int k = 0; k < count; ++k)
    if (const double way = beyond(k); way > 0) reach_[static_cast<std::size_t>(solved.present[k])] = 2 * way;
  return any_ = true;
}

bool ExtraReach::grow(const SuperBody& machine, const SuperBodySolution& solved, double h) {
  bool grown = false;
  const std::size_t parts = std::min(parts_.size(), machine.part_maps.size());
  for (std::size_t p = 0; p < parts; ++p) {
    const SpatialVector way = h * (machine.part_maps[p] * (solved.mean_velocity - machine.velocity_before));
    const double longest = way.tail<3>().norm() + way.head<3>().norm() * parts_[p].radius;
    if (!(longest > parts_[p].allowed + parts_[p].reach)) continue;
    parts_[p].reach = 2 * longest;
    grown = true;
  }
  return grown;
}

}  // namespace drawpoint::engine::detail
