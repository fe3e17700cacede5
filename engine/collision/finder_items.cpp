// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/collision/finder_items.h>

#include <drawpoint/engine/base/checks.hpp>
#include <drawpoint/engine/base/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::detail {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("engine::ContactFinder: " + what);
}

void check(const Cylinder& cylinder) {
  if (!(cylinder.radius > 0) || !(cylinder.half_width > 0) ||
      !std::isfinite(cylinder.radius + cylinder.half_width))
    refuse("a cylinder has radius " + std::to_string(cylinder.radius) + " m and half width " +
           std::to_string(cylinder.half_width) + " m; give positive sizes");
}

void check(const HalfSpace& plane) {
  if (!is_unit(plane.normal) || !std::isfinite(plane.offset))
    refuse("a half-space has a normal whose length is off 1 by " + text(plane.normal.norm() - 1) +
           " and offset " + text(plane.offset) + " m; allowed: off by less than " + unit_length.text +
           " and finite; give a unit normal, normal.normalized()");
}

}  // namespace

void Items::add(Item added, const Eigen::Isometry3d& X_WB) {
  const bool half_space = added.plane != nullptr;
  double radius = 0;
  if (added.cylinder)
    radius = std::cbrt(1.5 * added.cylinder->radius * added.cylinder->radius * added.cylinder->half_width);
  else if (!half_space)
    radius = added.hull->equivalent_radius;
  const Collider& c = added.collider;
  traits.push_back({c.body, c.family, c.moves, true, half_space ? 0 : 1 / radius});
  placed.emplace_back();
  placed.back().hull = added.hull.get();
  motion_bound.push_back(0);
  speculative_margin.push_back(0);
  item.push_back(std::move(added));
  place(size() - 1, X_WB);
  motion_bound.back() = 0;
}

void Items::remove(int id) {
  item[id] = Item{};
  placed[id] = Placement{};
  traits[id] = Traits{};
}

void Items::place(int id, const Eigen::Isometry3d& X_WB) {
  const Eigen::Isometry3d& X_BC = item[id].collider.X_BC;
  Placement& here = placed[id];
  const Eigen::Matrix3d before = here.R;
  here.R = X_WB.linear() * X_BC.linear();
  here.p = X_WB * X_BC.translation();
  if (!here.hull) return;
  const Eigen::Vector3d moved = here.at(here.hull->centre);
  motion_bound[id] +=
      (moved - here.centre).norm() + (here.R - before).norm() / std::numbers::sqrt2 * here.hull->radius;
  here.centre = moved;
}

void Items::extend(int id, double to) {
  motion_bound[id] += std::abs(to - speculative_margin[id]);
  speculative_margin[id] = to;
}

Eigen::AlignedBox3d Items::box(int id) const {
  // A cylinder's box is the true one, which holds the inscribed prism.
  const Placement& here = placed[id];
  if (const Cylinder* cylinder = item[id].cylinder) {
    const Eigen::Vector3d axis = here.R.col(1);
    const Eigen::Vector3d reach = cylinder->half_width * axis.cwiseAbs() +
                                  cylinder->radius * (1 - axis.array().square()).max(0).sqrt().matrix();
    return {here.p - reach, here.p + reach};
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : here.hull->vertices) box.extend(here.at(p));
  return box;
}

Plane Items::plane(int id) const {
  const Eigen::Vector3d normal = placed[id].R * item[id].plane->normal;
  return {normal, item[id].plane->offset + normal.dot(placed[id].p)};
}

std::shared_ptr<const CollisionHull> HullLibrary::hull_of(const Shape& shape) {
  if (hulls_.size() >= sweep_at_) {
    std::erase_if(hulls_, [](const auto& entry) { return entry.second.expired(); });
    sweep_at_ = 2 * std::max<std::size_t>(hulls_.size(), 32);
  }
  auto& known = hulls_[&shape];
  auto hull = known.lock();
  if (hull) return hull;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    hull = std::make_shared<CollisionHull>(
        prism(cylinder->radius, cylinder->half_width, constants::cylinder_sides));
  else
    hull = std::make_shared<CollisionHull>(std::get<ConvexPolyhedron>(shape));
  known = hull;
  return hull;
}

Item HullLibrary::make_item(const Collider& collider) {
  if (!collider.shape) refuse("a collider has no shape; set Collider::shape");
  if (!collider.X_BC.matrix().allFinite()) refuse("a collider's X_BC is not finite");
  Item item;
  item.collider = collider;
  const Shape& shape = *collider.shape;
  item.plane = std::get_if<HalfSpace>(&shape);
  item.cylinder = std::get_if<Cylinder>(&shape);
  if (item.plane) check(*item.plane);
  if (item.cylinder) check(*item.cylinder);
  if (!item.plane) item.hull = hull_of(shape);
  return item;
}

}  // namespace drawpoint::engine::detail
