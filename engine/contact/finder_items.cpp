// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/contact/finder_items.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::contact::detail {
namespace {

constexpr int cylinder_sides = 48;  // a prism within R(1 − cos(π/48)) = 0.0021 R of the cylinder

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("contact::ContactFinder: " + what);
}

void check(const Cylinder& cylinder) {
  if (!(cylinder.radius > 0) || !(cylinder.half_width > 0) ||
      !std::isfinite(cylinder.radius + cylinder.half_width))
    refuse("a cylinder has radius " + std::to_string(cylinder.radius) + " m and half width " +
           std::to_string(cylinder.half_width) + " m; give positive sizes");
}

void check(const HalfSpace& plane) {
  if (!(std::abs(plane.normal.norm() - 1) < 1e-9) || !std::isfinite(plane.offset))
    refuse("a half-space has a normal of length " + std::to_string(plane.normal.norm()) + " and offset " +
           std::to_string(plane.offset) + " m; give a unit normal and a finite offset");
}

}  // namespace

void Item::place(const Eigen::Isometry3d& X_WB) {
  const Eigen::Isometry3d before = X_WC;
  X_WC = X_WB * collider.X_BC;
  if (!hull) return;
  const Eigen::Vector3d moved = X_WC * hull->centre;
  travelled +=
      (moved - centre).norm() + (X_WC.linear() - before.linear()).norm() / std::numbers::sqrt2 * hull->radius;
  centre = moved;
}

Eigen::AlignedBox3d Item::box() const {
  // A cylinder's box is the true one, which holds the inscribed prism.
  Eigen::AlignedBox3d box;
  if (cylinder) {
    const Eigen::Vector3d axis = X_WC.linear().col(1);
    const Eigen::Vector3d reach = cylinder->half_width * axis.cwiseAbs() +
                                  cylinder->radius * (1 - axis.array().square()).max(0).sqrt().matrix();
    return {X_WC.translation() - reach, X_WC.translation() + reach};
  }
  for (const Eigen::Vector3d& p : hull->vertices) box.extend(X_WC * p);
  return box;
}

Plane Item::plane_in_world() const {
  const Eigen::Vector3d normal = X_WC.linear() * plane->normal;
  return {normal, plane->offset + normal.dot(X_WC.translation())};
}

std::shared_ptr<const CollisionHull> HullLibrary::hull_of(const Shape& shape) {
  std::erase_if(hulls_, [](const auto& entry) { return entry.second.expired(); });
  auto& known = hulls_[&shape];
  auto hull = known.lock();
  if (hull) return hull;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    hull = std::make_shared<CollisionHull>(prism(cylinder->radius, cylinder->half_width, cylinder_sides));
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
  if (item.plane) {
    check(*item.plane);
    item.equivalent_radius = std::numeric_limits<double>::infinity();
    return item;
  }
  if (item.cylinder) check(*item.cylinder);
  item.hull = hull_of(shape);
  item.equivalent_radius =
      item.cylinder
          ? std::cbrt(0.75 * item.cylinder->radius * item.cylinder->radius * 2 * item.cylinder->half_width)
          : item.hull->equivalent_radius;
  return item;
}

}  // namespace drawpoint::engine::contact::detail
